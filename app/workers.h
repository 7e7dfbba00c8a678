// What is here: how campaigns come to worker processes: this program again, as `perfora worker`. What is not:
// the workers' loop (worker.cpp), what carries requests to them (optimize/campaign/executor.h).
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include "optimize/campaign/executor.h"

namespace perfora::app {

/// Makes an executor of `workers` child processes that share `threads` threads.
std::function<std::unique_ptr<optimize::Executor>()> worker_executor(int workers, int threads);

/// --workers; what says it otherwise ("study"); empty: nothing does.
void add_workers_flag(CLI::App& command, int& workers, const std::string& what);

}  // namespace perfora::app
