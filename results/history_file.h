// What is here: the full history of one evaluation as a file, from which all its measures can be computed again. What
// is not: runs (run_file.h), where such files lie (optimize/campaign/evaluation_queue.h).
#pragma once

#include <filesystem>

#include "results/history.h"

namespace perfora::results {

/// Whole or not at all. Throws std::runtime_error when the disk fails.
void write_history_file(const std::filesystem::path& path, const History& history);
/// Throws io::InputError for a file that is missing, not HDF5, of another `format`, or whose columns do not agree.
History read_history_file(const std::filesystem::path& path);

}  // namespace perfora::results
