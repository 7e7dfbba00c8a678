// What is here: `perfora optimize`: the search of a study file carried out in a folder by worker processes, then the
// best design's run file and pictures. What is not: the search (optimize/search/driver.h), its folder
// (optimize/search/study_run.h), drawing (report/).
#include <fmt/format.h>

#include <algorithm>

#include "app/commands.h"
#include "app/common.h"
#include "app/outputs.h"
#include "app/workers.h"
#include "geometry/layout.h"
#include "io/hdf5.h"
#include "io/text.h"
#include "optimize/evaluate/evaluation.h"
#include "optimize/search/study_result.h"
#include "optimize/search/study_run.h"
#include "report/plot.h"
#include "report/plot_study.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;

struct OptimizeFlags {
  CommonFlags common;
  std::string study, output;
  bool resume = false;
  bool no_run_file = false;
  int workers = 0;
};

optimize::WorkOptions run_options(const OptimizeFlags& flags, const optimize::Study& study) {
  optimize::WorkOptions options;
  options.folder = output_or_default(flags.output, default_name(flags.study, "-result"));
  options.resume = flags.resume;
  options.force = flags.common.force;
  options.command_line = command_line();
  options.cancellation = stop_token();
  options.make_executor = worker_executor(optimize::useful_workers(study, flags.workers), flags.common.thread_count());
  return options;
}

void announce(const optimize::Study& study) {
  log_warnings(study.warnings);
  for (const optimize::Arm& arm : study.arms)
    io::log_info(fmt::format("arm {}: {} candidates, {}", arm.name, arm.maxeval, study.keys.algorithm));
  io::log_info(fmt::format("target {} over strain {:g} to {:g}; {} replicate{} a candidate",
                           io::quantity(study.target.plateau_stress, io::Dimension::stress), study.target.window[0],
                           study.target.window[1], study.keys.replicates, study.keys.replicates == 1 ? "" : "s"));
}

/// Whether the run file there is of this very design.
bool is_run_of(const fs::path& run_file, const optimize::DesignFile& design) {
  return io::Hdf5Reader(run_file).text("/config") == design.schema().to_toml();
}

/// The best design once more (replicate 0) with its frames: best.h5, its CSV and XDMF. The search itself keeps coarse
/// curves only.
results::RunStatus run_best(const OptimizeFlags& flags, optimize::StudyRun& run) {
  const optimize::DesignFile design = optimize::design_of(run.study(), *run.plan().best);
  const fs::path run_file = run.options().folder / "best.h5";
  if (fs::exists(run_file) && !is_run_of(run_file, design)) {  // an earlier best, before maxeval was raised
    fs::remove(run_file);
    fs::remove_all(run.options().folder / "best.part");
  }
  ProgressLine progress("best design", flags.common.quiet);
  optimize::EvaluateOptions options;
  options.threads = flags.common.thread_count();
  options.run_file = run_file;
  options.resume = true;
  options.cancellation = stop_token();
  options.command_line = command_line();
  options.progress = progress.callback();
  const optimize::Evaluation evaluation = optimize::evaluate_design(design, options, 0);
  progress.finish(evaluation.reason);
  if (fs::exists(run_file)) write_beside(run_file);
  return evaluation.status;
}

using optimize::Candidate;
using optimize::Study;

geometry::PerforationLayout layout_of(const optimize::DesignFile& design) {
  return geometry::place_perforations(design.design().layout, design.design().seeds.effective(0).layout);
}

/// Curves on the fresh seeds where they were run, otherwise of the search.
std::vector<const optimize::Evaluation*> shown(optimize::StudyRun& run, const Candidate& candidate) {
  const auto& keys = run.study().keys;
  const auto fresh = run.known(candidate, keys.replicates, keys.final_replicates);
  return fresh.empty() ? run.known(candidate, 0, keys.replicates) : fresh;
}

std::vector<report::StudyCurve> curves(const std::vector<const optimize::Evaluation*>& evaluations) {
  std::vector<report::StudyCurve> curves;
  for (const auto* evaluation : evaluations)
    if (optimize::usable(*evaluation)) curves.push_back({evaluation->curve.strain_yy, evaluation->curve.stress_yy});
  return curves;
}

void add_points(report::StudyPicture& picture, const optimize::StudyRun& run) {
  for (const optimize::Trace& trace : run.plan().traces)
    for (const optimize::Visit& visit : trace.visits) {
      if (!visit.answered) continue;
      report::StudyEvaluation point;
      point.number = static_cast<int>(picture.evaluations.size()) + 1;
      point.arm = run.study().arms[static_cast<std::size_t>(trace.arm)].name + (trace.refine ? " (refine)" : "");
      point.values = visit.candidate->values;
      point.feasible = visit.candidate->violation <= 0.0;
      if (visit.detail.valid) point.score = visit.score;
      if (visit.candidate == run.plan().best && picture.best_number == 0) picture.best_number = point.number;
      picture.evaluations.push_back(std::move(point));
    }
}

