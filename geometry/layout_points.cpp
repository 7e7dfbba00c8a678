// What is here: Poisson-disc points and Lloyd's method on a periodic rectangle. What is not: holes.
#include "geometry/layout_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/layout_random.h"
#include "geometry/plane.h"

namespace perfora::geometry {
namespace {

/// Relative radius in hundredths: random sequential addition jams at 0.777 (a coverage of 0.547).
constexpr int densest_trial = 78;
constexpr int most_rounds = 200;
constexpr double still = 1e-3;  ///< of largest_distance: a smaller move ends Lloyd's method

/// The part of a convex polygon about the origin that is nearer to the origin than to `other`.
void cut_towards(std::vector<Point>& cell, Point other, std::vector<Point>& scratch) {
  const double half = 0.5 * (other.x * other.x + other.y * other.y);
  const auto beyond = [&](const Point& p) { return p.x * other.x + p.y * other.y - half; };
  scratch.clear();
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const Point a = cell[k], b = cell[(k + 1) % cell.size()];
    const double at_a = beyond(a), at_b = beyond(b);
    if (at_a <= 0.0) scratch.push_back(a);
    if ((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0)) {
      const double share = at_a / (at_a - at_b);
      scratch.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
    }
  }
  cell.swap(scratch);
}

double longest_squared(const std::vector<Point>& cell) {
  double longest = 0.0;
  for (const Point& p : cell) longest = std::max(longest, p.x * p.x + p.y * p.y);
  return longest;
}

/// Centroid of a polygon about the origin.
Point centroid(const std::vector<Point>& cell) {
  double twice_area = 0.0;
  Point sum;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const Point a = cell[k], b = cell[(k + 1) % cell.size()];
    const double cross = a.x * b.y - b.x * a.y;
    twice_area += cross;
    sum.x += cross * (a.x + b.x);
    sum.y += cross * (a.y + b.y);
  }
  return {sum.x / (3.0 * twice_area), sum.y / (3.0 * twice_area)};
}

/// Points of a periodic cell in boxes of about one point each.
class Boxes {
 public:
  Boxes(double width, double height, const std::vector<Point>& points)
      : width_(width), height_(height), points_(points) {
    const double side = std::sqrt(width * height / static_cast<double>(points.size()));
    columns_ = std::max(1, static_cast<int>(width / side));
    rows_ = std::max(1, static_cast<int>(height / side));
    members_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (std::size_t k = 0; k < points.size(); ++k) members_[box(column(points[k].x), row(points[k].y))].push_back(k);
  }

  /// The Voronoi cell of point `k`, relative to it: cut by the points in ever wider rings of boxes until those of the
  /// next ring are too far to matter. Cells reach at most half a period to each side.
  void voronoi_cell(std::size_t k, std::vector<Point>& cell, std::vector<Point>& scratch) const {
    const Point own = points_[k];
    const double w = 0.5 * width_, h = 0.5 * height_;
    cell = {{-w, -h}, {w, -h}, {w, h}, {-w, h}};
    const double side = std::min(width_ / columns_, height_ / rows_);
    for (int ring = 0;; ++ring) {
      // Points of this ring lie at least (ring - 1) boxes away; the bisector with one at distance d passes at d/2.
      const double nearest = (ring - 1) * side;
      if (nearest > 0.0 && nearest * nearest > 4.0 * longest_squared(cell)) return;
      for (int r = -ring; r <= ring; ++r)
        for (int c = -ring; c <= ring; c += std::abs(r) == ring ? 1 : std::max(1, 2 * ring))
          cut_by_box(k, own, column(own.x) + c, row(own.y) + r, cell, scratch);
    }
  }

 private:
  int column(double x) const { return std::clamp(static_cast<int>(x / width_ * columns_), 0, columns_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>(y / height_ * rows_), 0, rows_ - 1); }
  std::size_t box(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
  }
  void cut_by_box(std::size_t k, Point own, int c, int r, std::vector<Point>& cell, std::vector<Point>& scratch) const {
    const int turns_x = c >= 0 ? c / columns_ : -((columns_ - 1 - c) / columns_);
    const int turns_y = r >= 0 ? r / rows_ : -((rows_ - 1 - r) / rows_);
    for (const std::size_t other : members_[box(c - turns_x * columns_, r - turns_y * rows_)]) {
      if (other == k && turns_x == 0 && turns_y == 0) continue;
      const Point to{points_[other].x + turns_x * width_ - own.x, points_[other].y + turns_y * height_ - own.y};
      if (to.x != 0.0 || to.y != 0.0) cut_towards(cell, to, scratch);
    }
  }

  double width_, height_;
  const std::vector<Point>& points_;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::size_t>> members_;
};

}  // namespace

double largest_distance(double width, double height, int count) {
  return std::sqrt(2.0 * width * height / (std::numbers::sqrt3 * count));
}

std::vector<Point> blue_noise_points(double width, double height, int count, std::uint64_t seed) {
  std::vector<Point> points;
  for (int hundredths = densest_trial; hundredths > 0; --hundredths)
    if (random_points(points, width, height, count, 0.01 * hundredths * largest_distance(width, height, count), seed))
      break;
  return points;
}

std::vector<Point> voronoi_points(double width, double height, int count, std::uint64_t seed) {
  std::vector<Point> points = blue_noise_points(width, height, count, seed), cell, scratch;
  const double small = still * largest_distance(width, height, count);
  for (int round = 0; round < most_rounds; ++round) {
    const Boxes boxes(width, height, points);
    std::vector<Point> moved;
    double farthest = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      boxes.voronoi_cell(k, cell, scratch);
      const Point to = centroid(cell);
      farthest = std::max(farthest, to.x * to.x + to.y * to.y);
      moved.push_back({wrapped(points[k].x + to.x, width), wrapped(points[k].y + to.y, height)});
    }
    points = std::move(moved);
    if (farthest < small * small) break;
  }
  return points;
}

}  // namespace perfora::geometry
