// What is here: the thinnest wall of a layout, exactly and between the discs of a clipped packing. What is not: layouts
// (layout.h).
#pragma once

#include "geometry/packing.h"
#include "geometry/perforation.h"

namespace perfora::geometry {

/// Thinnest wall over all periodic pairs, own images included, and where it is. The brute force is the definition,
/// without the place. Circles: the brute force up to 256 holes, CGAL's Apollonius graph beyond, which takes circles
/// only. With other shapes: the sweep, which measures only pairs whose boxes are near, O(n^1.5) or so. Both are tested
/// against the brute force. Holes must be smaller than the cell along each side.
ThinnestWall thinnest_wall(const PerforationLayout& layout);
ThinnestWall thinnest_wall_brute_force(const PerforationLayout& layout);
ThinnestWall thinnest_wall_apollonius(const PerforationLayout& layout);
ThinnestWall thinnest_wall_sweep(const PerforationLayout& layout);

/// Wall measured between the clipped discs (docs/user/theory.md: wider than the exact wall): the thinnest wall between
/// the voids. The void of a hole is the hole with its rim moved in or out until no disc enters: of a circle the largest
/// about its centre. Infinite without holes.
double thinnest_wall_discretised(const Packing& clipped, const PerforationLayout& layout);

}  // namespace perfora::geometry
