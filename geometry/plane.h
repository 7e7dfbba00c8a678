// What is here: plain values of plane geometry that shapes, layouts and grids share, and the distances between points
// and straight edges. What is not: shapes (shapes.h).
#pragma once

#include <algorithm>
#include <cmath>

namespace perfora::geometry {

struct Point {
  double x = 0.0, y = 0.0;  ///< m

  bool operator==(const Point&) const = default;
};

/// Smallest box along the axes, m.
struct Bounds {
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;

  double width() const { return right - left; }
  double height() const { return top - bottom; }
  Bounds grown_by(double margin) const { return {left - margin, right + margin, bottom - margin, top + margin}; }
  Bounds moved_by(double dx, double dy) const { return {left + dx, right + dx, bottom + dy, top + dy}; }
};

/// A piece of an outline: the arc about `centre` from angle `from` anticlockwise to `to` >= from (rad). A radius of 0
/// is a corner.
struct Arc {
  Point centre;
  double radius = 0.0;  ///< m
  double from = 0.0, to = 0.0;
};

/// A disc near a hole, relative to the centre of the hole, m.
struct NearDisc {
  Point centre;
  double radius = 0.0;
};

/// The gap between two shapes: negative where they overlap; its ends on their rims (of overlapping ones the points that
/// must come apart).
struct Gap {
  double length = 0.0;
  Point from, to;
};

inline Bounds bounds_of(Point a, Point b) {
  return {std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y)};
}

/// Twice the area of the triangle a, b, c, m2: positive where the way a-b-c turns left.
inline double cross(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A coordinate moved by whole periods into [0, period).
inline double wrapped(double value, double period) {
  value -= period * std::floor(value / period);
  return value < period ? value : 0.0;
}

/// Distance of two boxes, 0 where they meet.
inline double distance(const Bounds& a, const Bounds& b) {
  const double x = std::max({0.0, a.left - b.right, b.left - a.right});
  const double y = std::max({0.0, a.bottom - b.top, b.bottom - a.top});
  return std::sqrt(x * x + y * y);
}

/// Point of the straight segment a-b that is nearest to p.
inline Point nearest_on_segment(Point a, Point b, Point p) {
  const double ux = b.x - a.x, uy = b.y - a.y, squared = ux * ux + uy * uy;
  const double along = squared > 0.0 ? std::clamp(((p.x - a.x) * ux + (p.y - a.y) * uy) / squared, 0.0, 1.0) : 0.0;
  return {a.x + along * ux, a.y + along * uy};
}

}  // namespace perfora::geometry
