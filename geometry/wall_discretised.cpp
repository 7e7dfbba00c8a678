// What is here: the thinnest wall as the clipped discs build it.
// What is not: the exact wall of the layout (wall.cpp).
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/cell_grid.h"
#include "geometry/layout.h"
#include "geometry/make_packing.h"

namespace perfora::geometry {

namespace {

/// Discs of a dilated packing do not touch: grown by this much they stop the view from a hole into the wall behind the
/// first layer.
constexpr double shade_growth = 1.1;
/// Discs that border a hole have their centre within this many of the largest diameters of its edge.
constexpr double border_depth = 2.0;

struct Disc {
  double x, y, radius;
};

/// Discs around one hole, relative to its centre, that see the centre past all others.
std::vector<Disc> border_discs(const Packing& clipped, const CellGrid& grid, const Perforation& hole, double depth) {
  std::vector<Disc> near;
  grid.for_each_near(hole.x, hole.y, [&](std::int32_t index) {
    const std::size_t i = static_cast<std::size_t>(index);
    const double dx = nearest_image(clipped.x[i] - hole.x, clipped.width, 0.5 * clipped.width);
    const double dy = nearest_image(clipped.y[i] - hole.y, clipped.height, 0.5 * clipped.height);
    if (std::hypot(dx, dy) < 0.5 * hole.diameter + depth) near.push_back({dx, dy, clipped.radius[i]});
  });
  std::vector<Disc> border;
  for (const Disc& disc : near) {
    const bool shaded = std::any_of(near.begin(), near.end(), [&](const Disc& other) {
      if (&other == &disc) return false;
      return Perforation{other.x, other.y, 2.0 * shade_growth * other.radius}.segment_depth(0.0, 0.0, disc.x, disc.y) >
                 0.0 &&
             other.x * other.x + other.y * other.y < disc.x * disc.x + disc.y * disc.y;
    });
    if (!shaded) border.push_back(disc);
  }
  return border;
}

}  // namespace

// The wall between two holes is the smallest width, outside to outside, of a disc that borders the one and a disc that
// borders the other.
double thinnest_wall_discretised(const Packing& clipped, const PerforationLayout& layout) {
  const ThinnestWall exact = thinnest_wall(layout);
  if (exact.first < 0 || exact.thickness <= 0.0 || clipped.x.empty()) return exact.thickness;
  const double largest = 2.0 * *std::max_element(clipped.radius.begin(), clipped.radius.end());
  const double depth = border_depth * largest;
  double largest_hole = 0.0;
  for (const Perforation& hole : layout.perforations) largest_hole = std::max(largest_hole, 0.5 * hole.diameter);
  struct Point {
    double x, y;
  };
  const CellGrid grid(clipped.width, clipped.height, largest_hole + depth, clipped.x.size(), [&](std::size_t i) {
    return Point{clipped.x[i], clipped.y[i]};
  });
  std::vector<std::vector<Disc>> borders;
  for (const Perforation& hole : layout.perforations) borders.push_back(border_discs(clipped, grid, hole, depth));

  // A wall is measured at most one largest disc a side wider than it is, so only nearly thinnest walls matter.
  const double nearly = exact.thickness + 2.0 * largest;
  double thinnest = std::numeric_limits<double>::infinity();
  const auto measure = [&](std::size_t a, std::size_t b, double shift_x, double shift_y) {
    const Perforation &first = layout.perforations[a], &second = layout.perforations[b];
    if (first.signed_gap(second, shift_x, shift_y) > nearly) return;
    for (const Disc& p : borders[a])
      for (const Disc& q : borders[b]) {
        const double dx = second.x + shift_x + q.x - first.x - p.x, dy = second.y + shift_y + q.y - first.y - p.y;
        thinnest = std::min(thinnest, std::hypot(dx, dy) + p.radius + q.radius);
      }
  };
  for (std::size_t a = 0; a < borders.size(); ++a)
    for (std::size_t b = a; b < borders.size(); ++b)
      for (int row = -1; row <= 1; ++row)
        for (int column = -1; column <= 1; ++column)
          if (a != b || row != 0 || column != 0) measure(a, b, column * layout.width, row * layout.height);
  return std::isfinite(thinnest) ? thinnest : exact.thickness;
}

}  // namespace perfora::geometry
