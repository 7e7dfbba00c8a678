// What is here: whether the content of a checkpoint belongs together and to a simulation. What is not: the file and its
// checksum (checkpoint.cpp).
#pragma once

#include <filesystem>

#include "solver/checkpoint.h"

namespace perfora::solver {

/// Throws io::InputError that names `path`, the dataset or attribute and what is wrong, unless all lengths belong
/// together, all indices and states are in their range and all numbers are finite. What passes may be another state
/// than the one that was written (the checksum of the file sees that), but never leads outside an array.
void require_sound(const std::filesystem::path& path, Checkpoint& checkpoint, const Simulation& simulation);

}  // namespace perfora::solver
