// What is here: the program perfora, whose evaluations are child processes of it. What is not: the program (program.h),
// the form for MPI (main_mpi.cpp).
#include "app/program.h"

namespace perfora::app {

std::function<std::unique_ptr<optimize::Executor>()> evaluators(const optimize::WorkerProcesses& wanted, int) {
  return optimize::worker_processes(wanted);
}

}  // namespace perfora::app

int main(int argc, char** argv) {
  perfora::app::prepare_process(argv);
  return perfora::app::run_program(argc, argv);
}
