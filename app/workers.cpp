// What is here: worker processes started as `perfora worker` with the flags of the command that needs them.
#include "app/workers.h"

#include <fmt/format.h>

#include <filesystem>

namespace perfora::app {

namespace {

constexpr int most_workers = 4096;

}  // namespace

std::function<std::unique_ptr<optimize::Executor>()> worker_executor(int workers, int threads) {
  return optimize::worker_processes(std::filesystem::read_symlink("/proc/self/exe"), workers, threads);
}

void add_workers_flag(CLI::App& command, int& workers, const std::string& what) {
  command
      .add_option("--workers", workers,
                  fmt::format("Evaluations at once, each in a process of its own (default: {}one a core)",
                              what.empty() ? "" : fmt::format("as the {} says, or ", what)))
      ->check(CLI::Range(1, most_workers))
      ->type_name("W");
}

}  // namespace perfora::app
