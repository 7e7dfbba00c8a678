// What is here: random sequential addition of points and holes, and overlap minimisation where it gets stuck.
// What is not: checks of the options, messages (layout.cpp).
#include "geometry/layout_random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <variant>

#include "geometry/cell_grid.h"
#include "geometry/overlap_minimiser.h"
#include "geometry/random.h"

namespace perfora::geometry {

namespace {

/// Trials per hole before random sequential addition counts as stuck.
constexpr std::uint32_t trials_per_hole = 3000;
/// Random starts of the overlap minimisation.
constexpr std::uint32_t maximum_starts = 6;
/// The minimisation works with holes larger by this much, so that what overlap is left does not thin a wall.
constexpr double inflation = 2e-5;
/// Densest packing of equal discs: beyond it nothing fits.
constexpr double densest_fraction = std::numbers::pi / (2.0 * std::numbers::sqrt3);

/// Centres placed so far, in a grid of cells that hold at most a few.
class PlacedCentres {
 public:
  PlacedCentres(double width, double height, double spacing)
      : width_(width),
        height_(height),
        columns_(std::clamp(static_cast<int>(width / spacing), 1, 1024)),
        rows_(std::clamp(static_cast<int>(height / spacing), 1, 1024)),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  bool free_at(double x, double y, double spacing) const {
    for (int r = -1; r <= 1; ++r)
      for (int c = -1; c <= 1; ++c)
        for (const auto& [px, py] : cells_[cell(column(x) + c, row(y) + r)]) {
          const double dx = nearest_image(px - x, width_, 0.5 * width_),
                       dy = nearest_image(py - y, height_, 0.5 * height_);
          if (dx * dx + dy * dy < spacing * spacing) return false;
        }
    return true;
  }
  void add(double x, double y) { cells_[cell(column(x), row(y))].emplace_back(x, y); }

 private:
  int column(double x) const { return std::min(static_cast<int>(x / width_ * columns_), columns_ - 1); }
  int row(double y) const { return std::min(static_cast<int>(y / height_ * rows_), rows_ - 1); }
  std::size_t cell(int c, int r) const {
    return static_cast<std::size_t>((r + rows_) % rows_) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>((c + columns_) % columns_);
  }
  double width_, height_;
  int columns_, rows_;
  std::vector<std::vector<std::pair<double, double>>> cells_;
};

/// `radius`: of each hole with half its wall, m.
bool push_apart(RandomPlacement& placement, double width, double height, const std::vector<double>& radius,
                std::uint64_t seed) {
  const double spacing = 2.0 * *std::max_element(radius.begin(), radius.end());
  for (std::uint32_t start = 0; start < maximum_starts; ++start) {
    SoftDiscs discs{width / spacing, height / spacing, {}, {}, {}};  // unit of length: the largest spacing
    for (std::size_t hole = 0; hole < placement.perforations.size(); ++hole) {
      const auto u = uniform_pair(seed, RandomStream::hole_move, hole, start);
      discs.x.push_back(u[0] * discs.width);
      discs.y.push_back(u[1] * discs.height);
      discs.radius.push_back(radius[hole] / spacing);
    }
    OverlapMinimiser minimiser(std::move(discs), 1);
    const StopRule rule{1e-3, 0.5 * inflation, 20000};
    const OverlapState state = minimiser.minimise(1.0 + inflation, rule);
    for (std::size_t hole = 0; hole < placement.perforations.size(); ++hole) {
      placement.perforations[hole].x = minimiser.discs().x[hole] * spacing;
      placement.perforations[hole].y = minimiser.discs().y[hole] * spacing;
    }
    if (state.max_overlap_ratio <= rule.negligible_overlap) return true;
  }
  return false;
}

/// Holes placed so far, in a grid of cells as wide as the farthest two of them can touch.
class PlacedHoles {
 public:
  PlacedHoles(double width, double height, double wall, double longest_reach)
      : width_(width),
        height_(height),
        wall_(wall),
        columns_(std::clamp(static_cast<int>(width / (2.0 * longest_reach + wall)), 1, 1024)),
        rows_(std::clamp(static_cast<int>(height / (2.0 * longest_reach + wall)), 1, 1024)),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  bool free_for(const Perforation& hole) const {
    for (int r = -1; r <= 1; ++r)
      for (int c = -1; c <= 1; ++c)
        for (const Perforation& other : cells_[cell(column(hole.x) + c, row(hole.y) + r)])
          if (!apart(hole, other)) return false;
    return true;
  }
  void add(const Perforation& hole) { cells_[cell(column(hole.x), row(hole.y))].push_back(hole); }

