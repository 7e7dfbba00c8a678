// What is here: plane geometry of each shape. What is not: periodic images (perforation.cpp, wall.cpp).
#include "geometry/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace perfora::geometry {

bool Circle::contains(Point centre, Point point, double margin) const {
  const double dx = point.x - centre.x, dy = point.y - centre.y, radius = 0.5 * (diameter + 2.0 * margin);
  return dx * dx + dy * dy < radius * radius;
}

double Circle::segment_depth(Point centre, Point a, Point b) const {
  const double ux = b.x - a.x, uy = b.y - a.y;
  const double squared = ux * ux + uy * uy;
  const double along =
      squared > 0.0 ? std::clamp(((centre.x - a.x) * ux + (centre.y - a.y) * uy) / squared, 0.0, 1.0) : 0.0;
  const double distance = std::hypot(a.x + along * ux - centre.x, a.y + along * uy - centre.y);
  return std::max(0.0, 0.5 * diameter - distance);
}

// A chord of length l dips into a circle of radius R by R - sqrt(R^2 - l^2/4).
double Circle::deepest_dip(double length) const {
  const double radius = 0.5 * diameter;
  return radius > 0.5 * length ? radius - std::sqrt(radius * radius - 0.25 * length * length) : radius;
}

double Circle::gap_to_image(double shift_x, double shift_y) const {
  return std::hypot(shift_x, shift_y) - diameter;
}

Bounds Circle::bounds(Point centre) const {
  const double radius = 0.5 * diameter;
  return {centre.x - radius, centre.x + radius, centre.y - radius, centre.y + radius};
}

double Circle::area() const {
  return 0.25 * std::numbers::pi * diameter * diameter;
}

Circle Circle::scaled(double factor) const {
  return {factor * diameter};
}

double Circle::reach() const {
  return 0.5 * diameter;
}

double Circle::largest_extent() const {
  return diameter;
}

double Circle::smallest_extent() const {
  return diameter;
}

double Circle::level_chord(double offset) const {
  return std::sqrt(std::max(0.0, diameter * diameter - 4.0 * offset * offset));
}

double Circle::upright_chord(double offset) const {
  return level_chord(offset);
}

// The lens of two equal circles.
double Circle::shared_area(double distance) const {
  const double radius = 0.5 * diameter;
  if (distance >= diameter) return 0.0;
  return 2.0 * radius * radius * std::acos(distance / diameter) -
         0.5 * distance * std::sqrt(diameter * diameter - distance * distance);
}

std::vector<Arc> Circle::outline(Point centre, double) const {
  return {{centre, 0.5 * diameter, 0.0, 2.0 * std::numbers::pi}};
}

Circle Circle::clear_of(std::span<const NearDisc> discs, double reach) const {
  double radius = reach;
  for (const NearDisc& disc : discs) radius = std::min(radius, std::hypot(disc.centre.x, disc.centre.y) - disc.radius);
  return {2.0 * std::max(0.0, radius)};
}

double signed_gap(const Circle& first, Point first_centre, const Circle& second, Point second_centre) {
  return std::hypot(second_centre.x - first_centre.x, second_centre.y - first_centre.y) -
         0.5 * (first.diameter + second.diameter);
}

}  // namespace perfora::geometry
