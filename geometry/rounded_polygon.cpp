// What is here: a core and its radius as one shape. What is not: the core alone (polygon_core.cpp).
#include "geometry/rounded_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/polygon_checks.h"

namespace perfora::geometry {
namespace {

/// The rim as corners alone, arcs replaced by chords: for estimates.
std::shared_ptr<const PolygonCore> corners_only(const RoundedPolygon& shape) {
  if (shape.radius == 0.0) return shape.core;
  constexpr double step = std::numbers::pi / 24.0;  // sagitta 0.2 % of the radius
  std::vector<Point> corners;
  for (const Arc& arc : shape.outline({}, 0.0)) {
    const int chords = arc.radius > 0.0 ? static_cast<int>(std::ceil((arc.to - arc.from) / step)) : 0;
    for (int k = 0; k <= chords; ++k) {
      const double angle = chords == 0 ? arc.from : arc.from + (arc.to - arc.from) * k / chords;
      corners.push_back({arc.centre.x + arc.radius * std::cos(angle), arc.centre.y + arc.radius * std::sin(angle)});
    }
  }
  return std::make_shared<const PolygonCore>(std::move(corners));
}

/// Length of the line y = offset (upright: x = offset) within a convex polygon that is wider by `radius` all round:
/// from the first to the last of its crossings with the circles about the corners and with the edges moved outwards.
double rounded_chord(const std::vector<Point>& corners, double radius, double offset, bool upright) {
  const std::size_t count = corners.size();
  double first = std::numeric_limits<double>::infinity(), last = -first;
  const auto take = [&](double x) {
    first = std::min(first, x);
    last = std::max(last, x);
  };
  const auto turned = [&](Point p) { return upright ? Point{p.y, p.x} : p; };
  for (std::size_t k = 0; k < count; ++k) {
    const Point a = turned(corners[k]), b = turned(corners[(k + 1) % count]);
    const double above = offset - a.y;
    if (std::abs(above) <= radius) {
      const double half = std::sqrt(radius * radius - above * above);
      take(a.x - half);
      take(a.x + half);
    }
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    for (const double side : {radius / length, -radius / length}) {
      const Point move{side * (b.y - a.y), side * (a.x - b.x)};
      const double from = a.y + move.y - offset, to = b.y + move.y - offset;
      if ((from <= 0.0) != (to <= 0.0)) take(a.x + move.x + from / (from - to) * (b.x - a.x));
    }
  }
  return std::max(0.0, last - first);
}

}  // namespace

bool RoundedPolygon::operator==(const RoundedPolygon& other) const {
  return radius == other.radius && (core == other.core || core->corners() == other.core->corners());
}

bool RoundedPolygon::contains(Point centre, Point point, double margin) const {
  const Bounds box = bounds(centre).grown_by(margin);
  if (point.x < box.left || point.x > box.right || point.y < box.bottom || point.y > box.top) return false;
  return core->depth({point.x - centre.x, point.y - centre.y}) + radius + margin > 0.0;
}

double RoundedPolygon::segment_depth(Point centre, Point a, Point b) const {
  if (distance(bounds_of(a, b), bounds(centre)) > 0.0) return 0.0;
  const Point from{a.x - centre.x, a.y - centre.y}, to{b.x - centre.x, b.y - centre.y};
  return std::max(0.0, core->deepest_on(from, to, radius) + radius);
}

// A point of the segment is no farther from the rim than from the nearer end. Into a slot a segment dips as into a
// circle of its breadth: where its rim is straight not at all.
double RoundedPolygon::deepest_dip(double length) const {
  const double most = std::min(0.5 * length, 0.5 * smallest_extent());
  if (core->corners().size() > 2 || length >= 2.0 * radius) return most;
  return radius - std::sqrt(radius * radius - 0.25 * length * length);
}

double RoundedPolygon::gap_to_image(double shift_x, double shift_y) const {
  return gap_between(placed({}), placed({shift_x, shift_y})).length;
}

Bounds RoundedPolygon::bounds(Point centre) const {
  return core->box().grown_by(radius).moved_by(centre.x, centre.y);
}

RoundedPolygon RoundedPolygon::scaled(double factor) const {
  if (factor == 1.0) return *this;
  std::vector<Point> corners = core->corners();
  for (Point& corner : corners) corner = {factor * corner.x, factor * corner.y};
  return {std::make_shared<const PolygonCore>(std::move(corners)), factor * radius};
}

double RoundedPolygon::area() const {
  return core->area() + radius * core->perimeter() + std::numbers::pi * radius * radius;
}

double RoundedPolygon::reach() const {
  return core->reach() + radius;
}

double RoundedPolygon::largest_extent() const {
  return core->largest_extent() + 2.0 * radius;
}

double RoundedPolygon::smallest_extent() const {
  return core->smallest_extent() + 2.0 * radius;
}

double RoundedPolygon::level_chord(double offset) const {
  return radius > 0.0 ? rounded_chord(core->corners(), radius, offset, false) : core->chord({0.0, offset}, {1.0, 0.0});
}

double RoundedPolygon::upright_chord(double offset) const {
  return radius > 0.0 ? rounded_chord(core->corners(), radius, offset, true) : core->chord({offset, 0.0}, {0.0, 1.0});
}

double RoundedPolygon::shared_area(double distance) const {
  return corners_only(*this)->shared_area(distance);
}

std::vector<Arc> RoundedPolygon::outline(Point centre, double) const {
  const std::vector<Point>& corners = core->corners();
  const std::size_t count = corners.size();
  const auto normal_after = [&](std::size_t k) {
    const Point &a = corners[k % count], &b = corners[(k + 1) % count];
    return std::atan2(a.x - b.x, b.y - a.y);
  };
  std::vector<Arc> arcs;
  for (std::size_t k = 0; k < count; ++k) {
    const double from = normal_after(k + count - 1);
    double to = normal_after(k);
    if (to < from) to += 2.0 * std::numbers::pi;
    // At a corner that turns right there is no arc: the core is not convex, and the radius is 0.
    arcs.push_back({{centre.x + corners[k].x, centre.y + corners[k].y}, radius, from, radius > 0.0 ? to : from});
  }
  return arcs;
}

// The rim cannot be moved in farther than the hole is deep.
RoundedPolygon RoundedPolygon::clear_of(std::span<const NearDisc> discs, double reach) const {
  double clear = reach - core->reach();
  for (const NearDisc& disc : discs) clear = std::min(clear, -core->depth(disc.centre) - disc.radius);
  return {core, std::max(clear, -0.5 * core->smallest_extent())};
}

std::optional<RoundedPolygon> polygon_of(std::vector<Point> corners, double radius) {
  for (const Point& p : corners)
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return std::nullopt;
  if (corners.size() < 2 || !(radius >= 0.0) || !std::isfinite(radius)) return std::nullopt;
  if (corners.size() == 2 && (corners[0] == corners[1] || radius == 0.0)) return std::nullopt;
  if (corners.size() > 2 && !(is_simple(corners) && signed_area(corners) > 0.0)) return std::nullopt;
  RoundedPolygon polygon{std::make_shared<const PolygonCore>(std::move(corners)), radius};
  if (radius > 0.0 && !polygon.core->convex()) return std::nullopt;
  return polygon;
}

PlacedCore RoundedPolygon::placed(Point centre) const {
  return {centre, &core->corners(), &core->pieces(), radius};
}

}  // namespace perfora::geometry
