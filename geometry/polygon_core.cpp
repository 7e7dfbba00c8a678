// What is here: distances, depths and chords of one core. What is not: gaps between two (core_gap.cpp).
#include "geometry/polygon_core.h"

#include <limits>
#include <numbers>

#include "geometry/plane.h"
#include "geometry/polygon_checks.h"

namespace perfora::geometry {
namespace {

Point between(Point a, Point b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/// Distances to all edges at one end of an interval of a segment.
struct Station {
  double t = 0.0, nearest = 0.0;
  std::vector<double> to_edges;
};

std::size_t nearest_edge(const Station& at) {
  return static_cast<std::size_t>(std::min_element(at.to_edges.begin(), at.to_edges.end()) - at.to_edges.begin());
}

/// No point between two stations is farther than this from the nearest edge: the distance to one edge is convex along
/// the segment, so that it is largest at an end.
double bound_between(const Station& a, const Station& b) {
  double bound = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < a.to_edges.size(); ++k) bound = std::min(bound, std::max(a.to_edges[k], b.to_edges[k]));
  return bound;
}

/// Where the edges nearest at the two ends are equally far if their distances are linear between them, and never near
/// an end: there the next interval would not be smaller.
double split(const Station& a, const Station& b) {
  constexpr double least = 1e-3;
  const std::size_t at_a = nearest_edge(a), at_b = nearest_edge(b);
  const double before = a.to_edges[at_b] - a.to_edges[at_a], after = b.to_edges[at_a] - b.to_edges[at_b];
  const double share = before + after > 0.0 ? before / (before + after) : 0.5;
  return a.t + (b.t - a.t) * std::clamp(share, least, 1.0 - least);
}

}  // namespace

PolygonCore::PolygonCore(std::vector<Point> corners) : corners_(std::move(corners)) {
  const std::size_t count = corners_.size();
  box_ = {corners_[0].x, corners_[0].x, corners_[0].y, corners_[0].y};
  bool turns_left = true;
  constexpr double straight = 1e-12;  // rounding of corners on one line
  for (std::size_t k = 0; k < count; ++k) {
    const Point &a = corners_[k], &b = corners_[(k + 1) % count];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (count > 2 || k == 0) edges_.push_back({a, b, {(b.x - a.x) / length, (b.y - a.y) / length}, length});
    area_ += 0.5 * (a.x * b.y - a.y * b.x);
    perimeter_ += length;
    box_ = {std::min(box_.left, a.x), std::max(box_.right, a.x), std::min(box_.bottom, a.y), std::max(box_.top, a.y)};
    reach_ = std::max(reach_, std::hypot(a.x, a.y));
    turns_left = turns_left && cross(a, b, corners_[(k + 2) % count]) >= -straight * length * length;
  }
  if (count == 2) area_ = 0.0;
  if (!turns_left) pieces_ = convex_pieces(corners_);
  measure_extents();
}

// The smallest by rotating calipers on the hull: of each edge the corner farthest from it, which only moves on as the
// edge does.
void PolygonCore::measure_extents() {
  const std::vector<Point> hull = convex() ? corners_ : convex_hull(corners_);
  const std::size_t count = hull.size();
  double squared = 0.0;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t m = k + 1; m < count; ++m) {
      const double dx = hull[m].x - hull[k].x, dy = hull[m].y - hull[k].y;
      squared = std::max(squared, dx * dx + dy * dy);
    }
  largest_extent_ = std::sqrt(squared);
  if (count == 2) return;
  smallest_extent_ = std::numeric_limits<double>::infinity();
  std::size_t far = 1;
  for (std::size_t k = 0; k < count; ++k) {
    const Point &a = hull[k], &b = hull[(k + 1) % count];
    while (cross(a, b, hull[(far + 1) % count]) > cross(a, b, hull[far])) far = (far + 1) % count;
    smallest_extent_ = std::min(smallest_extent_, cross(a, b, hull[far]) / std::hypot(b.x - a.x, b.y - a.y));
  }
}

double PolygonCore::depth(Point p) const {
  double least = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (const Edge& edge : edges_) {
    const double rx = p.x - edge.start.x, ry = p.y - edge.start.y;
    const double along = rx * edge.unit.x + ry * edge.unit.y;
    const double beyond = along - std::clamp(along, 0.0, edge.length), across = edge.unit.x * ry - edge.unit.y * rx;
    least = std::min(least, across * across + beyond * beyond);
    // An edge upwards to the right of p counts, and so does one downwards: inside where their number is odd.
    if ((edge.start.y > p.y) != (edge.end.y > p.y)) inside ^= (across > 0.0) == (edge.end.y > edge.start.y);
  }
  return (inside && edges_.size() > 1 ? 1.0 : -1.0) * std::sqrt(least);
}

