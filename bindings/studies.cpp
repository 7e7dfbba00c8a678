// What is here: a study that asks for evaluations and is told them, in Python. What is not: studies that evaluate by
// themselves (work.cpp).
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings/bind.h"
#include "bindings/watched.h"
#include "perfora/study.h"

namespace perfora::python {

namespace {

namespace fs = std::filesystem;
using NoGil = py::call_guard<py::gil_scoped_release>;

void add_trial(py::module_& module) {
  py::class_<Trial>(module, "Trial", "One evaluation that a study wants; may be pickled and evaluated anywhere.")
      .def_readonly("key", &Trial::key, "Its name within the study.")
      .def_readonly("label", &Trial::label, "Of its candidate, for people.")
      .def_readonly("replicate", &Trial::replicate, "Which packing and strength field: 0, 1, ...")
      .def_readonly("request", &Trial::request, "All of it as JSON.")
      .def_property_readonly("design", &Trial::design, "The design as it is to be run.")
      .def(
          "evaluate",
          [](const Trial& trial, int threads, const std::optional<fs::path>& run_file) {
            TrialOptions options;
            options.threads = threads;
            options.run_file = run_file.value_or(fs::path());
            return watched(py::none(), [&](const ProgressCallback&, std::shared_ptr<Stop> stop) {
              options.stop = std::move(stop);
              return evaluate_trial(trial.request, options);
            });
          },
          py::kw_only(), py::arg("threads") = 1, py::arg("run_file") = py::none(),
          "Evaluates it; needs nothing of the study. run_file: R.h5 to write, or to go on from. A design that cannot "
          "be\n"
          "evaluated is the status \"failed\", which the study is told, too.")
      .def("__repr__",
           [](const Trial& trial) {
             return "<perfora.Trial " + trial.label + ", replicate " + std::to_string(trial.replicate) + ">";
           })
      .def(py::pickle(
          [](const Trial& trial) { return py::make_tuple(trial.key, trial.label, trial.replicate, trial.request); },
          [](const py::tuple& state) {
            return Trial{state[0].cast<std::string>(), state[1].cast<std::string>(), state[2].cast<int>(),
                         state[3].cast<std::string>()};
          }));
}

}  // namespace

void add_studies(py::module_& module) {
  add_trial(module);
  py::class_<Study>(module, "Study",
                    "The search of a study file, in a folder that it alone may use until it is closed. What it asks\n"
                    "depends on what it was told only, not on the order or on who evaluated. `with` closes it.\n\n"
                    "changes: keys of the file or its design. resume: go on with what the folder has. force: remove\n"
                    "an earlier study first.")
      .def(py::init(
               [](const fs::path& file, const fs::path& folder, const py::object& changes, bool resume, bool force) {
                 const StudyOptions options{folder, overrides_from(changes), resume, force};
                 const py::gil_scoped_release released;
                 return std::make_unique<Study>(file, options);
               }),
           py::arg("file"), py::arg("folder"), py::kw_only(), py::arg("changes") = py::none(),
           py::arg("resume") = false, py::arg("force") = false)
      .def("ask", &Study::ask, py::arg("most") = 0, py::kw_only(), py::arg("again") = false, NoGil(),
           "Trials that can be evaluated now, at most `most` (0: all), none that was given before unless `again`. "
           "Empty\n"
           "where everything waits for those given before, and once the study is finished.")
      .def("tell", &Study::tell, py::arg("trial"), py::arg("evaluation"), NoGil(),
           "Writes the evaluation of a trial into the journal; then ask() has what follows from it. A trial that was\n"
           "told before is left alone.")
      .def_property_readonly(
          "finished",
          [](Study& study) {
            const py::gil_scoped_release released;
            return study.finished();
          },
          "Whether nothing is left to ask.")
      .def(
          "close", &Study::close, NoGil(),
          "Writes the results into the folder, gives it free and reads it back. One that is not finished goes on with\n"
          "resume.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](Study& study, const py::args&) {
        const py::gil_scoped_release released;
        static_cast<void>(study.close());
      });
}

}  // namespace perfora::python
