// What is here: the loops of the overlap minimiser over the pairs and discs of one chunk. Single precision suffices:
// pairs differ little from the places of their last search, which are kept in double precision.
// What is not: which pairs (pair_lists.h), the descent (overlap_minimiser.cpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "geometry/pair_lists.h"

namespace perfora::geometry {

/// One chunk's discs; arrays over the chunk unless said.
struct ChunkDiscs {
  std::size_t count = 0;                 ///< rounded up to whole vectors; what is there too many stays zero
  const Float2* all_moved = nullptr;     ///< displacements since the last search, of the discs of all chunks
  Float2* moved = nullptr;               ///< the chunk's share of it
  const Float2* selected = nullptr;      ///< displacements at the last selection
  const Float2* inverse_mass = nullptr;  ///< twice the same number
  Float2* speed = nullptr;
  Float2* force = nullptr;
};

/// Of the discs of a chunk.
struct ForceSums {
  double squared = 0.0;  ///< over the mass
  double power = 0.0;
};

/// Of the pairs that overlap, met from both ends.
struct OverlapSums {
  double overlap = 0.0, virial = 0.0, distance_squared = 0.0;
  double contacts = 0.0;
  double max_ratio = 0.0;  ///< overlap over the smaller scaled diameter
};

/// How a disc with force F, mass m and speed v moves: v becomes momentum v + push F/m, the place advances by
/// next_momentum v + push F/m.
struct Motion {
  float momentum = 0.0F, next_momentum = 0.0F, push = 0.0F;
};

/// Sets the forces; a pair's is its overlap, along the line of centres.
ForceSums compute_forces(const ChunkPairs& pairs, const ChunkDiscs& discs, double scale);

/// `radius`: of the chunk's discs, `all_radii`: of all; unscaled.
OverlapSums measure_overlaps(const ChunkPairs& pairs, const ChunkDiscs& discs, const float* radius,
                             const float* all_radii, double scale);

/// Returns the largest squared displacement since the last selection.
double move_discs(const ChunkDiscs& discs, const Motion& motion);

/// Fills the near pairs from the candidates (PairLists::select).
void select_near(ChunkPairs& pairs, const Float2* moved, const Float2* all_moved, double scale, double skin);

/// is_near[k] = 1 where the k-th of `count` discs is closer to (at_x, at_y) than its radius plus `reach`, else 0.
void mark_near(const float* x, const float* y, const float* radius, float at_x, float at_y, float reach,
               std::size_t count, std::int32_t* is_near);

}  // namespace perfora::geometry
