// What is here: the state of all discs and intact bonds at one moment, as files and pictures take it. What is not:
// files (run_files.h).
#pragma once

#include <cstdint>
#include <vector>

#include "solver/cell.h"
#include "solver/simulation.h"

namespace perfora::solver {

/// n discs, m intact bonds.
struct FrameData {
  double strain = 0.0, time = 0.0;
  CellMatrix cell;                       ///< edges of the block, m
  std::vector<double> position;          ///< (n,2), m from the block's lower left corner, wrapped where periodic
  std::vector<double> angle;             ///< rad
  std::vector<std::int32_t> fragment;    ///< 0 is the largest
  std::vector<double> lost;              ///< share of the original bonds lost, damage counted, 0 to 1
  std::vector<std::int32_t> bond_pairs;  ///< (m,2)
  std::vector<double> bond_damage;       ///< D
};

/// `original_bonds`: number of bonds of each disc at the start. Cost O(discs + bonds).
FrameData take_frame(const Simulation& simulation, const std::vector<std::int32_t>& original_bonds);

/// Number of bonds of each disc.
std::vector<std::int32_t> count_bonds_per_disc(const BondNetwork& network, std::size_t discs);

}  // namespace perfora::solver
