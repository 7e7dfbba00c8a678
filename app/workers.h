// What is here: how campaigns come to worker processes: this program again, as `perfora worker`; how their end is told.
// What is not: the workers' loop (worker.cpp), what carries requests to them (optimize/campaign/executor.h).
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/common.h"
#include "optimize/campaign/evaluation_queue.h"
#include "optimize/campaign/execution.h"
#include "optimize/campaign/executor.h"

namespace perfora::app {

/// --workers, --time-limit and --shared; 0: not given.
struct WorkerFlags {
  int workers = 0;
  double time_limit = 0.0;  ///< s
  bool shared = false;
};
/// --workers alone; `what` names the file that says it otherwise ("study").
void add_workers_flag(CLI::App& command, int& workers, const std::string& what);
/// All of these flags.
void add_worker_flags(CLI::App& command, WorkerFlags& flags, const std::string& what);

/// Makes an executor of `workers` child processes that share the threads and the memory of `common`, or one that leaves
/// the evaluations to others that see `folder`. `of_file`: what the file says where the flags do not.
std::function<std::unique_ptr<optimize::Executor>()> worker_executor(const WorkerFlags& flags,
                                                                     const optimize::ExecutionKeys& of_file,
                                                                     int workers, const CommonFlags& common,
                                                                     const std::filesystem::path& folder);

/// What all work in a folder takes from the flags: the folder, whether it goes on or replaces what is there, the
/// command line, and the stop signals.
optimize::WorkOptions work_options(const CommonFlags& common, const std::filesystem::path& folder, bool resume);

/// On a terminal: one line with percent, time left and how the work stands instead of a line an evaluation. `line` must
/// outlive the work.
void watch_on_terminal(optimize::WorkOptions& options, ProgressLine& line);

/// Tells of work that has stopped in its folder, and what the surroundings did where they ended it; the exit code.
int say_how_work_ended(results::RunStatus status, const std::vector<std::string>& troubles,
                       const std::filesystem::path& folder);

}  // namespace perfora::app
