// What is here: the program perfora-mpi, `mpirun -n N perfora-mpi SUBCOMMAND ...`: rank 0 is perfora, whose evaluations
// are made by the other ranks. What is not: the program (program.h), messages (optimize/campaign/executor_mpi.h).
#include <optional>

#include "app/common.h"
#include "app/program.h"
#include "optimize/campaign/executor_mpi.h"

namespace perfora::app {
namespace {

std::optional<optimize::MpiJob> job;

}  // namespace

std::function<std::unique_ptr<optimize::Executor>()> evaluators(const optimize::WorkerProcesses& wanted, int given) {
  return [wanted, given] {
    return optimize::make_mpi_executor(*job, {given, wanted.threads, wanted.time_limit, wanted.memory});
  };
}

}  // namespace perfora::app

int main(int argc, char** argv) {
  using namespace perfora;
  app::prepare_process(argv);
  app::job.emplace();
  int exit_code = app::exit_ok;
  if (app::job->rank() == 0) {
    exit_code = app::run_program(argc, argv);
    app::job->set_exit_code(exit_code);
  } else {
    app::install_stop_handlers();
    app::job->serve(app::stop_token());
  }
  app::job.reset();
  return exit_code;
}
