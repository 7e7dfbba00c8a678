// What is here: the thinnest wall of a layout, exactly and between the discs of a clipped packing. What is not: layouts
// (layout.h).
#pragma once

#include "geometry/packing.h"
#include "geometry/perforation.h"

namespace perfora::geometry {

/// Thinnest wall over all periodic pairs, own images included. Brute force up to 256 holes and for
/// other shapes than circles, CGAL's Apollonius graph beyond. The brute force is the definition; the graph, which takes
/// circles only, is tested against it.
ThinnestWall thinnest_wall(const PerforationLayout& layout);
ThinnestWall thinnest_wall_brute_force(const PerforationLayout& layout);
ThinnestWall thinnest_wall_apollonius(const PerforationLayout& layout);

/// Wall measured between the clipped discs (docs/user/theory.md: wider than the exact wall): the thinnest wall between the voids, where the void of a hole is
/// the largest circle about its centre that no disc enters. Infinite without holes.
double thinnest_wall_discretised(const Packing& clipped, const PerforationLayout& layout);

}  // namespace perfora::geometry
