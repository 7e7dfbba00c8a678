// What is here: validity, convex pieces and hull of a polygon, by CGAL. What is not: measures (polygon_core.cpp).
#include "geometry/polygon_checks.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/partition_2.h>

#include <iterator>

namespace perfora::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Partition_traits_2<Kernel>;

template <class Polygon>
Polygon polygon_of(const std::vector<Point>& corners) {
  Polygon polygon;
  for (const Point& p : corners) polygon.push_back(Kernel::Point_2(p.x, p.y));
  return polygon;
}

Point point_of(const Kernel::Point_2& p) {
  return {p.x(), p.y()};
}

}  // namespace

bool is_simple(const std::vector<Point>& corners) {
  return polygon_of<CGAL::Polygon_2<Kernel>>(corners).is_simple();
}

double signed_area(const std::vector<Point>& corners) {
  return polygon_of<CGAL::Polygon_2<Kernel>>(corners).area();
}

std::vector<std::vector<Point>> convex_pieces(const std::vector<Point>& corners) {
  const auto polygon = polygon_of<Traits::Polygon_2>(corners);
  std::vector<Traits::Polygon_2> parts;
  CGAL::approx_convex_partition_2(polygon.vertices_begin(), polygon.vertices_end(), std::back_inserter(parts));
  std::vector<std::vector<Point>> pieces;
  for (const Traits::Polygon_2& part : parts) {
    auto& piece = pieces.emplace_back();
    for (auto p = part.vertices_begin(); p != part.vertices_end(); ++p) piece.push_back(point_of(*p));
  }
  return pieces;
}

std::vector<Point> convex_hull(const std::vector<Point>& corners) {
  std::vector<Kernel::Point_2> points, hull;
  for (const Point& p : corners) points.emplace_back(p.x, p.y);
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(hull));
  std::vector<Point> result;
  for (const Kernel::Point_2& p : hull) result.push_back(point_of(p));
  return result;
}

}  // namespace perfora::geometry