void add_facts(report::StudyPicture& picture, const optimize::StudyRun& run) {
  const Study& study = run.study();
  const Candidate& best = *run.plan().best;
  const Candidate& start = *run.plan().start.candidate;
  const auto& schema = study.start->schema();
  for (const optimize::DesignChange& choice : study.arms[static_cast<std::size_t>(best.arm)].choices)
    picture.facts.push_back({choice.key.substr(choice.key.find('.') + 1), io::readable(choice.value),
                             io::readable(schema.find(choice.key)->get())});
  for (std::size_t k = 0; k < study.variables.size(); ++k) {
    const auto& variable = study.variables[k];
    picture.facts.push_back({variable.key.substr(variable.key.find('.') + 1),
                             io::quantity(best.values[k], variable.dimension),
                             io::quantity(start.values[k], variable.dimension)});
  }
  picture.facts.push_back({"thinnest wall", io::quantity(best.layout.thinnest_wall, io::Dimension::length),
                           io::quantity(start.layout.thinnest_wall, io::Dimension::length)});
  picture.facts.push_back({"porosity", io::quantity(best.layout.porosity, io::Dimension::ratio),
                           io::quantity(start.layout.porosity, io::Dimension::ratio)});
  const optimize::Score& start_score = run.plan().start.detail;
  picture.facts.push_back(
      {"score", io::number(run.plan().best_score.value), start_score.valid ? io::number(start_score.value) : ""});
}

report::StudyPicture picture_of(optimize::StudyRun& run) {
  const Study& study = run.study();
  const optimize::Plan& plan = run.plan();
  report::StudyPicture picture;
  picture.title = study.file.stem().string();
  picture.subtitle =
      fmt::format("{}, {} replicate{} a candidate, {} evaluations; {}", study.keys.algorithm, study.keys.replicates,
                  study.keys.replicates == 1 ? "" : "s", run.answers().size(), run.reason());
  picture.target = study.target.plateau_stress;
  picture.window_start = study.target.window[0];
  picture.window_end = study.target.window[1];
  add_points(picture, run);
  const auto best = shown(run, *plan.best);
  const auto start = shown(run, *plan.start.candidate);
  const auto best_score = optimize::score_of(study.target, best), start_score = optimize::score_of(study.target, start);
  picture.best = curves(best);
  picture.start = curves(start);
  picture.best_plateau = best_score.plateau_mean;
  if (best_score.replicates > 1) picture.best_plateau_deviation = best_score.plateau_std;
  if (start_score.replicates > start_score.failed) picture.start_plateau = start_score.plateau_mean;
  if (picture.start_plateau && start_score.replicates > 1) picture.start_plateau_deviation = start_score.plateau_std;
  picture.best_layout = layout_of(optimize::design_of(study, *plan.best));
  picture.start_layout = layout_of(*study.start);
  add_facts(picture, run);
  return picture;
}

void draw(optimize::StudyRun& run) {
  const fs::path& folder = run.options().folder;
  report::plot_study(picture_of(run), folder / "study.png");
  if (!fs::exists(folder / "best.h5")) return;
  report::PlotOptions options;
  options.title = "best design of " + run.study().file.stem().string();
  options.target_stress = run.study().target.plateau_stress;
  report::plot_run(folder / "best.h5", folder / "best.png", options);
}

int optimize_study(const OptimizeFlags& flags) {
  refuse_resume_with_force(flags.resume, flags.common.force);
  optimize::Study study = optimize::read_study(flags.study, flags.common.overrides());
  const optimize::WorkOptions options = run_options(flags, study);
  optimize::StudyRun run(std::move(study), options);
  announce(run.study());
  run.run();
  optimize::write_results(run);
  auto status = run.status();
  if (status == results::RunStatus::completed && !flags.no_run_file) {
    const auto best = run_best(flags, run);
    if (best == results::RunStatus::stopped) status = best;
  }
  if (run.plan().best) draw(run);
  print_record(optimize::to_json(run), flags.common.json);
  if (status == results::RunStatus::stopped)
    io::log_warning(
        fmt::format("stopped; what is finished is kept in {}; continue with --resume", options.folder.string()));
  else
    io::log_info(fmt::format("written: {} (result.json, evaluations.csv{})", options.folder.string(),
                             run.plan().best ? ", best.toml, pictures study.png and best.png" : ""));
  return exit_code_of(status);
}

}  // namespace

void add_optimize(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<OptimizeFlags>();
  CLI::App* command = program.add_subcommand("optimize", "Search for the design that crushes at the wanted stress");
  command->add_option("STUDY", flags->study, "Study file (TOML)")->required();
  command->add_option("-o,--output", flags->output, "Folder for journal and results (default: STUDY's name + -result)")
      ->type_name("DIR");
  command->add_flag("--resume", flags->resume, "Continue a study that was stopped or killed");
  add_workers_flag(*command, flags->workers, "study");
  command->add_flag("--no-run-file", flags->no_run_file,
                    "Do not run the best design once more for best.h5 and best.png");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    exit_code = optimize_study(*flags);
  });
}

}  // namespace perfora::app
