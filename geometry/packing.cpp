// What is here: what is measured on a packing as it stands: overlaps, contacts, rattlers.
// What is not: how it is made (make_packing.cpp).
#include "geometry/packing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/cell_grid.h"

namespace perfora::geometry {

namespace {

struct Contacts {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  double max_overlap_ratio = 0.0;
};

Contacts find_contacts(const Packing& packing) {
  Contacts contacts;
  const double largest = *std::max_element(packing.radius.begin(), packing.radius.end());
  struct Point {
    double x, y;
  };
  const auto point = [&packing](std::size_t i) { return Point{packing.x[i], packing.y[i]}; };
  const CellGrid grid(packing.width, packing.height, 2.0 * largest, packing.x.size(), point);
  for (std::size_t i = 0; i < packing.x.size(); ++i)
    grid.for_each_near(packing.x[i], packing.y[i], [&](std::int32_t other) {
      const std::size_t j = static_cast<std::size_t>(other);
      if (j <= i) return;
      const double dx = nearest_image(packing.x[j] - packing.x[i], packing.width, 0.5 * packing.width);
      const double dy = nearest_image(packing.y[j] - packing.y[i], packing.height, 0.5 * packing.height);
      const double overlap = packing.radius[i] + packing.radius[j] - std::hypot(dx, dy);
      if (overlap <= 0.0) return;
      contacts.pairs.emplace_back(static_cast<std::int32_t>(i), other);
      const double ratio = 0.5 * overlap / std::min(packing.radius[i], packing.radius[j]);
      contacts.max_overlap_ratio = std::max(contacts.max_overlap_ratio, ratio);
    });
  return contacts;
}

/// Discs with fewer than three contacts are taken out until none is left; sets the coordination number of the rest.
void count_contacts(const Contacts& contacts, std::size_t discs, PackingQuality& quality) {
  std::vector<std::vector<std::int32_t>> partners(discs);
  for (const auto& [i, j] : contacts.pairs) {
    partners[static_cast<std::size_t>(i)].push_back(j);
    partners[static_cast<std::size_t>(j)].push_back(i);
  }
  std::vector<std::int32_t> left(discs), leaving;
  std::vector<bool> rattler(discs, false);
  for (std::size_t i = 0; i < discs; ++i) {
    left[i] = static_cast<std::int32_t>(partners[i].size());
    if (left[i] < 3) {
      rattler[i] = true;
      leaving.push_back(static_cast<std::int32_t>(i));
    }
  }
  while (!leaving.empty()) {
    const std::int32_t gone = leaving.back();
    leaving.pop_back();
    for (std::int32_t partner : partners[static_cast<std::size_t>(gone)]) {
      const std::size_t j = static_cast<std::size_t>(partner);
      if (--left[j] < 3 && !rattler[j]) {
        rattler[j] = true;
        leaving.push_back(partner);
      }
    }
  }
  std::int64_t ends = 0, carriers = 0;
  for (std::size_t i = 0; i < discs; ++i) {
    if (rattler[i]) continue;
    ++carriers;
    ends += left[i];
  }
  quality.coordination_number = carriers > 0 ? static_cast<double>(ends) / static_cast<double>(carriers) : 0.0;
  quality.rattler_fraction = 1.0 - static_cast<double>(carriers) / static_cast<double>(discs);
}

}  // namespace

double Packing::mean_diameter() const {
  double sum = 0.0;
  for (double r : radius) sum += 2.0 * r;
  return radius.empty() ? 0.0 : sum / static_cast<double>(radius.size());
}

PackingQuality measure_packing(const Packing& packing) {
  PackingQuality quality;
  if (packing.x.empty()) return quality;
  double area = 0.0;
  for (double r : packing.radius) area += std::numbers::pi * r * r;
  quality.solid_fraction = area / (packing.width * packing.height);
  const Contacts contacts = find_contacts(packing);
  quality.max_overlap_ratio = contacts.max_overlap_ratio;
  count_contacts(contacts, packing.x.size(), quality);
  return quality;
}

}  // namespace perfora::geometry
