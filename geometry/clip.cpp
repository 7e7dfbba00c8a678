// What is here: the discs a layout takes away, and the order of those left.
// What is not: walls between them (wall_discretised.cpp).
#include "geometry/clip.h"

#include <algorithm>
#include <vector>

#include "geometry/hilbert.h"
#include "geometry/near_holes.h"

namespace perfora::geometry {

Packing clip_packing(const Packing& packing, const PerforationLayout& layout, ClipRule rule) {
  const double largest_disc =
      packing.radius.empty() ? 0.0 : *std::max_element(packing.radius.begin(), packing.radius.end());
  const NearHoles holes(layout, rule == ClipRule::whole ? largest_disc : 0.0);
  std::vector<double> x, y, radius;
  for (std::size_t i = 0; i < packing.x.size(); ++i) {
    const double margin = rule == ClipRule::whole ? packing.radius[i] : 0.0;
    const auto& near = holes.around(packing.x[i], packing.y[i]);
    const bool taken = std::any_of(near.begin(), near.end(), [&](const NearHoles::Image& image) {
      const Perforation& hole = layout.perforations[static_cast<std::size_t>(image.hole)];
      const double dx = packing.x[i] - hole.x - image.column * packing.width;
      const double dy = packing.y[i] - hole.y - image.row * packing.height;
      return hole.contains(hole.x + dx, hole.y + dy, margin);
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
