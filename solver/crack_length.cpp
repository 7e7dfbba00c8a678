// What is here: cracks as clusters of broken bonds, and their length across the loading.
#include "solver/crack_length.h"

#include <cmath>
#include <set>

#include "solver/cell_grid.h"
#include "solver/clusters.h"

namespace perfora::solver {
namespace {

double wrapped(double value, double period) {
  return value - period * std::floor(value / period);
}

}  // namespace

double projected_crack_length(const std::vector<results::BreakEvent>& events, double width, double height,
                              int direction, double link, double shortest) {
  const std::size_t n = events.size();
  if (n == 0) return 0.0;
  Clusters clusters(n);
  CellGrid grid;
  grid.build(static_cast<std::int32_t>(n), link / width, link / height, [&](std::int32_t k) {
    const results::BreakEvent& e = events[static_cast<std::size_t>(k)];
    return std::pair{wrapped(e.x, width) / width, wrapped(e.y, height) / height};
  });
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(n); ++i)
    grid.around(i, [&](std::int32_t j) {
      const results::BreakEvent &a = events[static_cast<std::size_t>(i)], &b = events[static_cast<std::size_t>(j)];
      double dx = b.x - a.x, dy = b.y - a.y;
      dx -= width * std::nearbyint(dx / width);
      dy -= height * std::nearbyint(dy / height);
      if (dx * dx + dy * dy <= link * link) clusters.join(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
    });
  // Each cluster's fraction of the side, in pieces of about `link` that divide it.
  const double side = direction == 0 ? width : height;
  const double pieces = std::max(1.0, std::floor(side / link)), piece = side / pieces;
  std::vector<std::set<int>> occupied(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double place = wrapped(direction == 0 ? events[k].x : events[k].y, side);
    occupied[clusters.root(k)].insert(static_cast<int>(place / piece));
  }
  double length = 0.0;
  for (const std::set<int>& part : occupied) {
    const double reach = static_cast<double>(part.size()) * piece;
    if (reach >= shortest) length += reach;
  }
  return length;
}

}  // namespace perfora::solver
