// What is here: `perfora sweep`: every case of a sweep file simulated by worker processes in a folder, then its tables
// and picture. What is not: the cases (optimize/campaign/sweep.h), the runs (optimize/campaign/sweep_run.h), drawing
// (report/).
#include <fmt/format.h>

#include "app/campaign_pictures.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/reports.h"
#include "app/workers.h"
#include "optimize/campaign/sweep_result.h"

namespace perfora::app {

namespace {

using optimize::Sweep;

struct SweepFlags {
  CommonFlags common;
  std::string sweep, output;
  std::vector<std::string> only;
  bool resume = false;
  WorkerFlags workers;
};

optimize::WorkOptions run_options(const SweepFlags& flags, const Sweep& sweep) {
  optimize::WorkOptions options =
      work_options(flags.common, output_or_default(flags.output, default_name(flags.sweep, "-result")), flags.resume);
  options.keep_run_files = sweep.keys.run_files;
  options.results_written = report_renewal(options.folder);
  options.make_executor = worker_executor(flags.workers, sweep.keys.execution, sweep.workers(flags.workers.workers),
                                          flags.common, options.folder);
  return options;
}

int sweep_designs(const SweepFlags& flags) {
  refuse_resume_with_force(flags.resume, flags.common.force);
  Sweep sweep = optimize::read_sweep(flags.sweep, flags.common.overrides(), flags.only);
  optimize::WorkOptions options = run_options(flags, sweep);
  ProgressLine progress("sweep", flags.common.quiet);
  watch_on_terminal(options, progress);
  optimize::SweepRun run(std::move(sweep), options);
  log_warnings(run.sweep().warnings);
  const std::size_t cases = run.sweep().cases.size();
  io::log_info(fmt::format("{} {}, {} runs", cases, cases == 1 ? "case" : "cases", run.sweep().runs()));
  if (run.sweep().left_out > 0)
    io::log_info(
        fmt::format("{} cases are left out by --only: the tables in {} show the others; --resume without it "
                    "runs the rest and shows all",
                    run.sweep().left_out, options.folder.string()));
  run.run();
  progress.finish(run.reason());
  draw_campaign(options.folder, options.folder / "sweep.png");
  write_report_beside(options.folder);
  const bool collapse = draw_collapse(options.folder, options.folder / "collapse.png");
  if (run.sweep().keys.run_files && !collapse)
    io::log_warning("no run file was kept: these simulations were run before sweep.run_files was set");
  const auto record = optimize::to_json(run);
  print_record(record, flags.common.json);
  if (run.status() != results::RunStatus::stopped)
    io::log_info(
        fmt::format("written: {} (cases.csv, runs.csv, curves.csv, result.json, report.html, picture{} sweep.png{})",
                    options.folder.string(), collapse ? "s" : "", collapse ? " and collapse.png" : ""));
  return say_how_work_ended(run.status(), run.troubles(), options.folder);
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
  add_worker_flags(*command, flags->workers, "sweep");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    exit_code = sweep_designs(*flags);
  });
}

}  // namespace perfora::app
