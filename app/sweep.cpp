// What is here: `perfora sweep`: every case of a sweep file simulated by worker processes in a folder, then its tables
// and picture. What is not: the cases (optimize/campaign/sweep.h), the runs (optimize/campaign/sweep_run.h), drawing
// (report/).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands.h"
#include "app/common.h"
#include "app/workers.h"
#include "io/text.h"
#include "optimize/campaign/sweep_result.h"
#include "optimize/search/study.h"
#include "report/plot.h"
#include "report/plot_sweep.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;
using optimize::Sweep;
using optimize::SweepCase;

struct SweepFlags {
  CommonFlags common;
  std::string sweep, output;
  std::vector<std::string> only;
  bool resume = false;
  int workers = 0;
};

optimize::WorkOptions run_options(const SweepFlags& flags, const Sweep& sweep) {
  optimize::WorkOptions options;
  options.folder = output_or_default(flags.output, default_name(flags.sweep, "-result"));
  options.resume = flags.resume;
  options.force = flags.common.force;
  options.command_line = command_line();
  options.keep_run_files = sweep.keys.run_files;
  options.cancellation = stop_token();
  options.make_executor = worker_executor(sweep.workers(flags.workers), flags.common.thread_count());
  return options;
}

/// Number of `text` in `list`, appended where it is new.
int place_of(std::vector<std::string>& list, const std::string& text) {
  const auto found = std::find(list.begin(), list.end(), text);
  if (found == list.end()) list.push_back(text);
  return static_cast<int>(std::find(list.begin(), list.end(), text) - list.begin());
}

report::SweepPoint point_of(const optimize::SweepRun& run, const SweepCase& one) {
  report::SweepPoint point;
  std::vector<std::vector<double>> reached;  // by replicate
  for (int replicate = 0; replicate < run.sweep().keys.replicates; ++replicate)
    if (const optimize::Evaluation* evaluation = run.completed(one, replicate)) {
      point.curves.push_back({evaluation->curve.strain_yy, evaluation->curve.stress_yy});
      reached.push_back(optimize::measures_of(*evaluation));
    }
  const auto& names = optimize::sweep_measures();
  for (const std::string& name : run.sweep().measures) {
    const auto place = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    report::SweepValue value;
    for (const std::vector<double>& all : reached) value.replicates.push_back(all[place]);
    const results::Statistic statistic = results::statistic_of(name, value.replicates);
    value.mean = statistic.mean;
    value.half_interval = statistic.confidence_95;
    point.values.push_back(std::move(value));
  }
  return point;
}

/// What a case is called along x and among the series: one key of a grid runs along x, everything else that its label
/// says makes the series; rows without a grid stand along x under their names.
struct Names {
  std::string axis, place, series;
};
Names names_of(const Sweep& sweep, const SweepCase& one) {
  if (!one.group.empty()) return {one.settings.back().key, io::readable(one.settings.back().value), ""};
  for (const optimize::DesignChange& setting : one.settings) {
    if (setting.key != sweep.grid_key) continue;
    const std::string place = io::readable(setting.value);
    const std::string part = io::after_section(setting.key) + " " + place;
    std::string series = one.label;
    if (const auto at = series.rfind(part); at != std::string::npos) {
      const std::size_t before = at >= 2 ? at - 2 : 0;  // with the comma before it, or behind it where it comes first
      series.erase(before, part.size() + 2);
    }
    return {setting.key, place, series};
  }
  return {"", one.label, ""};
}

