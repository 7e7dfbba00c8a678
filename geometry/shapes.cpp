// What is here: plane geometry of the circle, and gaps between shapes. What is not: cores with a radius
// (rounded_polygon.cpp), periodic images (perforation.cpp, wall.cpp).
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

namespace {

/// A circle is a point and its radius.
Gap gap_of_circle(const Circle& circle, Point centre, const RoundedPolygon& other, Point other_centre, bool first) {
  static const std::vector<Point> point{{0.0, 0.0}};
  static const std::vector<std::vector<Point>> no_pieces;
  const PlacedCore round{centre, &point, &no_pieces, 0.5 * circle.diameter}, polygon = other.placed(other_centre);
  return first ? gap_between(round, polygon) : gap_between(polygon, round);
}

}  // namespace

Gap gap_between(const Circle& first, Point first_centre, const Circle& second, Point second_centre) {
  const double dx = second_centre.x - first_centre.x, dy = second_centre.y - first_centre.y;
  const double apart = std::hypot(dx, dy);
  const double nx = apart > 0.0 ? dx / apart : 1.0, ny = apart > 0.0 ? dy / apart : 0.0;
  return {apart - 0.5 * (first.diameter + second.diameter),
          {first_centre.x + 0.5 * first.diameter * nx, first_centre.y + 0.5 * first.diameter * ny},
          {second_centre.x - 0.5 * second.diameter * nx, second_centre.y - 0.5 * second.diameter * ny}};
}

Gap gap_between(const Circle& first, Point first_centre, const RoundedPolygon& second, Point second_centre) {
  return gap_of_circle(first, first_centre, second, second_centre, true);
}

Gap gap_between(const RoundedPolygon& first, Point first_centre, const Circle& second, Point second_centre) {
  return gap_of_circle(second, second_centre, first, first_centre, false);
}

Gap gap_between(const RoundedPolygon& first, Point first_centre, const RoundedPolygon& second, Point second_centre) {
  return gap_between(first.placed(first_centre), second.placed(second_centre));
}

}  // namespace perfora::geometry
