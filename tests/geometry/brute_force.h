// What is here: packings measured by plain double loops, the oracle of the tests of this room.
// What is not: anything fast.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/packing.h"

namespace perfora::geometry::brute_force {

inline double periodic_distance(const Packing& packing, std::size_t i, std::size_t j) {
  const double dx = std::remainder(packing.x[i] - packing.x[j], packing.width);
  const double dy = std::remainder(packing.y[i] - packing.y[j], packing.height);
  return std::hypot(dx, dy);
}

/// Largest overlap over the smaller diameter of its pair.
inline double max_overlap_ratio(const Packing& packing) {
  double largest = 0.0;
  for (std::size_t i = 0; i < packing.x.size(); ++i)
    for (std::size_t j = i + 1; j < packing.x.size(); ++j) {
      const double overlap = packing.radius[i] + packing.radius[j] - periodic_distance(packing, i, j);
      largest = std::max(largest, 0.5 * overlap / std::min(packing.radius[i], packing.radius[j]));
    }
  return largest;
}

inline bool all_inside(const Packing& packing) {
  for (std::size_t i = 0; i < packing.x.size(); ++i)
    if (!(packing.x[i] >= 0.0 && packing.x[i] < packing.width && packing.y[i] >= 0.0 && packing.y[i] < packing.height))
      return false;
  return true;
}

}  // namespace perfora::geometry::brute_force
