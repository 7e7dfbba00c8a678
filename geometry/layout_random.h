// What is here: random hard-core placement of equal holes. What is not: the other families (layout.h).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/perforation.h"

namespace perfora::geometry {

struct RandomPlacement {
  std::vector<Perforation> perforations;
  bool fits = true;  ///< false: no placement with centres `spacing` apart was found; the holes stand as well as they
                     ///< could be put
};

/// `count` centres, no two (periodic images included) nearer than `spacing`: random sequential addition, and where that
/// gets stuck (above about half of the area) overlap minimisation from random starts. Depends on the arguments only.
RandomPlacement place_at_random(double width, double height, int count, double diameter, double spacing,
                                std::uint64_t seed);

}  // namespace perfora::geometry
