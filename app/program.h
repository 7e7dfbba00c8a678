// What is here: the program from its command line to its exit code, and what its two forms (main.cpp, main_mpi.cpp)
// have of their own. What is not: any work (one file a subcommand).
#pragma once

#include <functional>
#include <memory>

#include "optimize/campaign/executor.h"

namespace perfora::app {

/// What the process needs before its first thread and its first file: call it first in main().
void prepare_process(char** argv);

/// Carries out the command line; an exception becomes one sentence. Returns the exit code.
int run_program(int argc, char** argv);

/// What evaluates the requests of studies, sweeps and the like: child processes in `perfora`, other ranks in
/// `perfora-mpi`; each form of the program defines it. `given`: of --workers; 0: not given.
std::function<std::unique_ptr<optimize::Executor>()> evaluators(const optimize::WorkerProcesses& wanted, int given);

}  // namespace perfora::app
