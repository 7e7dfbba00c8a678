// What is here: the discs a layout takes away, and the order of those left.
// What is not: walls between them (wall_discretised.cpp).
#include "geometry/clip.h"

#include <algorithm>
#include <vector>

#include "geometry/cell_grid.h"
#include "geometry/hilbert.h"

namespace perfora::geometry {

Packing clip_packing(const Packing& packing, const PerforationLayout& layout, ClipRule rule) {
  double largest_hole = 0.0;
  for (const Perforation& hole : layout.perforations) largest_hole = std::max(largest_hole, hole.reach());
  const double largest_disc =
      packing.radius.empty() ? 0.0 : *std::max_element(packing.radius.begin(), packing.radius.end());
  const double reach = std::max(largest_hole + largest_disc, 1e-3 * std::min(packing.width, packing.height));
  const CellGrid holes(packing.width, packing.height, reach, layout.perforations.size(),
                       [&](std::size_t k) { return layout.perforations[k]; });
  std::vector<double> x, y, radius;
  for (std::size_t i = 0; i < packing.x.size(); ++i) {
    bool taken = false;
    holes.for_each_near(packing.x[i], packing.y[i], [&](std::int32_t index) {
      const Perforation& hole = layout.perforations[static_cast<std::size_t>(index)];
      const double dx = nearest_image(packing.x[i] - hole.x, packing.width, 0.5 * packing.width);
      const double dy = nearest_image(packing.y[i] - hole.y, packing.height, 0.5 * packing.height);
      const double margin = rule == ClipRule::whole ? packing.radius[i] : 0.0;
      taken = taken || hole.contains(hole.x + dx, hole.y + dy, margin);
    });
    if (taken) continue;
    x.push_back(packing.x[i]);
    y.push_back(packing.y[i]);
    radius.push_back(packing.radius[i]);
  }
  Packing clipped;
  clipped.key = packing.key;
  clipped.width = packing.width;
  clipped.height = packing.height;
  clipped.quality = packing.quality;
  for (std::size_t i : hilbert_order(x, y)) {
    clipped.x.push_back(x[i]);
    clipped.y.push_back(y[i]);
    clipped.radius.push_back(radius[i]);
  }
  return clipped;
}

}  // namespace perfora::geometry
