// What is here: `perfora calibrate`: bond parameters for wanted constants of the material. What is not: the search
// (optimize/search/calibration_run.h), the chart (campaign_pictures.h).
#include <fmt/format.h>

#include "app/campaign_pictures.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/reports.h"
#include "app/workers.h"
#include "io/error.h"
#include "io/text.h"
#include "optimize/search/calibration_run.h"
#include "report/plot.h"

namespace perfora::app {

namespace {

/// Fewer points than this make no chart.
constexpr std::size_t fewest_points = 3;

struct CalibrateFlags {
  CommonFlags common;
  std::string file, output;
  bool resume = false;
  WorkerFlags workers;
};

int calibrate(const CalibrateFlags& flags) {
  flags.common.apply();
  refuse_resume_with_force(flags.resume, flags.common.force);
  const optimize::Calibration calibration = optimize::read_calibration(flags.file, flags.common.overrides());
  log_warnings(calibration.warnings);
  ProgressLine progress("calibration", flags.common.quiet);
  optimize::CalibrationOptions options;
  options.folder = output_or_default(flags.output, default_name(flags.file, "-calibration"));
  options.threads = flags.common.thread_count();
  options.resume = flags.resume;
  options.force = flags.common.force;
  options.cancellation = stop_token();
  options.command_line = command_line();
  options.progress = progress.callback();
  options.results_written = report_renewal(options.folder);
  const optimize::ExecutionKeys& execution = calibration.keys.execution;
  const int side_by_side = flags.workers.workers > 0 ? flags.workers.workers
                           : execution.workers > 0   ? execution.workers
                                                     : options.threads;
  options.make_executor = worker_executor(
      flags.workers, execution, optimize::calibration_workers(calibration, side_by_side), flags.common, options.folder);
  const optimize::CalibrationResult result = optimize::calibrate(calibration, options);
  progress.finish(fmt::format("{}, {}", result.reason, io::duration(result.seconds)));
  const auto record = optimize::to_json(result);
  if (result.status != results::RunStatus::stopped) {
    if (result.points.size() > fewest_points) draw_campaign(options.folder, options.folder / "reachable.png");
    if (std::filesystem::exists(options.folder / "confirmation.h5"))
      report::plot_material_tests(options.folder / "confirmation.h5", options.folder / "confirmation.png");
  }
  write_report_beside(options.folder);
  print_record(record, flags.common.json);
  for (const std::string& text : result.not_met) io::log_warning("not met: " + text);
  if (result.status != results::RunStatus::stopped) io::log_info("written: " + options.folder.string());
  if (!result.material_file.empty() && !flags.common.json)
    print_text(
        fmt::format("To use this material, write in a design (the path is relative to its file):\n[material]\n"
                    "from = \"{}\"\n",
                    result.material_file.string()));
  return say_how_work_ended(result.status, result.troubles, options.folder);
}

}  // namespace

void add_calibrate(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<CalibrateFlags>();
  CLI::App* command =
      program.add_subcommand("calibrate", "Find bond parameters for a wanted E, nu, tensile and compressive strength");
  command->add_option("CALIBRATION", flags->file, "Calibration file (TOML)")->required();
  command->add_option("-o,--output", flags->output, "Folder to write (default: CALIBRATION's name + -calibration)")
      ->type_name("DIR");
  command->add_flag("--resume", flags->resume, "Continue a calibration that was stopped or killed");
  add_worker_flags(*command, flags->workers, "calibration");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] { exit_code = calibrate(*flags); });
}

}  // namespace perfora::app
