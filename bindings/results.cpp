// What is here: measures, tables, verdicts, evaluations and packings in Python. What is not: how they are made
// (work.cpp), whole result files (files.cpp).
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings/bind.h"
#include "perfora/pack.h"

namespace perfora::python {

const char* name_of(Status status) {
  switch (status) {
    case Status::completed:
      return "completed";
    case Status::stopped:
      return "stopped";
    case Status::failed:
      break;
  }
  return "failed";
}

py::dict dict_of(const std::vector<Measure>& measures) {
  py::dict found;
  for (const Measure& measure : measures) found[py::str(measure.key)] = measure;
  return found;
}

py::object from_json(const std::string& text) {
  if (text.empty()) return py::none();
  return py::module_::import("json").attr("loads")(text);
}

namespace {

void add_measure(py::module_& module) {
  py::class_<Measure>(module, "Measure", "One number that a packing or a run is summed up by; float() gives its value.")
      .def_readonly("key", &Measure::key, "\"plateau_stress\".")
      .def_readonly("value", &Measure::value, "SI; NaN where it was not reached.")
      .def_readonly("unit", &Measure::unit, "SI unit: \"Pa\"; empty: none.")
      .def_readonly("dimension", &Measure::dimension, "\"stress\", \"ratio\", ...; empty: a plain number.")
      .def_readonly("label", &Measure::label, "For people: \"plateau stress\".")
      .def_readonly("help", &Measure::help, "One clause.")
      .def("__float__", [](const Measure& measure) { return measure.value; })
      .def("__repr__", [](const Measure& measure) {
        return "<perfora.Measure " + measure.key + " = " + py::str(py::float_(measure.value)).cast<std::string>() +
               (measure.unit.empty() ? "" : " " + measure.unit) + ">";
      });
}

const Column& column(const Table& table, const std::string& name) {
  static_cast<void>(table.values(name));  // an Error names the nearest one
  for (const Column& one : table.columns)
    if (one.name == name) return one;
  throw Error("there is no column " + name);
}

py::list column_names(const Table& table) {
  py::list found;
  for (const Column& one : table.columns) found.append(one.name);
  return found;
}

void add_table(py::module_& module) {
  py::class_<Table, std::shared_ptr<Table>>(
      module, "Table", "Equally long columns by name; dict(table) and pandas.DataFrame(dict(table)) take it.")
      .def(
          "__getitem__",
          [](const py::object& self, const std::string& name) {
            const auto values = self.cast<const Table&>().values(name);
            return view(self, values.data(), values.size());
          },
          py::arg("name"), "The numbers of a column (SI), a read-only view; NaN where a field is no number.")
      .def("__contains__", [](const Table& table, const std::string& name) { return table.has(name); })
      .def("__iter__", [](const Table& table) { return py::iter(column_names(table)); })
      .def("__len__", [](const Table& table) { return table.columns.size(); })
      .def("keys", &column_names, "Names of the columns, in the order of the file.")
      .def(
          "texts", [](const Table& table, const std::string& name) { return column(table, name).texts; },
          py::arg("name"), "The fields of a column as written; empty but for tables of CSV files.")
      .def(
          "unit", [](const Table& table, const std::string& name) { return column(table, name).unit; }, py::arg("name"),
          "SI unit of a column; empty: none, or not known.")
      .def_property_readonly("rows", &Table::rows, "Number of rows.")
      .def("__repr__", [](const Table& table) {
        return "<perfora.Table " + std::to_string(table.columns.size()) + " columns, " + std::to_string(table.rows()) +
               " rows>";
      });
}

void add_verdict(py::module_& module) {
  py::class_<Verdict, std::shared_ptr<Verdict>>(module, "Verdict", "Whether the wishes of a design are met.")
      .def_readonly("outcome", &Verdict::outcome,
                    "\"met\", \"missed\", \"not shown\", \"out of reach\"; empty: nothing was wished.")
      .def_readonly("text", &Verdict::text, "One line: the outcome and the wishes that decide it.")
      .def_readonly("note", &Verdict::note, "What the numbers are worth beyond their scatter.")
      .def("__repr__", [](const Verdict& verdict) { return "<perfora.Verdict " + verdict.outcome + ">"; });
}

/// Warnings are not in the record.
Evaluation unpickled(const std::string& json, std::vector<std::string> warnings) {
  Evaluation made = Evaluation::from_json(json);
  made.warnings = std::move(warnings);
  return made;
}

void add_evaluation(py::module_& module) {
  const auto curve = [](const char* name) {
    return [name](const std::shared_ptr<Evaluation>& evaluation) {
      const py::object table = py::cast(std::shared_ptr<Table>(evaluation, &evaluation->curve));
      return table.attr("__getitem__")(name);
    };
  };
  py::class_<Evaluation, std::shared_ptr<Evaluation>>(module, "Evaluation", "What one evaluation of a design gave.")
      .def_property_readonly(
          "status", [](const Evaluation& evaluation) { return name_of(evaluation.status); },
          "\"completed\", \"stopped\" or \"failed\".")
      .def_readonly("reason", &Evaluation::reason, "In words.")
      .def_readonly("replicate", &Evaluation::replicate, "Which packing and strength field: 0, 1, ...")
      .def_property_readonly(
          "measures", [](const Evaluation& evaluation) { return dict_of(evaluation.measures); },
          "Measures by their keys, each with its value and unit.")
      .def("__getitem__", &Evaluation::measure, py::arg("key"), "The value of a measure, SI; NaN: not reached.")
      .def_property_readonly("curve", part_of(&Evaluation::curve), "The history, a column a quantity.")
      .def_property_readonly("strain", curve("strain_yy"), "Engineering strain of the curve, compression positive.")
      .def_property_readonly("stress", curve("stress_yy"), "Stress of the curve, Pa, compression positive.")
      .def_readonly("warnings", &Evaluation::warnings, "What speaks against its numbers, a sentence each.")
      .def_property_readonly("verdict", part_of(&Evaluation::verdict), "On this one block, which shows little.")
      .def_readonly("seconds", &Evaluation::seconds, "Wall time of the compression, s.")
      .def_property_readonly(
          "record", [](const Evaluation& evaluation) { return from_json(evaluation.record); },
          "The record perfora.evaluate/1, what `perfora evaluate --json` prints.")
      .def("to_json", &Evaluation::to_json, py::arg("with_curve") = false,
           "The record as text; with the curve from_json() gives the same evaluation back.")
      .def_static("from_json", &Evaluation::from_json, py::arg("text"), "An evaluation from its record.")
      .def("__repr__",
           [](const Evaluation& evaluation) {
             return std::string("<perfora.Evaluation ") + name_of(evaluation.status) + ": " + evaluation.reason + ">";
           })
      .def(py::pickle(
          [](const Evaluation& evaluation) { return py::make_tuple(evaluation.to_json(true), evaluation.warnings); },
          [](const py::tuple& state) {
            return unpickled(state[0].cast<std::string>(), state[1].cast<std::vector<std::string>>());
          }));
}

void add_packing(py::module_& module) {
  py::class_<Discs, std::shared_ptr<Discs>>(module, "Discs", "Discs, m; the origin is the lower left corner.")
      .def_property_readonly("x", view_of(&Discs::x), "Of the centres, m.")
      .def_property_readonly("y", view_of(&Discs::y), "Of the centres, m.")
      .def_property_readonly("radius", view_of(&Discs::radius), "Of the discs, m.")
      .def("__len__", [](const Discs& discs) { return discs.x.size(); });
  py::class_<Outline, std::shared_ptr<Outline>>(module, "Outline",
                                                "Rim of an opening, a closed polygon, anticlockwise.")
      .def_property_readonly("x", view_of(&Outline::x), "Of the corners, m.")
      .def_property_readonly("y", view_of(&Outline::y), "Of the corners, m.")
      .def("__len__", [](const Outline& outline) { return outline.x.size(); });
  py::class_<Packing, std::shared_ptr<Packing>>(module, "Packing", "The discs that a block consists of.")
      .def_property_readonly(
          "status", [](const Packing& packing) { return name_of(packing.status); },
          "\"completed\", \"stopped\" or \"failed\" (the wanted density was not reached).")
      .def_readonly("reason", &Packing::reason, "In words.")
      .def_readonly("width", &Packing::width, "Of the block, m.")
      .def_readonly("height", &Packing::height, "Of the block, m.")
      .def_property_readonly("discs", part_of(&Packing::discs), "Those left between the openings.")
      .def_property_readonly("periodic", part_of(&Packing::periodic), "All, before the openings were cut out.")
      .def_property_readonly(
          "openings", [](const Packing& packing) { return packing.openings; }, "In the order of the layout.")
      .def_property_readonly(
          "measures", [](const Packing& packing) { return dict_of(packing.measures); },
          "Measures by their keys, each with its value and unit.")
      .def("__getitem__", &Packing::measure, py::arg("key"), "The value of a measure, SI; NaN: not known.")
      .def("__repr__", [](const Packing& packing) {
        return "<perfora.Packing " + std::to_string(packing.discs.x.size()) + " discs, " +
               std::to_string(packing.openings.size()) + " openings>";
      });
}

}  // namespace

void add_results(py::module_& module) {
  add_measure(module);
  add_table(module);
  add_verdict(module);
  add_evaluation(module);
  add_packing(module);
}

}  // namespace perfora::python
