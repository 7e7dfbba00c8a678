// What is here: the three questions asked of a circular perforation, and the area a layout leaves.
// What is not: the search over pairs (wall.cpp).
#include "geometry/perforation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace perfora::geometry {

bool Perforation::contains(double px, double py) const {
  const double dx = px - x, dy = py - y, radius = 0.5 * diameter;
  return dx * dx + dy * dy < radius * radius;
}

double Perforation::segment_depth(double ax, double ay, double bx, double by) const {
  const double ux = bx - ax, uy = by - ay;
  const double squared = ux * ux + uy * uy;
  const double along = squared > 0.0 ? std::clamp(((x - ax) * ux + (y - ay) * uy) / squared, 0.0, 1.0) : 0.0;
  const double distance = std::hypot(ax + along * ux - x, ay + along * uy - y);
  return std::max(0.0, 0.5 * diameter - distance);
}

double Perforation::signed_gap(const Perforation& other, double shift_x, double shift_y) const {
  return std::hypot(other.x + shift_x - x, other.y + shift_y - y) - 0.5 * (diameter + other.diameter);
}

double PerforationLayout::solid_area_fraction() const {
  double area = 0.0;
  for (const Perforation& hole : perforations) area += 0.25 * std::numbers::pi * hole.diameter * hole.diameter;
  return 1.0 - area / (width * height);
}

}  // namespace perfora::geometry
