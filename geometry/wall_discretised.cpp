// What is here: the thinnest wall as the clipped discs build it.
// What is not: the exact wall of the layout (wall.cpp).
#include "geometry/wall.h"

#include <algorithm>
#include <vector>

#include "geometry/cell_grid.h"

namespace perfora::geometry {

// The void of a hole is the hole with its rim moved until no disc enters it: of a circle the largest about its centre.
// Discs whose centre lies just outside the hole reach into it, so with ClipRule::centre the voids are smaller than the
// holes and the walls wider.
double thinnest_wall_discretised(const Packing& clipped, const PerforationLayout& layout) {
  const ThinnestWall exact = thinnest_wall(layout);
  if (exact.first < 0 || clipped.x.empty()) return exact.thickness;
  double largest_hole = 0.0;
  for (const Perforation& hole : layout.perforations) largest_hole = std::max(largest_hole, hole.reach());
  const double largest_disc = *std::max_element(clipped.radius.begin(), clipped.radius.end());
  // Discs farther than this from a hole's centre cannot be nearest to it unless the neighbourhood is empty.
  const double reach = largest_hole + 4.0 * largest_disc;
  const CellGrid grid(clipped.width, clipped.height, reach, clipped.x.size(), [&](std::size_t i) {
    return Point{clipped.x[i], clipped.y[i]};
  });
  // Discs near a long hole may be so through another image than the one nearest to its centre.
  const int around = 2.0 * reach > std::min(clipped.width, clipped.height) ? 1 : 0;
  PerforationLayout voids = layout;
  std::vector<NearDisc> near;
  for (Perforation& hole : voids.perforations) {
    near.clear();
    grid.for_each_near(hole.x, hole.y, [&](std::int32_t index) {
      const std::size_t i = static_cast<std::size_t>(index);
      const double dx = nearest_image(clipped.x[i] - hole.x, clipped.width, 0.5 * clipped.width);
      const double dy = nearest_image(clipped.y[i] - hole.y, clipped.height, 0.5 * clipped.height);
      for (int column = -around; column <= around; ++column)
        for (int row = -around; row <= around; ++row)
          near.push_back({{dx + column * clipped.width, dy + row * clipped.height}, clipped.radius[i]});
    });
    hole = hole.clear_of(near, reach);
  }
  return thinnest_wall(voids).thickness;
}

}  // namespace perfora::geometry