double PolygonCore::distances(Point p, std::vector<double>& to_edges) const {
  to_edges.resize(edges_.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const Edge& edge = edges_[k];
    const double rx = p.x - edge.start.x, ry = p.y - edge.start.y;
    const double along = rx * edge.unit.x + ry * edge.unit.y;
    const double beyond = along - std::clamp(along, 0.0, edge.length), across = edge.unit.x * ry - edge.unit.y * rx;
    to_edges[k] = std::sqrt(across * across + beyond * beyond);
    least = std::min(least, to_edges[k]);
  }
  return least;
}

// Inside a core the depth is the least of convex functions, one an edge. The interval is halved where the bound of a
// part says that it may hold more than was found.
double PolygonCore::deepest_between(Point a, Point b) const {
  const double settled = 1e-12 * largest_extent_;
  const auto station = [&](double t) {
    Station at;
    at.t = t;
    at.nearest = distances(between(a, b, t), at.to_edges);
    return at;
  };
  std::vector<std::pair<Station, Station>> waiting{{station(0.0), station(1.0)}};
  double deepest = std::max(waiting[0].first.nearest, waiting[0].second.nearest);
  while (!waiting.empty()) {
    const auto [left, right] = std::move(waiting.back());
    waiting.pop_back();
    if (bound_between(left, right) <= deepest + settled) continue;
    Station middle = station(split(left, right));
    deepest = std::max(deepest, middle.nearest);
    if (middle.t > left.t && middle.t < right.t) {
      waiting.emplace_back(left, middle);
      waiting.emplace_back(std::move(middle), right);
    }
  }
  return deepest;
}

double PolygonCore::deepest_on(Point a, Point b, double margin) const {
  std::vector<double> cuts;  // where the segment crosses the edges
  for (const Edge& edge : edges_) {
    const double of_a = cross(edge.start, edge.end, a), of_b = cross(edge.start, edge.end, b);
    if ((of_a > 0.0) != (of_b > 0.0) && (cross(a, b, edge.start) >= 0.0) != (cross(a, b, edge.end) >= 0.0))
      cuts.push_back(of_a / (of_a - of_b));
  }
  if (cuts.empty()) return depth(a) > 0.0 ? deepest_between(a, b) : -distance_outside(a, b, margin);
  cuts.push_back(0.0);
  cuts.push_back(1.0);
  std::sort(cuts.begin(), cuts.end());
  double deepest = 0.0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const Point from = between(a, b, cuts[k]), to = between(a, b, cuts[k + 1]);
    if (depth(between(from, to, 0.5)) > 0.0) deepest = std::max(deepest, deepest_between(from, to));
  }
  return deepest;
}

double PolygonCore::distance_outside(Point a, Point b, double margin) const {
  if (margin <= 0.0) return margin;
  double least = margin;
  const auto offer = [&least](Point p, Point q) { least = std::min(least, std::hypot(p.x - q.x, p.y - q.y)); };
  for (const Edge& edge : edges_) {
    offer(a, nearest_on_segment(edge.start, edge.end, a));
    offer(b, nearest_on_segment(edge.start, edge.end, b));
    offer(edge.start, nearest_on_segment(a, b, edge.start));
    offer(edge.end, nearest_on_segment(a, b, edge.end));
  }
  return least;
}

double PolygonCore::chord(Point p, Point u, double shift) const {
  std::vector<double> cuts;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const Point &start = corners_[k], &end = corners_[(k + 1) % corners_.size()];
    const double left = u.x * (start.y - p.y) - u.y * (start.x - p.x),
                 right = u.x * (end.y - p.y) - u.y * (end.x - p.x);
    if ((left > 0.0) == (right > 0.0)) continue;
    const Point at = between(start, end, left / (left - right));
    cuts.push_back(u.x * (at.x - p.x) + u.y * (at.y - p.y));
  }
  std::sort(cuts.begin(), cuts.end());
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < cuts.size(); k += 2)
    for (std::size_t m = 0; m + 1 < cuts.size(); m += 2)
      length += std::max(0.0, std::min(cuts[k + 1], cuts[m + 1] + shift) - std::max(cuts[k], cuts[m] + shift));
  return length;
}

double PolygonCore::shared_area(double distance) const {
  constexpr int directions = 8, lines = 24;
  double area = 0.0;
  for (int k = 0; k < directions; ++k) {
    const double angle = std::numbers::pi * (k + 0.5) / directions;
    const Point u{std::cos(angle), std::sin(angle)};
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Point& corner : corners_) {
      low = std::min(low, u.x * corner.y - u.y * corner.x);
      high = std::max(high, u.x * corner.y - u.y * corner.x);
    }
    const double spacing = (high - low) / lines;
    for (int line = 0; line < lines; ++line) {
      const double offset = low + (line + 0.5) * spacing;
      area += spacing * chord({-offset * u.y, offset * u.x}, u, distance);
    }
  }
  return area / directions;
}

}  // namespace perfora::geometry
