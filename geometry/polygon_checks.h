// What is here: what CGAL knows of polygons. What is not: CGAL's types (polygon_checks.cpp).
#pragma once

#include <vector>

#include "geometry/plane.h"

namespace perfora::geometry {

/// Whether no edge touches or crosses another but its neighbours at their corner (exact).
bool is_simple(const std::vector<Point>& corners);
/// Positive where the corners run anticlockwise.
double signed_area(const std::vector<Point>& corners);
/// Convex pieces, few of them, that cover a simple anticlockwise polygon.
std::vector<std::vector<Point>> convex_pieces(const std::vector<Point>& corners);
/// The corners of the convex hull, anticlockwise.
std::vector<Point> convex_hull(const std::vector<Point>& corners);

}  // namespace perfora::geometry
