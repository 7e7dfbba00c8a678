// What is here: the gap between two cores with a radius round each. What is not: one core alone (polygon_core.h),
// periodic images (wall.h).
#pragma once

#include <vector>

#include "geometry/plane.h"

namespace perfora::geometry {

/// Corners at a place with a radius round them, of any shape that is a core plus a radius; of a circle the one corner
/// is its centre. `pieces` as of PolygonCore.
struct PlacedCore {
  Point centre;
  const std::vector<Point>* corners;
  const std::vector<std::vector<Point>>* pieces;
  double radius;
};

/// The gap between two placed cores with their radii. Apart it is exact: the least distance. Where the cores meet it is
/// minus the least move that takes them apart, exactly so of convex cores; of others the largest such move over the
/// pairs of their convex pieces. Cost O(corners) with a few near edges, O(corners^2) where they meet.
Gap gap_between(const PlacedCore& first, const PlacedCore& second);

}  // namespace perfora::geometry
