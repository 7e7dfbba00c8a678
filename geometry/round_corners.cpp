// What is here: arcs at the corners of a polygon. What is not: which polygons are allowed (make_shape.cpp).
#include "geometry/round_corners.h"

#include <algorithm>
#include <cmath>

namespace perfora::geometry {
namespace {

/// The arc at a corner. Of a corner that turns right (inwards) the turn is negative and the centre outside.
struct CornerArc {
  Point centre;
  double from = 0.0, turn = 0.0;  ///< angle of the normal of the edge before, and how far it turns (rad)
  double tangent = 0.0;           ///< from the corner to where the arc leaves an edge
};

CornerArc arc_at(const std::vector<Point>& corners, std::size_t k, double radius) {
  const std::size_t count = corners.size();
  const Point &a = corners[(k + count - 1) % count], &b = corners[k], &c = corners[(k + 1) % count];
  const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y, length = std::hypot(ux, uy);
  CornerArc arc;
  arc.from = std::atan2(-ux, uy);
  arc.turn = std::atan2(ux * vy - uy * vx, ux * vx + uy * vy);
  arc.tangent = radius * std::tan(0.5 * std::abs(arc.turn));
  const double side = arc.turn > 0.0 ? radius : -radius;  // the centre lies to the left of the edge before, or right
  arc.centre = {b.x - (arc.tangent * ux + side * uy) / length, b.y - (arc.tangent * uy - side * ux) / length};
  return arc;
}

}  // namespace

bool fits_corners(const std::vector<Point>& corners, double radius) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::size_t next = (k + 1) % corners.size();
    const double length = std::hypot(corners[next].x - corners[k].x, corners[next].y - corners[k].y);
    if (arc_at(corners, k, radius).tangent + arc_at(corners, next, radius).tangent > length) return false;
  }
  return true;
}

RoundedCorners round_corners(std::vector<Point> corners, double radius, double tolerance) {
  if (radius == 0.0) return {std::move(corners), 0.0};
  std::vector<CornerArc> arcs;
  for (std::size_t k = 0; k < corners.size(); ++k) arcs.push_back(arc_at(corners, k, radius));
  RoundedCorners rounded;
  if (std::all_of(arcs.begin(), arcs.end(), [](const CornerArc& arc) { return arc.turn > 0.0; })) {
    rounded.radius = radius;
    for (const CornerArc& arc : arcs) rounded.corners.push_back(arc.centre);
    return rounded;
  }
  const double largest = radius > tolerance ? 2.0 * std::acos(1.0 - tolerance / radius) : 1.0;
  for (const CornerArc& arc : arcs) {
    const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(arc.turn) / largest)));
    const double side = arc.turn > 0.0 ? radius : -radius;
    for (int k = 0; k <= chords; ++k) {
      const double angle = arc.from + arc.turn * k / chords;
      rounded.corners.push_back({arc.centre.x + side * std::cos(angle), arc.centre.y + side * std::sin(angle)});
    }
  }
  return rounded;
}

}  // namespace perfora::geometry
