// What is here: fragments as connected components of intact bonds. What is not: their shapes.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/bond_network.h"

namespace perfora::solver {

struct Fragments {
  std::vector<std::int32_t>
      label;  ///< of each disc; 0 is the largest by area, then by falling area, ties by lowest disc
  std::int32_t count = 0;
  double largest_fraction = 0.0;  ///< area of the largest over the area of all discs
};

/// Union-find over intact bonds; single discs count. Cost O(discs + bonds).
Fragments find_fragments(const BondNetwork& network, const std::vector<double>& radius);

}  // namespace perfora::solver
