// What is here: designs and their keys in Python: made of files, mappings and TOML, read and set like a mapping. What
// is not: what the keys mean (docs/user/design-files.md).
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <map>
#include <utility>

#include "bindings/bind.h"

namespace perfora::python {

namespace {

using Entries = std::vector<std::pair<std::string, py::object>>;

bool is_mapping(const py::handle& value) {
  return py::isinstance(value, py::module_::import("collections.abc").attr("Mapping"));
}

/// Entries of nested mappings under their full names.
void flatten(const py::object& mapping, const std::string& before, Entries& entries) {
  for (const py::handle item : mapping.attr("items")()) {
    const auto [key, value] = item.cast<std::pair<std::string, py::object>>();
    if (is_mapping(value))
      flatten(value, before + key + ".", entries);
    else
      entries.emplace_back(before + key, value);
  }
}

Entries entries_of(const py::object& mapping) {
  Entries entries;
  flatten(mapping, "", entries);
  return entries;
}

std::string quoted(const std::string& text) {
  // A TOML basic string takes every escape that JSON writes.
  return py::module_::import("json").attr("dumps")(text, py::arg("ensure_ascii") = false).cast<std::string>();
}

/// A value in TOML syntax.
std::string literal(const std::string& key, const py::object& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::str>(value)) return quoted(value.cast<std::string>());
  if (py::hasattr(value, "__fspath__")) return quoted(py::str(value));
  if (py::isinstance<py::int_>(value)) return py::str(value);
  if (py::isinstance<py::float_>(value)) return py::repr(py::float_(value));  // of NumPy, too
  if (py::hasattr(value, "tolist")) return literal(key, value.attr("tolist")());
  if (!py::isinstance<py::list>(value) && !py::isinstance<py::tuple>(value))
    throw Error(key + ": takes no " + py::str(py::type::of(value).attr("__name__")).cast<std::string>() +
                "; a text, a number, a bool or a list is wanted");
  std::string text;
  for (const py::handle one : value)
    text += (text.empty() ? "" : ", ") + literal(key, py::reinterpret_borrow<py::object>(one));
  return "[" + text + "]";
}

/// As `--set` takes it: texts bare, so that units and names need no quotes.
std::string set_text(const std::string& key, const py::object& value) {
  return py::isinstance<py::str>(value) ? value.cast<std::string>() : literal(key, value);
}

bool is_bare(const std::string& part) {
  return !part.empty() && std::all_of(part.begin(), part.end(),
                                      [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
}

/// "layout.diameter" as TOML writes it.
std::string toml_key(const std::string& name) {
  std::string key;
  for (std::size_t from = 0; from <= name.size();) {
    const std::size_t dot = std::min(name.find('.', from), name.size());
    const std::string part = name.substr(from, dot - from);
    key += (from == 0 ? "" : ".") + (is_bare(part) ? part : quoted(part));
    from = dot + 1;
  }
  return key;
}

/// Elements of lists ("layout.row_diameter[0]") are no keys of a file: they are set when the lists are there.
Design from_mapping(const py::object& mapping) {
  std::string text;
  Entries elements;
  for (const auto& [key, value] : entries_of(mapping))
    if (key.ends_with("]"))
      elements.emplace_back(key, value);
    else
      text += toml_key(key) + " = " + literal(key, value) + "\n";
  Design design = Design::from_toml(text, "design");
  for (const auto& [key, value] : elements) design.set(key, set_text(key, value));
  return design;
}

const std::vector<Key>& all_keys() {
  static const std::vector<Key> keys = Design::keys();
  return keys;
}

const Key* key_called(const std::string& name) {
  const auto found =
      std::find_if(all_keys().begin(), all_keys().end(), [&](const Key& key) { return key.name == name; });
  return found == all_keys().end() ? nullptr : &*found;
}

py::list names() {
  py::list found;
  for (const Key& key : all_keys()) found.append(key.name);
  return found;
}

/// A list of numbers, or of rows of them; what holds a word or one number here is that.
py::object numbers_of(std::string text) {
  if (text.empty() || text.front() != '[') {
    try {
      return py::float_(py::str(text));
    } catch (const py::error_already_set&) {
      return py::str(text);
    }
  }
  const std::size_t end = text.size() - 1;  // rows stand on lines of their own, each with a comma behind it
  const std::size_t last = text.find_last_not_of(" \n", end - 1);
  if (last != std::string::npos && text[last] == ',') text.erase(last, 1);
  return from_json(text);
}

py::object value_of_key(const Design& design, const std::string& name) {
  const Key* key = key_called(name);
  if (!key) return py::float_(design.number(name));  // an element of a list, or an Error that names the nearest key
  const std::string text = design.text(name);
  switch (key->type) {
    case KeyType::real:
      return py::float_(design.number(name));
    case KeyType::integer:
      return py::int_(static_cast<long long>(design.number(name)));
    case KeyType::boolean:
      return py::bool_(text == "true");
    case KeyType::real_list:
    case KeyType::real_rows:
      return numbers_of(text);
    case KeyType::text:
    case KeyType::choice:
    case KeyType::path:
      break;
  }
  return py::str(text);
}

const char* name_of(KeyType type) {
  static const std::map<KeyType, const char*> known = {
      {KeyType::real, "real"},           {KeyType::integer, "integer"},    {KeyType::boolean, "boolean"},
      {KeyType::text, "text"},           {KeyType::choice, "choice"},      {KeyType::path, "path"},
      {KeyType::real_list, "real list"}, {KeyType::real_rows, "real rows"}};
  return known.at(type);
}

Design made(const py::object& source, const py::object& changes) {
  Design design = source.is_none() ? Design() : design_from(source);
  if (!changes.is_none()) set_all(design, py::dict(changes));
  return design;
}

void add_key(py::module_& module) {
  py::class_<Key>(module, "Key", "One key that a design may set.")
      .def_readonly("name", &Key::name, "With its section: \"layout.diameter\".")
      .def_property_readonly(
          "type", [](const Key& key) { return name_of(key.type); },
          "\"real\", \"integer\", \"boolean\", \"text\", \"choice\", \"path\", \"real list\" or \"real rows\".")
      .def_readonly("dimension", &Key::dimension, "\"length\", \"stress\", ...; empty: a plain number or no number.")
      .def_readonly("unit", &Key::unit, "SI unit of plain numbers; empty: none.")
      .def_readonly("default", &Key::default_text, "The default, in TOML syntax.")
      .def_readonly("range", &Key::range, "The numbers allowed, for people.")
      .def_readonly("choices", &Key::choices, "What a choice allows.")
      .def_readonly("help", &Key::help, "One clause.")
      .def("__repr__", [](const Key& key) { return "<perfora.Key " + key.name + ">"; });
  module.def("keys", [] { return all_keys(); });
}

}  // namespace

Design design_from(const py::object& source) {
  if (py::isinstance<Design>(source)) return source.cast<Design>();
  if (is_mapping(source)) return from_mapping(source);
  if (py::isinstance<py::str>(source) || py::hasattr(source, "__fspath__"))
    return Design::from_file(py::str(source).cast<std::string>());
  throw py::type_error("a design is a perfora.Design, a mapping of keys or the path of a design file");
}

void set_all(Design& design, const py::dict& changes) {
  Design changed = design;  // all or nothing
  for (const auto& [key, value] : entries_of(changes)) changed.set(key, set_text(key, value));
  design = std::move(changed);
}

std::vector<std::string> overrides_from(const py::object& changes) {
  std::vector<std::string> overrides;
  if (changes.is_none()) return overrides;
  for (const auto& [key, value] : entries_of(changes)) overrides.push_back(key + "=" + set_text(key, value));
  return overrides;
}

void add_designs(py::module_& module) {
  add_key(module);
  py::class_<Design, std::shared_ptr<Design>>(module, "Design",
                                              "Every option of one block and its simulation; numbers are SI.\n\n"
                                              "source: nothing (the block of the paper's Table 1), the path of a "
                                              "design file, a mapping of keys (nested or\n"
                                              "flat: {\"layout.diameter\": \"7 mm\"}) or another design. changes: "
                                              "keys set afterwards.")
      .def(py::init(&made), py::arg("source") = py::none(), py::arg("changes") = py::none())
      .def_static("from_toml", &Design::from_toml, py::arg("text"), py::arg("name") = "text",
                  "A design from the text of a design file; name stands for the file in messages.")
      .def("__getitem__", &value_of_key, py::arg("key"), "The value of a key; numbers in SI.")
      .def(
          "__setitem__",
          [](Design& design, const std::string& key, const py::object& value) {
            design.set(key, set_text(key, value));
          },
          py::arg("key"), py::arg("value"),
          "Sets a key: a number (SI), a text with unit (\"20 mm\", \"25 %\"), a bool or a list.")
      .def("__contains__", [](const Design&, const std::string& key) { return key_called(key) != nullptr; })
      .def("__iter__", [](const Design&) { return py::iter(names()); })
      .def("__len__", [](const Design&) { return all_keys().size(); })
      .def(
          "keys", [](const Design&) { return names(); }, "Names of all keys.")
      .def(
          "set", [](Design& design, const py::dict& changes) { set_all(design, changes); }, py::arg("changes"),
          "Sets all keys of a mapping (nested or flat), or none where one is wrong.")
      .def(
          "with_changes",
          [](const Design& design, const py::dict& changes) {
            Design copy = design;
            set_all(copy, changes);
            return copy;
          },
          py::arg("changes"), "A copy with other values.")
      .def("check", &Design::check,
           "Checks what can be checked without placing discs. Returns warnings; raises InputError for a design that\n"
           "cannot be evaluated.")
      .def("to_toml", &Design::to_toml, "The complete design as TOML, in SI, with all digits.")
      .def("__copy__", [](const Design& design) { return Design(design); })
      .def("__deepcopy__", [](const Design& design, const py::dict&) { return Design(design); })
      .def("__eq__",
           [](const Design& a, const py::object& b) {
             return py::isinstance<Design>(b) && a.to_toml() == b.cast<const Design&>().to_toml();
           })
      .def("__repr__",
           [](const Design& design) {
             return "<perfora.Design " + design.text("layout.family") + ", " + design.text("cell.width") + " m x " +
                    design.text("cell.height") + " m>";
           })
      .def(py::pickle([](const Design& design) { return design.to_toml(); },
                      [](const std::string& text) { return Design::from_toml(text, "pickle"); }))
      .attr("__hash__") = py::none();
}

}  // namespace perfora::python
