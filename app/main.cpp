// What is here: the program perfora: its subcommands put together, and exceptions turned into one sentence and an exit
// code. What is not: any work (one file a subcommand).
#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "app/commands.h"
#include "app/common.h"
#include "app/completion.h"
#include "app/thread_policy.h"
#include "app/usage_error.h"
#include "io/error.h"
#include "io/hdf5.h"
#include "io/provenance.h"

namespace {

using namespace perfora;

int run(int argc, char** argv) {
  app::set_command_line(argc, argv);
  app::install_stop_handlers();
  int exit_code = app::exit_ok;
  CLI::App program("Designs perforated concrete blocks that crush at a wanted stress.", "perfora");
  program.set_version_flag("--version", "perfora " + io::program_version() + " (" + io::git_revision() + ")");
  program.require_subcommand(1);
  program.footer(
      "perfora SUBCOMMAND --help says more. Exit codes: 0 done, 1 usage or input, 2 numerical failure,\n"
      "3 internal error or a failure of the surroundings (disk, memory, a lost worker), 75 stopped by a signal or a\n"
      "time limit, what there was to keep is kept (continue with --resume).");
  app::add_pack(program, exit_code);
  app::add_evaluate(program, exit_code);
  app::add_test(program, exit_code);
  app::add_calibrate(program, exit_code);
  app::add_map(program, exit_code);
  app::add_optimize(program, exit_code);
  app::add_sweep(program, exit_code);
  app::add_tolerance(program, exit_code);
  app::add_shared(program, exit_code);
  app::add_correlate(program, exit_code);
  app::add_check(program, exit_code);
  app::add_show(program, exit_code);
  app::add_plot(program, exit_code);
  app::add_report(program, exit_code);
  app::add_movie(program, exit_code);
  app::add_completion(program, exit_code);
  app::add_export(program, exit_code);
  app::add_draw(program, exit_code);
  app::add_worker(program, exit_code);
  app::add_reference(program, exit_code);
  app::add_examples(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app::report_usage_error(program, error);
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  perfora::app::let_waiting_threads_sleep(argv);
  // A file that may not grow and a reader that went away become errors of write(), each with its sentence.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  perfora::io::end_without_hdf5();
  try {
    const int exit_code = run(argc, argv);
    std::cout.flush();
    if (!std::cout) throw perfora::io::SurroundingsError("standard output cannot be written");
    return exit_code;
  } catch (const perfora::io::InputError& error) {
    perfora::io::log_error(error.what());
    return perfora::app::exit_input;
  } catch (const std::bad_alloc&) {
    perfora::io::log_error("out of memory; `perfora check` says how much a design needs");
  } catch (const std::filesystem::filesystem_error& error) {
    perfora::io::log_error(error.path1().string() + ": " + error.code().message() +
                           "; check the disk and the folder, and run the command again");
  } catch (const std::exception& error) {  // SurroundingsError among them
    perfora::io::log_error(error.what());
  }
  return perfora::app::exit_internal;
}
