// What is here: the full history of one evaluation as a file, from which all its measures can be computed again. What
// is not: runs (run_file.h), where such files lie (optimize/campaign/evaluation_queue.h).
#pragma once

#include <filesystem>

#include "results/history.h"

namespace perfora::results {

/// A history and the grade of the material that it is of (material.grade).
struct StoredHistory {
  History history;
  double grade = 1.0;
};

/// Whole or not at all. Throws std::runtime_error when the disk fails.
void write_history_file(const std::filesystem::path& path, const History& history, double grade);
/// Throws io::InputError for a file that is missing, not HDF5, of another `format`, or whose columns do not agree.
StoredHistory read_history_file(const std::filesystem::path& path);

}  // namespace perfora::results
