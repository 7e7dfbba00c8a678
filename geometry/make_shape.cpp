// What is here: the core and the radius of each kind of shape. What is not: rounded corners of outlines of one's own
// (round_corners.cpp), what is measured in a core (polygon_core.cpp).
#include "geometry/make_shape.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "geometry/polygon_checks.h"
#include "geometry/round_corners.h"

namespace perfora::geometry {
namespace {

using Where = ShapeFault::Where;

constexpr double pi = std::numbers::pi;
constexpr int most_corners = 512;

/// Corners along the axis x = 0 upwards, and the radius round them.
struct Core {
  std::vector<Point> corners;
  double radius = 0.0;
};

bool has_corners(ShapeKind kind) {
  return kind == ShapeKind::diamond || kind == ShapeKind::triangle || kind == ShapeKind::teardrop;
}

// The corners are put a little outside, so that the polygon has the area of the ellipse: of the height of the arc over
// a chord, at most length/2 (1 - cos(pi/n)), two thirds are outside and a third is inside.
Core ellipse(double length, double breadth) {
  const double half = 0.5 * std::max(length, breadth);
  const double exact = pi * std::sqrt(half / (3.0 * curve_tolerance));
  const int quarter = std::clamp(static_cast<int>(std::ceil(0.25 * exact)), 2, most_corners / 4), count = 4 * quarter;
  const double step = 2.0 * pi / count, outwards = std::sqrt(step / std::sin(step));
  Core core;
  for (int k = 0; k < count; ++k)
    core.corners.push_back(
        {0.5 * outwards * length * std::cos(k * step), 0.5 * outwards * breadth * std::sin(k * step)});
  return core;
}

// The tip and the arc between the two tangents from it; all of it less the corner radius.
Core teardrop(double length, double breadth, double corner_radius) {
  const double radius = 0.5 * breadth - corner_radius, tip = 0.5 * length - corner_radius;
  const double middle = 0.5 * (breadth - length);
  Core core{{{tip, 0.0}}, corner_radius};
  const double first = radius > 0.0 ? std::acos(radius / (tip - middle)) : pi, turn = 2.0 * (pi - first);
  const double largest = radius > curve_tolerance ? 2.0 * std::acos(1.0 - curve_tolerance / radius) : turn;
  const int chords = turn > 0.0 ? std::clamp(static_cast<int>(std::ceil(turn / largest)), 2, most_corners) : 0;
  for (int k = 0; k <= chords; ++k) {
    const double angle = first + turn * k / std::max(chords, 1);
    core.corners.push_back({middle + radius * std::cos(angle), radius * std::sin(angle)});
  }
  return core;
}

Core slot(double length, double breadth) {
  const double radius = 0.5 * std::min(length, breadth);
  const double half_length = 0.5 * length - radius, half_breadth = 0.5 * breadth - radius;
  return {{{-half_length, -half_breadth}, {half_length, half_breadth}}, radius};
}

std::vector<Point> stretched(const ShapeSize& size) {
  const Point middle = middle_of(size.outline);
  double widest = 0.0, highest = 0.0;
  for (const Point& p : size.outline) {
    widest = std::max(widest, 2.0 * std::abs(p.x - middle.x));
    highest = std::max(highest, 2.0 * std::abs(p.y - middle.y));
  }
  const double along = size.length > 0.0 ? size.length / widest : 1.0;
  const double across = size.breadth > 0.0 ? size.breadth / highest : along;
  std::vector<Point> corners;
  for (const Point& p : size.outline) corners.push_back({(p.x - middle.x) * along, (p.y - middle.y) * across});
  return corners;
}

/// Corners that are none are left out: repeated ones, and those on the line between their neighbours. What has no area
/// becomes a segment, or one point twice.
std::vector<Point> true_corners(std::vector<Point> corners) {
  constexpr double straight = 1e-12;
  bool found = true;
  while (found && corners.size() > 2) {
    found = false;
    for (std::size_t k = 0; k < corners.size() && !found; ++k) {
      const Point &a = corners[(k + corners.size() - 1) % corners.size()], &b = corners[k],
                  &c = corners[(k + 1) % corners.size()];
      const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y;
      const double lengths = std::hypot(ux, uy) * std::hypot(vx, vy);
      if (std::abs(ux * vy - uy * vx) > straight * lengths || (lengths > 0.0 && ux * vx + uy * vy < 0.0)) continue;
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(k));
      found = true;
    }
  }
  return corners;
}

std::vector<Point> anticlockwise(std::vector<Point> corners) {
  if (signed_area(corners) < 0.0) std::reverse(corners.begin(), corners.end());
  return corners;
}

Core core_of(ShapeKind kind, const ShapeSize& size) {
  const double length = size.length, breadth = size.breadth, r = size.corner_radius;
  const double half_length = 0.5 * length - r, half_breadth = 0.5 * breadth - r;
  switch (kind) {
    case ShapeKind::circle:
      return {{{0.0, 0.0}}, 0.5 * length};
    case ShapeKind::ellipse:
      if (length != breadth) return ellipse(length, breadth);
      return {{{0.0, 0.0}}, 0.5 * length};
    case ShapeKind::slot:
      return slot(length, breadth);
    case ShapeKind::diamond:
      return {{{half_length, 0.0}, {0.0, half_breadth}, {-half_length, 0.0}, {0.0, -half_breadth}}, r};
    case ShapeKind::triangle:
      return {{{half_length, 0.0}, {-half_length, half_breadth}, {-half_length, -half_breadth}}, r};
    case ShapeKind::teardrop:
      if (length != breadth) return teardrop(length, breadth, r);
      return {{{0.0, 0.0}}, 0.5 * length};
    case ShapeKind::polygon: {
      RoundedCorners rounded = round_corners(anticlockwise(true_corners(stretched(size))), r, curve_tolerance);
      return {std::move(rounded.corners), rounded.radius};
    }
  }
  return {};
}

std::optional<ShapeFault> fault_of_outline(const ShapeSize& size) {
  const auto fault = [](const char* problem, const char* allowed) {
    return ShapeFault{Where::outline, problem, allowed};
  };
  for (const Point& p : size.outline)
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return fault("a corner is no number", "finite coordinates");
  if (size.outline.size() < 3) return fault("an outline of fewer than three corners", "three corners or more");
  const std::vector<Point> corners = true_corners(stretched(size));
  if (corners.size() < 3) return fault("the corners of the outline lie on one line", "three corners that do not");
  if (!is_simple(corners)) return fault("edges of the outline cross or touch", "an outline that meets itself nowhere");
  if (!fits_corners(anticlockwise(corners), size.corner_radius))
    return ShapeFault{Where::corner_radius, "the edges of the outline are too short for corners of this radius",
                      "a smaller radius"};
  // Arcs in a corner that turns inwards leave the outline: into another part of it where that is near.
  if (size.corner_radius > 0.0 &&
      !is_simple(round_corners(anticlockwise(corners), size.corner_radius, curve_tolerance).corners))
    return ShapeFault{Where::corner_radius, "with corners of this radius the outline would cross itself",
                      "a smaller radius"};
  return std::nullopt;
}

}  // namespace

