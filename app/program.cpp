// What is here: the subcommands put together, and exceptions turned into one sentence and an exit code. What is not:
// any work (one file a subcommand).
#include "app/program.h"

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

namespace perfora::app {
namespace {

int run(int argc, char** argv) {
  set_command_line(argc, argv);
  install_stop_handlers();
  int exit_code = exit_ok;
  CLI::App program("Designs perforated concrete blocks that crush at a wanted stress.", "perfora");
  program.set_version_flag("--version", "perfora " + io::program_version() + " (" + io::git_revision() + ")");
  program.require_subcommand(1);
  program.footer(
      "perfora SUBCOMMAND --help says more. Exit codes: 0 done, 1 usage or input, 2 numerical failure,\n"
      "3 internal error or a failure of the surroundings (disk, memory, a lost worker), 75 stopped by a signal or a\n"
      "time limit, what there was to keep is kept (continue with --resume).");
  add_pack(program, exit_code);
  add_evaluate(program, exit_code);
  add_test(program, exit_code);
  add_calibrate(program, exit_code);
  add_map(program, exit_code);
  add_optimize(program, exit_code);
  add_sweep(program, exit_code);
  add_tolerance(program, exit_code);
  add_shared(program, exit_code);
  add_correlate(program, exit_code);
  add_check(program, exit_code);
  add_show(program, exit_code);
  add_plot(program, exit_code);
  add_report(program, exit_code);
  add_movie(program, exit_code);
  add_completion(program, exit_code);
  add_export(program, exit_code);
  add_draw(program, exit_code);
  add_worker(program, exit_code);
  add_reference(program, exit_code);
  add_examples(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_usage_error(program, error);
  }
  return exit_code;
}

}  // namespace

void prepare_process(char** argv) {
  let_waiting_threads_sleep(argv);
  // A file that may not grow and a reader that went away become errors of write(), each with its sentence.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  io::end_without_hdf5();
}

int run_program(int argc, char** argv) {
  try {
    const int exit_code = run(argc, argv);
    std::cout.flush();
    if (!std::cout) throw io::SurroundingsError("standard output cannot be written");
    return exit_code;
  } catch (const io::InputError& error) {
    io::log_error(error.what());
    return exit_input;
  } catch (const std::bad_alloc&) {
    io::log_error("out of memory; `perfora check` says how much a design needs");
  } catch (const std::filesystem::filesystem_error& error) {
    io::log_error(error.path1().string() + ": " + error.code().message() +
                  "; check the disk and the folder, and run the command again");
  } catch (const std::exception& error) {  // SurroundingsError among them
    io::log_error(error.what());
  }
  return exit_internal;
}

}  // namespace perfora::app
