// What is here: the files beside R.h5 (CSV, XDMF). What is not: R.h5 itself (results/run_file.h), the rules for
// existing outputs of a run (optimize/evaluate/run_output.h).
#pragma once

#include <filesystem>

namespace perfora::app {

/// Whether everything that write_beside() makes is there.
bool all_beside(const std::filesystem::path& run_file);

/// Writes R.csv and R.xdmf beside R.h5.
void write_beside(const std::filesystem::path& run_file);

}  // namespace perfora::app