std::optional<ShapeKind> shape_kind_called(std::string_view name) {
  constexpr std::pair<std::string_view, ShapeKind> names[] = {
      {"circle", ShapeKind::circle},   {"ellipse", ShapeKind::ellipse},   {"slot", ShapeKind::slot},
      {"diamond", ShapeKind::diamond}, {"triangle", ShapeKind::triangle}, {"teardrop", ShapeKind::teardrop},
      {"polygon", ShapeKind::polygon}};
  for (const auto& [one, kind] : names)
    if (one == name) return kind;
  return std::nullopt;
}

std::optional<ShapeFault> fault_of(ShapeKind kind, const ShapeSize& size) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  const bool own = kind == ShapeKind::polygon;
  if (!positive(size.length) && !(own && size.length == 0.0))
    return ShapeFault{Where::length, "the shape has no length", "a positive length"};
  if (kind != ShapeKind::circle && !positive(size.breadth) && !(own && size.breadth == 0.0))
    return ShapeFault{Where::breadth, "the shape has no breadth", "a positive length"};
  if (!std::isfinite(size.angle)) return ShapeFault{Where::angle, "the angle is no number", "a finite angle"};
  if (!(std::isfinite(size.corner_radius) && size.corner_radius >= 0.0))
    return ShapeFault{Where::corner_radius, "the radius of the corners is no radius", "zero or more"};
  if (has_corners(kind) && 2.0 * size.corner_radius > std::min(size.length, size.breadth))
    return ShapeFault{Where::corner_radius, "the corners are rounder than the shape is large",
                      "at most half of the length and half of the breadth"};
  if (kind == ShapeKind::teardrop && size.breadth > size.length)
    return ShapeFault{Where::breadth, "a teardrop is broader than long", "at most its length"};
  return own ? fault_of_outline(size) : std::nullopt;
}

Shape make_shape(ShapeKind kind, const ShapeSize& size) {
  if (const auto fault = fault_of(kind, size)) throw std::invalid_argument(fault->problem);
  if (kind == ShapeKind::circle) return Circle{size.length};
  Core core = core_of(kind, size);
  core.corners = true_corners(std::move(core.corners));
  if (core.corners.front() == core.corners.back()) return Circle{2.0 * core.radius};
  const double c = std::cos(size.angle), s = std::sin(size.angle);
  for (Point& p : core.corners) p = {c * p.x - s * p.y, s * p.x + c * p.y};
  return RoundedPolygon{std::make_shared<const PolygonCore>(std::move(core.corners)), core.radius};
}

Point middle_of(const std::vector<Point>& outline) {
  Bounds box{outline[0].x, outline[0].x, outline[0].y, outline[0].y};
  for (const Point& p : outline)
    box = {std::min(box.left, p.x), std::max(box.right, p.x), std::min(box.bottom, p.y), std::max(box.top, p.y)};
  return {0.5 * (box.left + box.right), 0.5 * (box.bottom + box.top)};
}

}  // namespace perfora::geometry