 private:
  bool apart(const Perforation& hole, const Perforation& other) const {
    const double touch = hole.reach() + other.reach() + wall_;
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b) {
        const double shift_x = a * width_, shift_y = b * height_;
        const double dx = other.x + shift_x - hole.x, dy = other.y + shift_y - hole.y;
        if (dx * dx + dy * dy > touch * touch) continue;
        const double gap = hole.signed_gap(other, shift_x, shift_y);
        if (gap < wall_ || gap <= 0.0) return false;
      }
    return true;
  }
  int column(double x) const { return std::min(static_cast<int>(x / width_ * columns_), columns_ - 1); }
  int row(double y) const { return std::min(static_cast<int>(y / height_ * rows_), rows_ - 1); }
  std::size_t cell(int c, int r) const {
    return static_cast<std::size_t>((r + rows_) % rows_) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>((c + columns_) % columns_);
  }
  double width_, height_, wall_;
  int columns_, rows_;
  std::vector<std::vector<Perforation>> cells_;
};

bool add_holes(std::vector<Perforation>& holes, const std::vector<std::size_t>& order, double width, double height,
               double wall, std::uint32_t start, std::uint64_t seed) {
  PlacedHoles placed(width, height, wall, holes[order.front()].reach());
  for (const std::size_t hole : order) {
    Perforation& p = holes[hole];
    bool found = false;
    for (std::uint32_t trial = 0; trial < trials_per_hole && !found; ++trial) {
      const auto u = uniform_pair(seed, RandomStream::hole_place, hole, start * trials_per_hole + trial);
      p.x = u[0] * width;
      p.y = u[1] * height;
      found = placed.free_for(p);
    }
    if (!found) return false;
    placed.add(p);
  }
  return true;
}

}  // namespace

bool random_points(std::vector<Point>& points, double width, double height, int count, double spacing,
                   std::uint64_t seed) {
  points.assign(static_cast<std::size_t>(count), {});
  PlacedCentres placed(width, height, spacing);
  for (std::size_t k = 0; k < points.size(); ++k) {
    bool found = false;
    for (std::uint32_t trial = 0; trial < trials_per_hole && !found; ++trial) {
      const auto u = uniform_pair(seed, RandomStream::hole_place, k, trial);
      points[k] = {u[0] * width, u[1] * height};
      found = placed.free_at(points[k].x, points[k].y, spacing);
    }
    if (!found) return false;
    placed.add(points[k].x, points[k].y);
  }
  return true;
}

RandomPlacement place_at_random(double width, double height, int count, double diameter, double spacing,
                                std::uint64_t seed) {
  RandomPlacement placement;
  placement.perforations.assign(static_cast<std::size_t>(count), Perforation{0.0, 0.0, Circle{diameter}});
  if (count == 0) return placement;
  const double fraction = count * 0.25 * std::numbers::pi * spacing * spacing / (width * height);
  const bool possible = fraction <= densest_fraction && spacing <= std::min(width, height);
  std::vector<Point> points;
  if (possible && random_points(points, width, height, count, spacing, seed)) {
    for (std::size_t hole = 0; hole < points.size(); ++hole) {
      placement.perforations[hole].x = points[hole].x;
      placement.perforations[hole].y = points[hole].y;
    }
    return placement;
  }
  const std::vector<double> radius(placement.perforations.size(), 0.5 * spacing);
  placement.fits = possible && push_apart(placement, width, height, radius, seed);
  if (!possible) {
    for (std::size_t hole = 0; hole < placement.perforations.size(); ++hole) {
      const auto u = uniform_pair(seed, RandomStream::hole_place, hole);
      placement.perforations[hole].x = u[0] * width;
      placement.perforations[hole].y = u[1] * height;
    }
  }
  return placement;
}

RandomPlacement place_apart(double width, double height, std::vector<Perforation> holes, double wall,
                            std::uint64_t seed) {
  RandomPlacement placement{std::move(holes), true};
  std::vector<Perforation>& placed = placement.perforations;
  if (placed.empty()) return placement;
  std::vector<std::size_t> order(placed.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return placed[a].reach() > placed[b].reach(); });
  double area = 0.0;
  bool images_apart = true, circles = true;
  for (const Perforation& hole : placed) {
    area += hole.area();
    images_apart = images_apart && hole.gap_to_image(width, 0.0) > wall && hole.gap_to_image(0.0, height) > wall;
    circles = circles && std::holds_alternative<Circle>(hole.shape);
  }
  const bool possible = images_apart && area < width * height;
  for (std::uint32_t start = 0; possible && start < maximum_starts; ++start)
    if (add_holes(placed, order, width, height, wall, start, seed)) return placement;
  placement.fits = false;
  if (possible && circles) {
    std::vector<double> radius;
    for (const Perforation& hole : placed) radius.push_back(hole.reach() + 0.5 * wall);
    placement.fits = push_apart(placement, width, height, radius, seed);
  }
  if (!placement.fits && !(possible && circles)) {
    for (std::size_t hole = 0; hole < placed.size(); ++hole) {
      const auto u = uniform_pair(seed, RandomStream::hole_place, hole);
      placed[hole].x = u[0] * width;
      placed[hole].y = u[1] * height;
    }
  }
  return placement;
}

}  // namespace perfora::geometry
