// What is here: taking a frame of a simulation. What is not: the frame itself (results/frame.h), files.
#pragma once

#include <cstdint>
#include <vector>

#include "results/frame.h"
#include "solver/simulation.h"

namespace perfora::solver {

/// `original_bonds`: number of bonds of each disc at the start. Cost O(discs + bonds).
results::Frame take_frame(const Simulation& simulation, const std::vector<std::int32_t>& original_bonds);

/// Adds what output.frame_data = "all" asks for, nothing where it is "few": velocities, spins, stresses of discs,
/// forces of bonds and contacts, by the laws of the material for this mean diameter (m). The stress of a disc is half
/// the sum of F_j,a r_b over its bonds and contacts, over its own area, so that areas times stresses add up to the area
/// times the stress of the block; forces of walls are no part of it. Reads only: no bit of the run changes. Cost
/// O(discs + bonds + near pairs).
void add_forces(results::Frame& frame, const Simulation& simulation, const SolverOptions& options,
                double mean_diameter);

/// Number of bonds of each disc.
std::vector<std::int32_t> count_bonds_per_disc(const BondNetwork& network, std::size_t discs);

}  // namespace perfora::solver
