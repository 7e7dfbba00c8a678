// What is here: `perfora optimize`: the search of a study file carried out in a folder by worker processes, then the
// best design's run file and pictures. What is not: the search (optimize/search/driver.h), its folder
// (optimize/search/study_run.h), drawing (report/).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/campaign_pictures.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/outputs.h"
#include "app/reports.h"
#include "app/workers.h"
#include "io/cancellation.h"
#include "io/files.h"
#include "io/text.h"
#include "optimize/search/map_result.h"
#include "optimize/search/study_result.h"
#include "optimize/search/study_run.h"
#include "report/plot.h"
#include "results/study_record.h"
#include "results/wish_record.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;

struct OptimizeFlags {
  CommonFlags common;
  std::string study, output, map;
  double wall_time = 0.0;
  bool resume = false;
  bool no_run_file = false;
  WorkerFlags workers;
};

std::string wish_text(const results::Wish& wish) {
  return results::name_of(*wish.measure) + " " + results::range_text(wish);
}

optimize::WorkOptions run_options(const OptimizeFlags& flags, const optimize::Study& study) {
  optimize::WorkOptions options =
      work_options(flags.common, output_or_default(flags.output, default_name(flags.study, "-result")), flags.resume);
  options.results_written = report_renewal(options.folder);
  options.make_executor =
      worker_executor(flags.workers, study.keys.execution, optimize::useful_workers(study, flags.workers.workers),
                      flags.common, options.folder);
  return options;
}

std::vector<std::string> overrides(const OptimizeFlags& flags) {
  std::vector<std::string> all = flags.common.overrides();
  if (!flags.map.empty()) all.push_back("map.from=" + fs::absolute(flags.map).string());
  return all;
}

/// What evaluations that are there already say of the wishes, before anything is run.
void say_what_is_known(optimize::StudyRun& run) {
  static_cast<void>(run.pending(run.answers()));
  const auto map = run.map();
  if (!map || map->designs.empty()) return;
  for (const std::string& sentence : results::out_of_reach(*map)) io::log_warning(sentence);
  if (const std::string best = optimize::best_of_map_text(run.study(), run.plan()); !best.empty()) io::log_info(best);
}

/// What the results in a folder were for; empty where there are none that can be read.
std::vector<std::string> wishes_of_results(const fs::path& folder) {
  std::vector<std::string> texts;
  try {
    const nlohmann::json result = nlohmann::json::parse(io::read_file(folder / "result.json"));
    for (const results::Wish& wish : results::wishes_from_json(result.at("verdict").at("wishes")))
      texts.push_back(wish_text(wish));
  } catch (const std::exception&) {
    return {};
  }
  return texts;
}

/// A study that goes on with another wish replaces what was said of the first.
void say_wish_is_another(const fs::path& folder, const std::vector<std::string>& old, const results::Target& target) {
  std::vector<std::string> now;
  for (const results::Wish& wish : results::wishes(target)) now.push_back(wish_text(wish));
  if (old.empty() || old == now) return;
  io::log_warning(fmt::format("{} holds results for another wish ({}): they are replaced; what was simulated is kept",
                              folder.string(), fmt::join(old, "; ")));
}

void announce(const optimize::Study& study) {
  log_warnings(study.warnings);
  for (const optimize::Arm& arm : study.arms)
    io::log_info(fmt::format("arm {}: {} candidates, {}", arm.name, arm.maxeval, study.keys.algorithm));
  for (const std::string& line : results::in_words(study.target, study.start->design().measures))
    io::log_info("wished: " + line);
  io::log_info(fmt::format("{} replicate{} a candidate", study.keys.replicates, study.keys.replicates == 1 ? "" : "s"));
}

/// The best design once more with its frames: best.h5, its CSV and XDMF.
results::RunStatus run_best(const OptimizeFlags& flags, optimize::StudyRun& run) {
  ProgressLine progress("best design", flags.common.quiet);
  optimize::EvaluateOptions options;
  options.threads = flags.common.thread_count();
  options.command_line = command_line();
  options.progress = progress.callback();
  options.cancellation = run.options().cancellation;
  const optimize::Evaluation evaluation = optimize::evaluate_best(run, options);
  progress.finish(evaluation.reason);
  const fs::path run_file = run.options().folder / "best.h5";
  if (fs::exists(run_file)) write_beside(run_file);
  return evaluation.status;
}

void draw(const optimize::StudyRun& run) {
  const fs::path& folder = run.options().folder;
  draw_campaign(folder, folder / "study.png");
  if (fs::exists(folder / "map.json")) draw_map(folder, folder / "map.png");
  if (!fs::exists(folder / "best.h5")) return;
  report::PlotOptions options;
  if (run.study().target.plateau_stress > 0.0) options.target_stress = run.study().target.plateau_stress;
  options.measured = results::read_study_record(folder).measured;
  report::plot_run(folder / "best.h5", folder / "best.png", options);
}

int optimize_study(const OptimizeFlags& flags) {
  refuse_resume_with_force(flags.resume, flags.common.force);
  optimize::Study study = optimize::read_study(flags.study, overrides(flags));
  optimize::WorkOptions options = run_options(flags, study);
  ProgressLine progress("study", flags.common.quiet);
  watch_on_terminal(options, progress);
  const std::vector<std::string> old = flags.resume ? wishes_of_results(options.folder) : std::vector<std::string>();
  optimize::StudyRun run(std::move(study), options, flags.wall_time);
  say_wish_is_another(options.folder, old, run.study().target);
  say_what_is_known(run);
  announce(run.study());
  // From here on there is something to keep, while pictures are drawn, too.
  const io::Cancellation::Attention attention = options.cancellation.attend();
  run.run();
  progress.finish(run.reason());
  auto status = run.status();
  if (status == results::RunStatus::completed && !flags.no_run_file) {
    const auto best = run_best(flags, run);
    if (best == results::RunStatus::stopped) status = best;
  }
  if (run.plan().best) draw(run);
  write_report_beside(options.folder);
  print_record(optimize::to_json(run), flags.common.json);
  if (status != results::RunStatus::stopped)
    io::log_info(fmt::format("written: {} (result.json, evaluations.csv{}{})", options.folder.string(),
                             run.plan().best ? ", best.toml, picture study.png, report.html" : "",
                             fs::exists(options.folder / "best.h5") ? ", best.h5, picture best.png" : ""));
  return say_how_work_ended(status, run.troubles(), options.folder);
}

}  // namespace

void add_optimize(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<OptimizeFlags>();
  CLI::App* command = program.add_subcommand("optimize", "Search for the design that crushes at the wanted stress");
  command->add_option("STUDY", flags->study, "Study file (TOML)")->required();
  command->add_option("-o,--output", flags->output, "Folder for journal and results (default: STUDY's name + -result)")
      ->type_name("DIR");
  command->add_flag("--resume", flags->resume, "Continue a study that was stopped or killed");
  command
      ->add_option("--map", flags->map,
                   "Take the evaluations of this folder, of `perfora map` or of a study of the same space")
      ->type_name("DIR");
  command
      ->add_option("--wall-time", flags->wall_time,
                   "End the search early, so that race and verification are done after this many seconds")
      ->check(positive_number())
      ->type_name("SECONDS");
  add_worker_flags(*command, flags->workers, "study");
  command->add_flag("--no-run-file", flags->no_run_file,
                    "Do not run the best design once more for best.h5 and best.png");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    exit_code = optimize_study(*flags);
  });
}

}  // namespace perfora::app
