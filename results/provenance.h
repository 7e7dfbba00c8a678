// What is here: where a result came from: program, command, seeds, configuration; the number of its definitions. What
// is not: the machine (nothing here names it).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace perfora::results {

/// Raised with every change of what an evaluation gives; part of the key of every request.
inline constexpr int results_version = 4;

/// As the attributes of a file tell it; empty or 0 where they say nothing.
struct Provenance {
  std::string title;  ///< of the design, as its file has it
  std::string program_version, git_revision, compiler;
  std::string simd;          ///< instruction set of the kernels
  std::string command_line;  ///< as it was typed
  std::string seeds;         ///< JSON object
  std::string config;        ///< resolved configuration, TOML
  std::int64_t threads = 0;
  std::int64_t results_version = 0;
  double seconds = 0.0;  ///< wall time
};

/// The title of what a file holds: that of its design, otherwise the name of the file without its ending.
std::string title_of(const Provenance& provenance, const std::filesystem::path& file);

/// What this build and `results_version` say; the rest is empty.
Provenance provenance_of_this_program();

}  // namespace perfora::results
