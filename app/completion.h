// What is here: completion for shells and the manual page, made from the program's own tree of commands. What is not:
// the commands.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace perfora::app {

/// A script that bash (zsh) reads to complete commands, flags and file names of `program`.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);
/// perfora(1) in roff: every command with its flags and examples.
std::string manual_page(const CLI::App& program);

/// Sets the examples below the --help of every command.
void add_examples(CLI::App& program);

}  // namespace perfora::app
