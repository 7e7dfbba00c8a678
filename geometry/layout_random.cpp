// What is here: random sequential addition of holes, and overlap minimisation where it gets stuck.
// What is not: checks of the options, messages (layout.cpp).
#include "geometry/layout_random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

bool add_one_by_one(RandomPlacement& placement, double width, double height, double spacing, std::uint64_t seed) {
  PlacedCentres placed(width, height, spacing);
  for (std::size_t hole = 0; hole < placement.perforations.size(); ++hole) {
    bool found = false;
    for (std::uint32_t trial = 0; trial < trials_per_hole && !found; ++trial) {
      const auto u = uniform_pair(seed, RandomStream::hole_place, hole, trial);
      Perforation& p = placement.perforations[hole];
      p.x = u[0] * width;
      p.y = u[1] * height;
      found = placed.free_at(p.x, p.y, spacing);
      if (found) placed.add(p.x, p.y);
    }
    if (!found) return false;
  }
  return true;
}

bool push_apart(RandomPlacement& placement, double width, double height, double spacing, std::uint64_t seed) {
  for (std::uint32_t start = 0; start < maximum_starts; ++start) {
    SoftDiscs discs{width / spacing, height / spacing, {}, {}, {}};  // unit of length: the spacing
    for (std::size_t hole = 0; hole < placement.perforations.size(); ++hole) {
      const auto u = uniform_pair(seed, RandomStream::hole_move, hole, start);
      discs.x.push_back(u[0] * discs.width);
      discs.y.push_back(u[1] * discs.height);
      discs.radius.push_back(0.5);
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

}  // namespace

RandomPlacement place_at_random(double width, double height, int count, double diameter, double spacing,
                                std::uint64_t seed) {
  RandomPlacement placement;
  placement.perforations.assign(static_cast<std::size_t>(count), Perforation{0.0, 0.0, Circle{diameter}});
  if (count == 0) return placement;
  const double fraction = count * 0.25 * std::numbers::pi * spacing * spacing / (width * height);
  const bool possible = fraction <= densest_fraction && spacing <= std::min(width, height);
  if (possible && add_one_by_one(placement, width, height, spacing, seed)) return placement;
  placement.fits = possible && push_apart(placement, width, height, spacing, seed);
  if (!possible) {
    for (std::size_t hole = 0; hole < placement.perforations.size(); ++hole) {
      const auto u = uniform_pair(seed, RandomStream::hole_place, hole);
      placement.perforations[hole].x = u[0] * width;
      placement.perforations[hole].y = u[1] * height;
    }
  }
  return placement;
}

}  // namespace perfora::geometry
