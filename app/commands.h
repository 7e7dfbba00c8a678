// What is here: the list of subcommands; each function adds one to the program and, when it is the one requested,
// stores its exit code. What is not: what they do (one file a subcommand), shared flags (common.h).
#pragma once

#include <CLI/CLI.hpp>

namespace perfora::app {

/// A subcommand runs inside CLI11's parse, as the callback of its CLI::App; io::InputError and others pass through to
/// main().
void add_pack(CLI::App& program, int& exit_code);
void add_evaluate(CLI::App& program, int& exit_code);
void add_test(CLI::App& program, int& exit_code);
void add_optimize(CLI::App& program, int& exit_code);
void add_map(CLI::App& program, int& exit_code);
void add_sweep(CLI::App& program, int& exit_code);
void add_tolerance(CLI::App& program, int& exit_code);
/// `work`, `ask` and `tell`.
void add_shared(CLI::App& program, int& exit_code);
void add_correlate(CLI::App& program, int& exit_code);
void add_calibrate(CLI::App& program, int& exit_code);
void add_check(CLI::App& program, int& exit_code);
void add_show(CLI::App& program, int& exit_code);
void add_plot(CLI::App& program, int& exit_code);
void add_movie(CLI::App& program, int& exit_code);
/// Completion for shells and the manual page, on standard output.
void add_completion(CLI::App& program, int& exit_code);
void add_report(CLI::App& program, int& exit_code);
void add_export(CLI::App& program, int& exit_code);
void add_draw(CLI::App& program, int& exit_code);
/// Hidden: one Request (JSON) a line on standard input, one Evaluation (JSON) a line on standard output.
void add_worker(CLI::App& program, int& exit_code);
/// Hidden: the keys of design, study, sweep and calibration files as Markdown (docs/user/design-files.md).
void add_reference(CLI::App& program, int& exit_code);

}  // namespace perfora::app
