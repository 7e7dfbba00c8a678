// What is here: usage errors of the command line as one sentence with the nearest flag, exit code 1; --help and
// --version. What is not: errors in files (io::InputError).
#pragma once

#include <CLI/CLI.hpp>

namespace perfora::app {

/// Prints what `error` stands for (help and version on standard output, errors on standard error) and gives the exit
/// code.
int report_usage_error(const CLI::App& program, const CLI::ParseError& error);

}  // namespace perfora::app
