// What is here: holes at random places. What is not: their sizes and angles (planned_hole.h), the other families
// (layout.h).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/perforation.h"

namespace perfora::geometry {

/// Sets `points` to `count` points at random, no two nearer than `spacing` m (nearest periodic images): random
/// sequential addition. False where it gets stuck; those that were placed come first.
bool random_points(std::vector<Point>& points, double width, double height, int count, double spacing,
                   std::uint64_t seed);

struct RandomPlacement {
  std::vector<Perforation> perforations;
  bool fits = true;  ///< false: no placement that keeps the distances was found; the holes stand as well as they could
                     ///< be put
};

/// `count` circles, no two centres (periodic images included) nearer than `spacing`: random sequential addition, and
/// where that gets stuck (above about half of the area) overlap minimisation from random starts. Depends on the
/// arguments only.
RandomPlacement place_at_random(double width, double height, int count, double diameter, double spacing,
                                std::uint64_t seed);

/// Moves the given holes to random places with walls of at least `wall` between any two (own images included), the
/// holes with the longest reach first: random sequential addition from a few random starts. Unequal circles that it
/// cannot place are pushed apart by overlap minimisation. The order of the holes stays.
RandomPlacement place_apart(double width, double height, std::vector<Perforation> holes, double wall,
                            std::uint64_t seed);

}  // namespace perfora::geometry
