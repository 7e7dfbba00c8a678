// What is here: worker processes started as `perfora worker` with the flags of the command that needs them; the end of
// such work.
#include "app/workers.h"

#include <fmt/format.h>

#include "app/program.h"
#include "io/progress.h"
#include "optimize/campaign/shared_folder.h"

namespace perfora::app {

void add_workers_flag(CLI::App& command, int& workers, const std::string& what) {
  command
      .add_option("--workers", workers,
                  fmt::format("Evaluations at once, each in a process of its own (default: as the {} says, or one a "
                              "processor that this process may use)",
                              what))
      ->check(no_more_than_help())
      ->type_name("W");
}

void add_worker_flags(CLI::App& command, WorkerFlags& flags, const std::string& what) {
  add_workers_flag(command, flags.workers, what);
  command
      .add_option(
          "--time-limit", flags.time_limit,
          fmt::format("Replace a worker after this many seconds of one evaluation (default: as the {} says, or 20 "
                      "times the estimate and a minute)",
                      what))
      ->check(positive_number())
      ->type_name("SECONDS");
  command.add_flag("--shared", flags.shared,
                   "Evaluate nothing here: leave it to `perfora work DIR` on any host that sees the folder");
}

std::function<std::unique_ptr<optimize::Executor>()> worker_executor(const WorkerFlags& flags,
                                                                     const optimize::ExecutionKeys& of_file,
                                                                     int workers, const CommonFlags& common,
                                                                     const std::filesystem::path& folder) {
  if (flags.shared) return [folder] { return optimize::make_shared_executor(folder); };
  return evaluators({std::filesystem::read_symlink("/proc/self/exe"), workers, common.thread_count(),
                     flags.time_limit > 0.0 ? flags.time_limit : of_file.time_limit, common.memory_allowed()},
                    flags.workers);
}

optimize::WorkOptions work_options(const CommonFlags& common, const std::filesystem::path& folder, bool resume) {
  optimize::WorkOptions options;
  options.folder = folder;
  options.resume = resume;
  options.force = common.force;
  options.command_line = command_line();
  options.cancellation = stop_token();
  return options;
}

void watch_on_terminal(optimize::WorkOptions& options, ProgressLine& line) {
  if (!io::rewrites_progress()) return;
  options.line_an_answer = false;
  options.progress = [&line](const optimize::WorkProgress& work) {
    const char* between = work.standing.empty() || work.simulation.empty() ? "" : " | ";
    line.update(work.fraction(), work.standing + between + work.simulation);
  };
}

int say_how_work_ended(results::RunStatus status, const std::vector<std::string>& troubles,
                       const std::filesystem::path& folder) {
  for (const std::string& trouble : troubles)
    io::log_error(
        fmt::format("the surroundings failed, not the work: {}; what is finished is kept in {}; continue with "
                    "--resume",
                    trouble, folder.string()));
  if (!troubles.empty()) return exit_internal;
  if (status == results::RunStatus::stopped)
    io::log_warning(fmt::format("stopped; what is finished is kept in {}; continue with --resume", folder.string()));
  return exit_code_of(status);
}

}  // namespace perfora::app
