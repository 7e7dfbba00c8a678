// What is here: worker processes started as `perfora worker` with the flags of the command that needs them.
#include "app/workers.h"

#include "app/common.h"

#include <fmt/format.h>

#include <filesystem>

namespace perfora::app {

std::function<std::unique_ptr<optimize::Executor>()> worker_executor(int workers, int threads) {
  return optimize::worker_processes(std::filesystem::read_symlink("/proc/self/exe"), workers, threads);
}

void add_workers_flag(CLI::App& command, int& workers, const std::string& what) {
  command
      .add_option("--workers", workers,
                  fmt::format("Evaluations at once, each in a process of its own (default: {}one a processor that this "
                              "process may use)",
                              what.empty() ? "" : fmt::format("as the {} says, or ", what)))
      ->check(no_more_than_help())
      ->type_name("W");
}

}  // namespace perfora::app