report::SweepPicture picture_of(const optimize::SweepRun& run) {
  const Sweep& sweep = run.sweep();
  report::SweepPicture picture;
  picture.title = sweep.file.stem().string();
  picture.subtitle =
      fmt::format("{} cases, {} replicate{} each; {}. Large: mean and its 95 % interval; small: replicates{}",
                  sweep.cases.size(), sweep.keys.replicates, sweep.keys.replicates == 1 ? "" : "s", run.reason(),
                  sweep.keys.base ? "; grey: the design itself" : "");
  picture.measures = sweep.measures;
  std::vector<std::string> groups;
  for (const SweepCase& one : sweep.cases) {
    if (!one.problem.empty()) continue;
    if (one.number == 0) {
      picture.base.push_back(point_of(run, one));
      continue;
    }
    const auto g = static_cast<std::size_t>(place_of(groups, one.group));
    if (g == picture.groups.size()) picture.groups.emplace_back();
    report::SweepGroup& group = picture.groups[g];
    const Names names = names_of(sweep, one);
    group.label = names.axis;
    report::SweepPoint point = point_of(run, one);
    point.place = place_of(group.places, names.place);
    point.series = place_of(group.series, names.series);
    group.points.push_back(std::move(point));
  }
  return picture;
}

/// collapse.png: the first replicate of every case whose run file was kept.
bool draw_collapse(const optimize::SweepRun& run) {
  std::vector<report::LabelledRun> rows;
  for (const SweepCase& one : run.sweep().cases) {
    if (!run.known(one, 0)) continue;
    const fs::path file = run.options().folder / optimize::EvaluationQueue::run_file(one.request(0));
    if (fs::exists(file)) rows.push_back({one.label, results::read_run(file)});
  }
  report::PlotOptions options;
  options.title = "How the cases of " + run.sweep().file.stem().string() + " collapse (replicate 0)";
  if (rows.empty()) return false;
  report::plot_collapse(rows, run.options().folder / "collapse.png", options);
  return true;
}

int sweep_designs(const SweepFlags& flags) {
  refuse_resume_with_force(flags.resume, flags.common.force);
  Sweep sweep = optimize::read_sweep(flags.sweep, flags.common.overrides(), flags.only);
  const optimize::WorkOptions options = run_options(flags, sweep);
  optimize::SweepRun run(std::move(sweep), options);
  log_warnings(run.sweep().warnings);
  io::log_info(fmt::format("{} cases, {} runs", run.sweep().cases.size(), run.sweep().runs()));
  if (run.sweep().left_out > 0)
    io::log_info(
        fmt::format("{} cases are left out by --only: the tables in {} show the others; --resume without it "
                    "runs the rest and shows all",
                    run.sweep().left_out, options.folder.string()));
  run.run();
  optimize::write_results(run);
  report::plot_sweep(picture_of(run), options.folder / "sweep.png");
  const bool collapse = draw_collapse(run);
  if (run.sweep().keys.run_files && !collapse)
    io::log_warning("no run file was kept: these simulations were run before sweep.run_files was set");
  const auto record = optimize::to_json(run);
  print_record(record, flags.common.json);
  if (run.status() == results::RunStatus::stopped)
    io::log_warning(
        fmt::format("stopped; what is finished is kept in {}; continue with --resume", options.folder.string()));
  else
    io::log_info(fmt::format("written: {} (cases.csv, runs.csv, curves.csv, result.json, picture{} sweep.png{})",
                             options.folder.string(), collapse ? "s" : "", collapse ? " and collapse.png" : ""));
  return exit_code_of(run.status());
}

}  // namespace

void add_sweep(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<SweepFlags>();
  CLI::App* command = program.add_subcommand("sweep", "Simulate a table of designs that differ in some keys");
  command->add_option("SWEEP", flags->sweep, "Sweep file (TOML)")->required();
  command->add_option("-o,--output", flags->output, "Folder for journal and results (default: SWEEP's name + -result)")
      ->type_name("DIR");
  command->add_flag("--resume", flags->resume,
                    "Continue a sweep that was stopped, killed or extended; finished runs are kept");
  add_only_flag(*command, flags->only, ", and the design itself where the sweep has it as a case");
  add_workers_flag(*command, flags->workers, "sweep");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    exit_code = sweep_designs(*flags);
  });
}

}  // namespace perfora::app
