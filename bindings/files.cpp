// What is here: result files read in Python: runs with their frames, elastic responses, material tests, tables,
// records. What is not: folders of campaigns (studies.cpp).
#include "perfora/files.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings/bind.h"

namespace perfora::python {

namespace {

namespace fs = std::filesystem;
using NoGil = py::call_guard<py::gil_scoped_release>;

/// A reference of the run file as a part that keeps all of it alive.
template <class Part>
auto part_of_run(const Part& (RunFile::*function)() const) {
  return [function](const std::shared_ptr<RunFile>& file) {
    const Part& part = (file.get()->*function)();
    return std::shared_ptr<Part>(file, const_cast<Part*>(&part));  // bound without anything that writes
  };
}

void add_frame(py::module_& module) {
  py::class_<Frame, std::shared_ptr<Frame>>(module, "Frame", "n discs and the m bonds that are intact, at one strain.")
      .def_readonly("strain", &Frame::strain, "Engineering, compression positive.")
      .def_readonly("time", &Frame::time, "s.")
      .def_readonly("width", &Frame::width, "Of the block at that strain, m.")
      .def_readonly("height", &Frame::height, "Of the block at that strain, m.")
      .def_readonly("shear", &Frame::shear, "By which the upper edge is displaced, m.")
      .def_property_readonly("position", view_of(&Frame::position, 2), "(n,2), m, from the lower left corner.")
      .def_property_readonly("angle", view_of(&Frame::angle), "(n), rad.")
      .def_property_readonly("fragment", view_of(&Frame::fragment), "(n), the fragment a disc is of; 0: the largest.")
      .def_property_readonly("damage", view_of(&Frame::damage), "(n), share of the original bonds lost.")
      .def_property_readonly("bonds", view_of(&Frame::bonds, 2), "(m,2), discs.")
      .def_property_readonly("bond_damage", view_of(&Frame::bond_damage), "(m), damage of each bond, 0 to 1.")
      .def_property_readonly("velocity", view_of(&Frame::velocity, 2),
                             "(n,2), m/s, beyond the affine motion of the block; empty unless output.frame_data is "
                             "\"all\", as all below.")
      .def_property_readonly("spin", view_of(&Frame::spin), "(n), rad/s.")
      .def_property_readonly("stress", view_of(&Frame::stress, 3),
                             "(n,3), xx, yy, xy over the disc's area, Pa, compression positive.")
      .def_property_readonly("bond_normal_force", view_of(&Frame::bond_normal_force), "(m), N/m, tension positive.")
      .def_property_readonly("bond_shear_force", view_of(&Frame::bond_shear_force), "(m), N/m.")
      .def_property_readonly("contacts", view_of(&Frame::contacts, 2), "(c,2), discs that touch.")
      .def_property_readonly("contact_normal_force", view_of(&Frame::contact_normal_force),
                             "(c), N/m, compression positive.")
      .def_property_readonly("contact_shear_force", view_of(&Frame::contact_shear_force), "(c), N/m.")
      .def("__repr__", [](const Frame& frame) {
        return "<perfora.Frame at strain " + py::str(py::float_(frame.strain)).cast<std::string>() + ">";
      });
}

/// As Python counts: -1 is the last one.
Frame frame_at(const RunFile& file, long long index) {
  const auto frames = static_cast<long long>(file.frames());
  if (index < -frames || index >= frames) throw py::index_error("the run has " + std::to_string(frames) + " frames");
  const auto place = static_cast<std::size_t>(index < 0 ? index + frames : index);
  const py::gil_scoped_release released;
  return file.frame(place);
}

void add_run(py::module_& module) {
  py::class_<Bonds, std::shared_ptr<Bonds>>(module, "Bonds", "All bonds that a run began with, m of them.")
      .def_property_readonly("discs", view_of(&Bonds::discs, 2), "(m,2), the smaller number first.")
      .def_property_readonly("reference_length", view_of(&Bonds::reference_length), "(m), m.")
      .def_property_readonly("strength_factor", view_of(&Bonds::strength_factor),
                             "(m), strength over that of the material.")
      .def("__len__", [](const Bonds& bonds) { return bonds.reference_length.size(); });
  py::class_<RunFile, std::shared_ptr<RunFile>>(module, "Run", "A run file R.h5, all of it.")
      .def_property_readonly(
          "evaluation",
          [](const std::shared_ptr<RunFile>& file) {
            return std::shared_ptr<Evaluation>(file, const_cast<Evaluation*>(&file->run().evaluation));
          },
          "Its result.")
      .def_property_readonly(
          "design", [](const RunFile& file) { return Design::from_toml(file.run().design, "run file"); },
          "The design that was run.")
      .def_property_readonly(
          "program_version", [](const RunFile& file) { return file.run().program_version; }, "That wrote it.")
      .def_property_readonly(
          "frame_strains",
          [](const py::object& self) {
            const std::vector<double>& strains = self.cast<const RunFile&>().run().frame_strains;
            return view(self, strains.data(), strains.size());
          },
          "Engineering strain of each frame, rising.")
      .def("frame", &frame_at, py::arg("index"), "Reads a frame from the file; -1: the last one.")
      .def_property_readonly("discs", part_of_run(&RunFile::discs), "The discs before the compression.")
      .def_property_readonly(
          "openings", [](const RunFile& file) { return file.openings(); }, "Openings before the compression.")
      .def_property_readonly("bonds", part_of_run(&RunFile::bonds), "The bonds before the compression.")
      .def_property_readonly("events", part_of_run(&RunFile::events),
                             "Broken bonds, a row each: time (s), strain, bond, i, j, x, y (m), mode (0 tension, 1\n"
                             "shear), energy (J/m).")
      .def("__repr__", [](const RunFile& file) {
        return "<perfora.Run " + file.run().evaluation.reason + ", " + std::to_string(file.frames()) + " frames>";
      });
}

py::array matrix(const py::object& owner, const std::array<double, 9>& values) {
  return view(owner, values.data(), values.size(), 3);
}

void add_elastic(py::module_& module) {
  py::class_<ElasticResponse, std::shared_ptr<ElasticResponse>>(module, "ElasticResponse",
                                                                "The linear response of a block of n discs.")
      .def_property_readonly(
          "stiffness",
          [](const py::object& self) { return matrix(self, self.cast<const ElasticResponse&>().stiffness); },
          "(3,3) of xx, yy, xy with engineering shear, Pa.")
      .def_property_readonly(
          "affine_stiffness",
          [](const py::object& self) { return matrix(self, self.cast<const ElasticResponse&>().affine_stiffness); },
          "The same without relaxation, Pa.")
      .def_property_readonly("discs", part_of(&ElasticResponse::discs), "Of the block.")
      .def_property_readonly(
          "openings", [](const ElasticResponse& response) { return response.openings; }, "Of the block.")
      .def_property_readonly(
          "displacement",
          [](const py::object& self) {
            py::list three;
            for (const auto& one : self.cast<const ElasticResponse&>().displacement)
              three.append(view(self, one.data(), one.size(), 3));
            return three;
          },
          "Three arrays (n,3), for unit strain xx, yy, xy: x and y in m, rotation in rad.")
      .def_property_readonly("disc_strain", view_of(&ElasticResponse::disc_strain),
                             "(n), strain at which the first bond of a disc yields; infinite: none does.")
      .def_property_readonly("first_bonds", part_of(&ElasticResponse::first_bonds), "Bonds that yield first.")
      .def_property_readonly(
          "design", [](const ElasticResponse& response) { return Design::from_toml(response.design, "elastic file"); },
          "The design.")
      .def_property_readonly(
          "record", [](const ElasticResponse& response) { return from_json(response.record); }, "The file's record.");
}

void add_material(py::module_& module) {
  py::class_<MaterialTest, std::shared_ptr<MaterialTest>>(module, "MaterialTest", "One test of a solid sample.")
      .def_readonly("name", &MaterialTest::name, "\"tension\", \"compression\", \"shear\", \"oedometric\".")
      .def_readonly("replicate", &MaterialTest::replicate, "0, 1, ...")
      .def_property_readonly("curve", part_of(&MaterialTest::curve),
                             "strain, stress (Pa), lateral_strain, lateral_stress (Pa), damage, work, cundall (J/m),\n"
                             "broken_bonds.");
  py::class_<MaterialTests, std::shared_ptr<MaterialTests>>(module, "MaterialTests", "The tests of one material.")
      .def_property_readonly(
          "tests",
          [](const std::shared_ptr<MaterialTests>& all) {
            std::vector<std::shared_ptr<MaterialTest>> tests;
            for (MaterialTest& one : all->tests) tests.emplace_back(all, &one);
            return tests;
          },
          "By name, then by replicate.")
      .def_property_readonly("sample", part_of(&MaterialTests::sample), "Discs of the sample.")
      .def_property_readonly(
          "design", [](const MaterialTests& all) { return Design::from_toml(all.design, "file of material tests"); },
          "The design.")
      .def_property_readonly(
          "record", [](const MaterialTests& all) { return from_json(all.record); }, "The file's record.");
}

}  // namespace

void add_files(py::module_& module) {
  add_frame(module);
  add_run(module);
  add_elastic(module);
  add_material(module);
  module.def(
      "read_run", [](const fs::path& file) { return std::make_shared<RunFile>(file); }, py::arg("file"), NoGil());
  module.def("read_packing", &read_packing, py::arg("file"), NoGil());
  module.def("read_elastic", &read_elastic, py::arg("file"), NoGil());
  module.def("read_material_tests", &read_material_tests, py::arg("file"), NoGil());
  module.def("read_table", &read_table, py::arg("file"), NoGil());
  module.def("kind_of", &kind_of, py::arg("path"), NoGil());
  module.def(
      "stored_record",
      [](const fs::path& path) {
        std::string text;
        {
          const py::gil_scoped_release released;
          text = stored_record(path);
        }
        return from_json(text);
      },
      py::arg("path"));
}

}  // namespace perfora::python
