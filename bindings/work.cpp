// What is here: packing, evaluating and campaigns in Python, with progress and Ctrl-C. What is not: studies that ask
// (studies.cpp), reading files (files.cpp).
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings/bind.h"
#include "bindings/watched.h"
#include "perfora/campaign.h"
#include "perfora/pack.h"

namespace perfora::python {

namespace {

namespace fs = std::filesystem;

fs::path path_from(const std::optional<fs::path>& path) {
  return path.value_or(fs::path());
}

void add_progress(py::module_& module) {
  py::class_<Progress>(module, "Progress", "How far work has come.")
      .def_readonly("fraction", &Progress::fraction, "Done, 0 to 1; a smaller one than before is of the next part.")
      .def_readonly("text", &Progress::text, "For people.")
      .def_readonly("strain", &Progress::strain, "Of a compression; NaN of other work.")
      .def_readonly("stress", &Progress::stress, "Of a compression, Pa; NaN of other work.")
      .def_readonly("finished", &Progress::finished, "Evaluations of a campaign.")
      .def_readonly("remaining", &Progress::remaining, "Evaluations of a campaign that may still come, at most.")
      .def_readonly("seconds", &Progress::seconds, "Wall time so far, s.")
      .def_readonly("seconds_left", &Progress::seconds_left, "Expected, s; NaN while it is not known.")
      .def("__repr__", [](const Progress& progress) { return "<perfora.Progress " + progress.text + ">"; });
}

void add_pack(py::module_& module) {
  module.def(
      "pack",
      [](const py::object& source, int replicate, int threads, const std::optional<fs::path>& file, bool force,
         const py::object& progress) {
        const Design design = design_from(source);
        PackOptions options;
        options.replicate = replicate;
        options.threads = threads;
        options.file = path_from(file);
        options.force = force;
        return watched(progress, [&](ProgressCallback callback, std::shared_ptr<Stop> stop) {
          options.progress = std::move(callback);
          options.stop = std::move(stop);
          return pack(design, options);
        });
      },
      py::arg("design"), py::kw_only(), py::arg("replicate") = 0, py::arg("threads") = 0, py::arg("file") = py::none(),
      py::arg("force") = false, py::arg("progress") = py::none());
}

void add_evaluate(py::module_& module) {
  module.def(
      "evaluate",
      [](const py::object& source, int replicate, int threads, const std::optional<fs::path>& run_file,
         const std::optional<fs::path>& packing_file, bool resume, bool force, double wall_time, double memory,
         const py::object& progress) {
        const Design design = design_from(source);
        EvaluateOptions options;
        options.replicate = replicate;
        options.threads = threads;
        options.run_file = path_from(run_file);
        options.packing_file = path_from(packing_file);
        options.resume = resume;
        options.force = force;
        options.wall_time = wall_time;
        options.memory = memory;
        return watched(progress, [&](ProgressCallback callback, std::shared_ptr<Stop> stop) {
          options.progress = std::move(callback);
          options.stop = std::move(stop);
          return evaluate(design, options);
        });
      },
      py::arg("design"), py::kw_only(), py::arg("replicate") = 0, py::arg("threads") = 0,
      py::arg("run_file") = py::none(), py::arg("packing_file") = py::none(), py::arg("resume") = false,
      py::arg("force") = false, py::arg("wall_time") = 0.0, py::arg("memory") = 0.0, py::arg("progress") = py::none());
  module.def(
      "score",
      [](const py::object& source, const std::vector<Evaluation>& replicates) {
        return score(design_from(source), replicates);
      },
      py::arg("design"), py::arg("replicates"));
}

CampaignOptions campaign_options(const fs::path& folder, int threads, bool resume, bool force) {
  CampaignOptions options;
  options.folder = folder;
  options.threads = threads;
  options.resume = resume;
  options.force = force;
  return options;
}

void add_campaigns(py::module_& module) {
  py::class_<Campaign, std::shared_ptr<Campaign>>(module, "Campaign", "What is in the folder of a campaign.")
      .def_readonly("kind", &Campaign::kind, "\"study\", \"sweep\", \"ensemble\" or \"calibration\".")
      .def_readonly("folder", &Campaign::folder, "Where it lies.")
      .def_property_readonly(
          "status", [](const Campaign& campaign) { return name_of(campaign.status); },
          "\"completed\", \"stopped\" (also while it is under way) or \"failed\".")
      .def_readonly("reason", &Campaign::reason, "In words.")
      .def_property_readonly(
          "rows", part_of(&Campaign::rows),
          "A row a candidate of a study, a case of a sweep, a replicate of an ensemble, a point of a\n"
          "calibration.")
      .def_readonly("best", &Campaign::best, "The best design of a study, the design with calibrated parameters; None.")
      .def_property_readonly("verdict", part_of(&Campaign::verdict), "Of a study (on fresh seeds) or an ensemble.")
      .def_property_readonly(
          "record", [](const Campaign& campaign) { return from_json(campaign.record); },
          "The record of the result; None before there is one.")
      .def("__repr__", [](const Campaign& campaign) {
        return "<perfora.Campaign " + campaign.kind + ", " + name_of(campaign.status) + ": " + campaign.reason + ">";
      });
  module.def(
      "run_campaign",
      [](const fs::path& file, const fs::path& folder, const py::object& changes, int workers, int threads, bool resume,
         bool force, const std::optional<fs::path>& program, bool best_run_file, const py::object& progress) {
        CampaignOptions options = campaign_options(folder, threads, resume, force);
        options.overrides = overrides_from(changes);
        options.workers = workers;
        options.program = path_from(program);
        options.best_run_file = best_run_file;
        return watched(progress, [&](ProgressCallback callback, std::shared_ptr<Stop> stop) {
          options.progress = std::move(callback);
          options.stop = std::move(stop);
          return run_campaign(file, options);
        });
      },
      py::arg("file"), py::arg("folder"), py::kw_only(), py::arg("changes") = py::none(), py::arg("workers") = 0,
      py::arg("threads") = 0, py::arg("resume") = false, py::arg("force") = false, py::arg("program") = py::none(),
      py::arg("best_run_file") = true, py::arg("progress") = py::none());
  module.def(
      "run_ensemble",
      [](const py::object& source, int replicates, const fs::path& folder, int threads, bool resume, bool force,
         const py::object& progress) {
        const Design design = design_from(source);
        CampaignOptions options = campaign_options(folder, threads, resume, force);
        return watched(progress, [&](ProgressCallback callback, std::shared_ptr<Stop> stop) {
          options.progress = std::move(callback);
          options.stop = std::move(stop);
          return run_ensemble(design, replicates, options);
        });
      },
      py::arg("design"), py::arg("replicates"), py::arg("folder"), py::kw_only(), py::arg("threads") = 0,
      py::arg("resume") = false, py::arg("force") = false, py::arg("progress") = py::none());
  module.def("read_campaign", &read_campaign, py::arg("folder"), py::call_guard<py::gil_scoped_release>());
}

}  // namespace

void add_work(py::module_& module) {
  add_progress(module);
  add_pack(module);
  add_evaluate(module);
  add_campaigns(module);
}

}  // namespace perfora::python
