// What is here: `perfora tolerance`: blocks of a design with one deviation each, simulated by worker processes in a
// folder, and which wishes they still keep. What is not: the deviations (optimize/campaign/deviation.h), the runs
// (optimize/campaign/sweep_run.h).
#include <fmt/format.h>

#include "app/campaign_pictures.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/reports.h"
#include "app/workers.h"
#include "optimize/campaign/tolerance_result.h"

namespace perfora::app {

namespace {

using optimize::Tolerance;

struct ToleranceFlags {
  CommonFlags common;
  std::string design, output;
  bool resume = false;
  WorkerFlags workers;
};

optimize::WorkOptions run_options(const ToleranceFlags& flags, const Tolerance& tolerance) {
  optimize::WorkOptions options = work_options(
      flags.common, output_or_default(flags.output, default_name(flags.design, "-tolerance")), flags.resume);
  options.results_written = report_renewal(options.folder);
  options.make_executor = worker_executor(flags.workers, tolerance.keys.execution,
                                          tolerance.sweep.workers(flags.workers.workers), flags.common, options.folder);
  return options;
}

int analyse(const ToleranceFlags& flags) {
  refuse_resume_with_force(flags.resume, flags.common.force);
  const Tolerance tolerance = optimize::read_tolerance(flags.design, flags.common.overrides());
  optimize::WorkOptions options = run_options(flags, tolerance);
  ProgressLine progress("tolerance analysis", flags.common.quiet);
  watch_on_terminal(options, progress);
  optimize::SweepRun run(tolerance.sweep, options);
  log_warnings(tolerance.sweep.warnings);
  for (const optimize::ToleranceCase& one : tolerance.cases)
    if (!one.left_out.empty()) io::log_warning(fmt::format("{} is left out: {}", one.label, one.left_out));
  run.run();
  progress.finish(run.reason());
  optimize::write_results(tolerance, run);
  draw_campaign(options.folder, options.folder / "sweep.png");
  write_report_beside(options.folder);
  print_record(optimize::to_json(tolerance, run), flags.common.json);
  if (run.status() != results::RunStatus::stopped)
    io::log_info(fmt::format("written: {} (tolerance.csv, tolerance.json; tables and picture sweep.png of all blocks)",
                             options.folder.string()));
  return say_how_work_ended(run.status(), run.troubles(), options.folder);
}

}  // namespace

void add_tolerance(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<ToleranceFlags>();
  CLI::App* command = program.add_subcommand(
      "tolerance", "Simulate blocks that differ a little from a design: which of its wishes they still keep");
  command
      ->add_option("DESIGN", flags->design,
                   "Design file, file with a section [tolerance], or folder of a study, whose best design is taken")
      ->required();
  command
      ->add_option("-o,--output", flags->output, "Folder for journal and results (default: DESIGN's name + -tolerance)")
      ->type_name("DIR");
  command->add_flag("--resume", flags->resume, "Continue an analysis that was stopped, killed or extended");
  add_worker_flags(*command, flags->workers, "file");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    exit_code = analyse(*flags);
  });
}

}  // namespace perfora::app
