// What is here: the grid of distances to the nearest disc, and what circles in the empty part cover. What is not: the
// area of known openings (perforation.h).
#include "geometry/open_area.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace perfora::geometry {
namespace {

constexpr double nodes_per_reach = 4.0;

/// Periodic grid over the cell.
struct Grid {
  std::int64_t nx, ny;
  double dx, dy;

  std::size_t at(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>(((j % ny + ny) % ny) * nx + (i % nx + nx) % nx);
  }

  /// Calls `visit(node, distance)` for the nodes within `reach` of a point, each once as long as reach is below half
  /// the cell.
  template <class Visit>
  void around(double x, double y, double reach, const Visit& visit) const {
    const auto low_i = static_cast<std::int64_t>(std::ceil((x - reach) / dx)),
               high_i = static_cast<std::int64_t>(std::floor((x + reach) / dx)),
               low_j = static_cast<std::int64_t>(std::ceil((y - reach) / dy)),
               high_j = static_cast<std::int64_t>(std::floor((y + reach) / dy));
    for (std::int64_t j = low_j; j <= high_j; ++j)
      for (std::int64_t i = low_i; i <= high_i; ++i) {
        const double distance = std::hypot(static_cast<double>(i) * dx - x, static_cast<double>(j) * dy - y);
        if (distance <= reach) visit(at(i, j), distance);
      }
  }
};

}  // namespace

double open_fraction(const Packing& packing, double reach) {
  Grid grid{std::max<std::int64_t>(1, std::llround(packing.width * nodes_per_reach / reach)),
            std::max<std::int64_t>(1, std::llround(packing.height * nodes_per_reach / reach)), 0.0, 0.0};
  grid.dx = packing.width / static_cast<double>(grid.nx);
  grid.dy = packing.height / static_cast<double>(grid.ny);
  std::vector<double> gap(static_cast<std::size_t>(grid.nx * grid.ny), reach);  // to the nearest surface, at most reach
  for (std::size_t d = 0; d < packing.x.size(); ++d) {
    const double radius = packing.radius[d];
    grid.around(packing.x[d], packing.y[d], radius + reach,
                [&](std::size_t node, double distance) { gap[node] = std::min(gap[node], distance - radius); });
  }
  std::vector<std::uint8_t> open(gap.size(), 0);
  for (std::int64_t j = 0; j < grid.ny; ++j)
    for (std::int64_t i = 0; i < grid.nx; ++i) {
      if (gap[grid.at(i, j)] < reach) continue;
      open[grid.at(i, j)] = 1;
      const bool inside = gap[grid.at(i + 1, j)] >= reach && gap[grid.at(i - 1, j)] >= reach &&
                          gap[grid.at(i, j + 1)] >= reach && gap[grid.at(i, j - 1)] >= reach;
      if (inside) continue;  // its neighbours cover what it would, but for itself
      grid.around(static_cast<double>(i) * grid.dx, static_cast<double>(j) * grid.dy, reach,
                  [&](std::size_t node, double) { open[node] = 1; });
    }
  const auto count = std::count(open.begin(), open.end(), 1);
  return static_cast<double>(count) / static_cast<double>(open.size());
}

}  // namespace perfora::geometry
