// What is here: the gap between two cores. What is not: distances within one (polygon_core.cpp), periodic images
// (wall.cpp).
#include "geometry/core_gap.h"
#include "geometry/plane.h"

#include <limits>
#include <span>

namespace perfora::geometry {
namespace {

using Corners = std::span<const Point>;

struct Edge {
  Point start, end;
};

std::size_t edge_count(Corners corners) {
  return corners.size() < 3 ? 1 : corners.size();
}

Edge edge_of(Corners corners, std::size_t k, Point move) {
  const Point &a = corners[k], &b = corners[(k + 1) % corners.size()];
  return {{a.x + move.x, a.y + move.y}, {b.x + move.x, b.y + move.y}};
}

Bounds box_of(Corners corners, Point move) {
  Bounds box{corners[0].x, corners[0].x, corners[0].y, corners[0].y};
  for (const Point& p : corners)
    box = {std::min(box.left, p.x), std::max(box.right, p.x), std::min(box.bottom, p.y), std::max(box.top, p.y)};
  return box.moved_by(move.x, move.y);
}

bool contains(Corners corners, Point p) {
  bool inside = false;
  for (std::size_t k = 0; corners.size() > 2 && k < corners.size(); ++k) {
    const Point &a = corners[k], &b = corners[(k + 1) % corners.size()];
    if ((a.y > p.y) != (b.y > p.y)) inside ^= (cross(a, b, p) > 0.0) == (b.y > a.y);
  }
  return inside;
}

bool cross_each_other(const Edge& a, const Edge& b) {
  return (cross(a.start, a.end, b.start) > 0.0) != (cross(a.start, a.end, b.end) > 0.0) &&
         (cross(b.start, b.end, a.start) > 0.0) != (cross(b.start, b.end, a.end) > 0.0);
}

/// Shortens `best` to the distance of two edges where that is less; 0 where they cross.
void offer(const Edge& a, const Edge& b, Gap& best) {
  if (cross_each_other(a, b)) {
    best.length = 0.0;
    return;
  }
  const auto offer_pair = [&best](Point from, Point to) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (length < best.length) best = {length, from, to};
  };
  offer_pair(a.start, nearest_on_segment(b.start, b.end, a.start));
  offer_pair(a.end, nearest_on_segment(b.start, b.end, a.end));
  offer_pair(nearest_on_segment(a.start, a.end, b.start), b.start);
  offer_pair(nearest_on_segment(a.start, a.end, b.end), b.end);
}

/// The least distance of two cores without their radii, its ends; 0 where they meet.
Gap least_distance(Corners first, Corners second, Point move) {
  Gap best{std::numeric_limits<double>::infinity(), first[0], {second[0].x + move.x, second[0].y + move.y}};
  const Bounds box = box_of(second, move);
  // Two edges that face each other first: then most others are known to be farther without being measured.
  std::size_t facing = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < first.size(); ++k) {
    const double away = distance(bounds_of(first[k], first[k]), box);
    if (away < least) least = away, facing = k;
  }
  const std::size_t count = edge_count(first), others = edge_count(second);
  for (std::size_t n = 0; n < count && best.length > 0.0; ++n) {
    const Edge edge = edge_of(first, (facing + n) % count, {});
    const Bounds around = bounds_of(edge.start, edge.end);
    if (distance(around, box) > best.length) continue;
    for (std::size_t m = 0; m < others && best.length > 0.0; ++m) {
      const Edge other = edge_of(second, m, move);
      if (distance(around, bounds_of(other.start, other.end)) <= best.length) offer(edge, other, best);
    }
  }
  const bool nested = contains(first, {second[0].x + move.x, second[0].y + move.y}) ||
                      contains(second, {first[0].x - move.x, first[0].y - move.y});
  if (nested) best.length = 0.0;
  return best;
}

/// Of two convex cores that meet: the largest separation along a normal of an edge of either, which is minus the least
/// move that takes them apart (their Minkowski difference has no other normals), with the points that touch then.
Gap least_separation(Corners first, Corners second, Point move) {
  Gap best{-std::numeric_limits<double>::infinity(), {}, {}};
  const auto offer_normal = [&](double nx, double ny) {
    const auto along = [&](const Point& p) { return nx * p.x + ny * p.y; };
    const auto by_along = [&](const Point& a, const Point& b) { return along(a) < along(b); };
    const Point top = *std::max_element(first.begin(), first.end(), by_along);
    Point bottom = *std::min_element(second.begin(), second.end(), by_along);
    bottom = {bottom.x + move.x, bottom.y + move.y};
    const double separation = along(bottom) - along(top);
    // From the end of the first core against the normal to the end of the second: its length is the separation.
    if (separation > best.length) best = {separation, top, {top.x + separation * nx, top.y + separation * ny}};
  };
  const auto offer_normals = [&](Corners corners, double sign) {
    for (std::size_t k = 0; corners.size() > 1 && k < corners.size(); ++k) {
      const Point &a = corners[k], &b = corners[(k + 1) % corners.size()];
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      offer_normal(sign * (b.y - a.y) / length, sign * (a.x - b.x) / length);
    }
  };
  offer_normals(first, 1.0);
  offer_normals(second, -1.0);
  if (first.size() == 1 && second.size() == 1) best = {0.0, first[0], first[0]};
  return best;
}

/// The gap less both radii, its ends on the rims and at the place of the first core.
Gap rounded(const PlacedCore& first, const PlacedCore& second, const Gap& bare, Point normal) {
  const Point& at = first.centre;
  return {bare.length - first.radius - second.radius,
          {at.x + bare.from.x + first.radius * normal.x, at.y + bare.from.y + first.radius * normal.y},
          {at.x + bare.to.x - second.radius * normal.x, at.y + bare.to.y - second.radius * normal.y}};
}

Point unit_from_to(const Gap& gap) {
  const double dx = gap.to.x - gap.from.x, dy = gap.to.y - gap.from.y, length = std::hypot(dx, dy);
  if (length == 0.0) return {1.0, 0.0};
  const double sign = gap.length < 0.0 ? -1.0 : 1.0;
  return {sign * dx / length, sign * dy / length};
}

}  // namespace

Gap gap_between(const PlacedCore& first, const PlacedCore& second) {
  const Point move{second.centre.x - first.centre.x, second.centre.y - first.centre.y};
  Gap bare = least_distance(*first.corners, *second.corners, move);
  if (bare.length > 0.0) return rounded(first, second, bare, unit_from_to(bare));
  const std::vector<std::vector<Point>> whole_first{*first.corners}, whole_second{*second.corners};
  bare.length = std::numeric_limits<double>::infinity();
  for (const auto& a : first.pieces->empty() ? whole_first : *first.pieces)
    for (const auto& b : second.pieces->empty() ? whole_second : *second.pieces) {
      const Gap apart = least_distance(a, b, move);
      const Gap pair = apart.length > 0.0 ? apart : least_separation(a, b, move);
      if (pair.length < bare.length) bare = pair;
    }
  return rounded(first, second, bare, unit_from_to(bare));
}

}  // namespace perfora::geometry
