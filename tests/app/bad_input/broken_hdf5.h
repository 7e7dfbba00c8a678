// What is here: HDF5 files that are broken on purpose, made from a good packing file. What is not: what the program
// says about them (cases.txt).
#pragma once

#include <filesystem>
#include <string>

namespace perfora::test {

/// Makes `target` from `good` (a P.h5). The stem of the target's name says how: truncated, nothing_inside,
/// radius_missing, unequal_columns, nan_position, run_without_history. Throws std::runtime_error for any other name and
/// where HDF5 refuses.
void make_broken_hdf5(const std::filesystem::path& good, const std::filesystem::path& target);

}  // namespace perfora::test
