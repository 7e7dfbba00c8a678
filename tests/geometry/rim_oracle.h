// What is here: holes measured along their rims, the oracle for shapes: exact distances to arcs and straight lines, and
// searches along the rim. What is not: anything of cores and radii, by which the program measures.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/perforation.h"
#include "geometry/random.h"

namespace perfora::geometry::brute_force {

/// Random numbers in [low, high) of one test.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : seed_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * uniform_pair(seed_, RandomStream::hole_place, index_++)[0];
  }

 private:
  std::uint64_t seed_, index_ = 0;
};

/// The rim of a hole as arcs and lines.
class Rim {
 public:
  explicit Rim(const Perforation& hole) : arcs_(hole.outline(0.0)) {
    for (std::size_t k = 0; k < arcs_.size(); ++k) {
      const Arc &arc = arcs_[k], &next = arcs_[(k + 1) % arcs_.size()];
      const Point a = on(arc, arc.to), b = on(next, next.from);
      lengths_.push_back(arc.radius * (arc.to - arc.from));
      lengths_.push_back(std::hypot(b.x - a.x, b.y - a.y));
    }
    for (const double length : lengths_) length_ += length;
  }

  double length() const { return length_; }

  /// The point a share s of the length along, taken round and round.
  Point at(double s) const {
    double along = (s - std::floor(s)) * length_;
    for (std::size_t k = 0; k < lengths_.size(); ++k) {
      if (along > lengths_[k] && k + 1 < lengths_.size()) {
        along -= lengths_[k];
        continue;
      }
      const Arc &arc = arcs_[k / 2], &next = arcs_[(k / 2 + 1) % arcs_.size()];
      if (k % 2 == 0) return on(arc, arc.radius > 0.0 ? arc.from + along / arc.radius : arc.from);
      const Point a = on(arc, arc.to), b = on(next, next.from);
      const double t = lengths_[k] > 0.0 ? std::min(1.0, along / lengths_[k]) : 0.0;
      return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    }
    return {};
  }

  double distance_to(Point p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < arcs_.size(); ++k) {
      const Arc &arc = arcs_[k], &next = arcs_[(k + 1) % arcs_.size()];
      const Point a = on(arc, arc.to), b = on(next, next.from);
      if (arc.radius > 0.0) {
        const double dx = p.x - arc.centre.x, dy = p.y - arc.centre.y;
        const double turn = std::remainder(std::atan2(dy, dx) - 0.5 * (arc.from + arc.to), 2.0 * std::numbers::pi);
        if (std::abs(turn) <= 0.5 * (arc.to - arc.from))
          least = std::min(least, std::abs(std::hypot(dx, dy) - arc.radius));
      }
      const double ux = b.x - a.x, uy = b.y - a.y, squared = ux * ux + uy * uy;
      const double t = squared > 0.0 ? std::clamp(((p.x - a.x) * ux + (p.y - a.y) * uy) / squared, 0.0, 1.0) : 0.0;
      const double away_x = p.x - a.x - t * ux, away_y = p.y - a.y - t * uy;
      least = std::min(least, std::sqrt(away_x * away_x + away_y * away_y));
    }
    return least;
  }

 private:
  static Point on(const Arc& arc, double angle) {
    if (arc.radius == 0.0) return arc.centre;
    return {arc.centre.x + arc.radius * std::cos(angle), arc.centre.y + arc.radius * std::sin(angle)};
  }
  std::vector<Arc> arcs_;
  std::vector<double> lengths_;
  double length_ = 0.0;
};

/// The least value of f over [low, high]: of `samples` values the four least are followed down by finer and finer
/// grids.
template <class Function>
double least_of(const Function& f, double low, double high, int samples) {
  std::vector<std::pair<double, double>> found;
  const double spacing = (high - low) / samples;
  for (int k = 0; k <= samples; ++k) found.emplace_back(f(low + k * spacing), low + k * spacing);
  const auto middle = found.begin() + std::min<std::ptrdiff_t>(4, static_cast<std::ptrdiff_t>(found.size()));
  std::partial_sort(found.begin(), middle, found.end());
  double least = found.front().first;
  for (auto start = found.begin(); start != middle; ++start) {
    double centre = start->second, best = start->first;
    for (double step = 0.25 * spacing; step > 1e-14 * (high - low); step *= 0.4) {
      const double from = centre;
      for (int k = -4; k <= 4; ++k) {
        const double at = std::clamp(from + k * step, low, high), value = f(at);
        if (value < best) best = value, centre = at;
      }
    }
    least = std::min(least, best);
  }
  return least;
}

/// Distance of the rims of two holes.
inline double rim_distance(const Rim& a, const Rim& b, Point shift, int samples) {
  return least_of(
      [&](double s) {
        const Point p = a.at(s);
        return b.distance_to({p.x - shift.x, p.y - shift.y});
      },
      0.0, 1.0, samples);
}

}  // namespace perfora::geometry::brute_force
