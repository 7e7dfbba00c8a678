// What is here: a simple polygon with its corners rounded. What is not: shapes by name (make_shape.h).
#pragma once

#include <vector>

#include "geometry/plane.h"

namespace perfora::geometry {

/// Of a convex polygon the centres of its arcs, with their radius; of any other its corners, arcs replaced by chords,
/// with radius 0.
struct RoundedCorners {
  std::vector<Point> corners;
  double radius = 0.0;
};

/// Whether each edge is as long as the tangents of the arcs at both ends need.
bool fits_corners(const std::vector<Point>& corners, double radius);

/// Every corner of a simple anticlockwise polygon, those that turn inwards too, becomes an arc of `radius` that touches
/// both edges. Chords leave the arcs by at most `tolerance`. The arcs must fit.
RoundedCorners round_corners(std::vector<Point> corners, double radius, double tolerance);

}  // namespace perfora::geometry
