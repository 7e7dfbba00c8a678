// What is here: taking a frame of a simulation. What is not: the frame itself (results/frame.h), files.
#pragma once

#include <cstdint>
#include <vector>

#include "results/frame.h"
#include "solver/simulation.h"

namespace perfora::solver {

/// `original_bonds`: number of bonds of each disc at the start. Cost O(discs + bonds).
results::Frame take_frame(const Simulation& simulation, const std::vector<std::int32_t>& original_bonds);

/// Number of bonds of each disc.
std::vector<std::int32_t> count_bonds_per_disc(const BondNetwork& network, std::size_t discs);

}  // namespace perfora::solver
