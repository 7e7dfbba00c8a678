// What is here: the files beside R.h5 (CSV, XDMF) and the rules for existing outputs of a run. What is not: R.h5 itself
// (results/run_file.h).
#pragma once

#include <filesystem>

namespace perfora::app {

/// R.part, where a run keeps what must survive a kill.
std::filesystem::path part_folder(const std::filesystem::path& run_file);

/// Refuses to start over something that exists: R.h5 or R.part. With `force` both are removed, with `resume` both are
/// left.
void check_run_output(const std::filesystem::path& run_file, bool force, bool resume);

/// Writes R.csv and R.xdmf beside R.h5.
void write_beside(const std::filesystem::path& run_file);

}  // namespace perfora::app
