// What is here: finding the pairs to bond and their strengths.
#include "solver/bond_network.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/near_holes.h"
#include "solver/cell_grid.h"
#include "solver/noise.h"

namespace perfora::solver {
namespace {

constexpr double allowed_dip =
    0.25;  // of the mean diameter, docs/user/theory.md "Bonds": the soft rim of clipped discs is not a void

struct Branch {
  double x, y;
};

/// r_j - r_i by minimum image in a rectangle.
Branch minimum_image(const geometry::Packing& packing, std::int32_t i, std::int32_t j) {
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  double dx = packing.x[b] - packing.x[a], dy = packing.y[b] - packing.y[a];
  dx -= packing.width * std::nearbyint(dx / packing.width);
  dy -= packing.height * std::nearbyint(dy / packing.height);
  return {dx, dy};
}

/// The perforations, periodic images included, that lie between discs.
class Perforations {
 public:
  /// For segments no longer than `longest`, which may dip into a hole by `allowed`. Holes into which none dips deeper
  /// need no test.
  Perforations(const geometry::PerforationLayout& layout, double longest, double allowed)
      : layout_(deep_enough(layout, longest, allowed)), near_(layout_, 0.5 * longest), allowed_(allowed) {
    for (const geometry::Perforation& hole : layout_.perforations) {
      const double far = hole.reach() + longest;
      far_squared_.push_back(far * far);
    }
  }
  /// Whether a hole separates the ends of the segment from (x, y) along the branch.
  bool separates(double x, double y, const Branch& branch) const {
    const double width = layout_.width, height = layout_.height;
    const double mid_x = x + 0.5 * branch.x, mid_y = y + 0.5 * branch.y;
    const double columns = std::floor(mid_x / width), rows = std::floor(mid_y / height);
    for (const auto& image : near_.around(mid_x - columns * width, mid_y - rows * height)) {
      const auto at = static_cast<std::size_t>(image.hole);
      const geometry::Perforation& hole = layout_.perforations[at];
      // The image of the hole as seen from the middle of the segment.
      const double cx = hole.x - mid_x + (image.column + columns) * width;
      const double cy = hole.y - mid_y + (image.row + rows) * height;
      if (cx * cx + cy * cy > far_squared_[at]) continue;
      geometry::Perforation near = hole;
      near.x = x + 0.5 * branch.x + cx;
      near.y = y + 0.5 * branch.y + cy;
      if (near.segment_depth(x, y, x + branch.x, y + branch.y) > allowed_) return true;
    }
    return false;
  }

 private:
  static geometry::PerforationLayout deep_enough(const geometry::PerforationLayout& layout, double longest,
                                                 double allowed) {
    geometry::PerforationLayout deep{layout.width, layout.height, {}};
    for (const geometry::Perforation& hole : layout.perforations)
      if (hole.deepest_dip(longest) > allowed) deep.perforations.push_back(hole);
    return deep;
  }

  geometry::PerforationLayout layout_;
  geometry::NearHoles near_;
  double allowed_;
  std::vector<double> far_squared_;  ///< no segment whose middle lies farther from the centre reaches into the hole
};

template <class Found>
void find_bonds(const geometry::Packing& packing, const geometry::PerforationLayout& layout, double horizon,
                double mean_diameter, const Found& found) {
  const double r_h = horizon * mean_diameter;
  double largest_radius = 0.0;
  for (const double radius : packing.radius) largest_radius = std::max(largest_radius, radius);
  const double reach = std::max(r_h, 2.0 * largest_radius);
  const Perforations perforations(layout, reach, allowed_dip * mean_diameter);
  CellGrid grid;
  grid.build(packing.size(), reach / packing.width, reach / packing.height, [&](std::int32_t k) {
    const auto at = static_cast<std::size_t>(k);
    return std::pair{packing.x[at] / packing.width, packing.y[at] / packing.height};
  });
  std::vector<std::int32_t> row;
  for (std::int32_t i = 0; i < packing.size(); ++i) {
    row.clear();
    grid.around(i, [&](std::int32_t j) {
      if (j > i) row.push_back(j);
    });
    std::sort(row.begin(), row.end());
    const auto at = static_cast<std::size_t>(i);
    for (const std::int32_t j : row) {
      const Branch branch = minimum_image(packing, i, j);
      const double contact_distance = packing.radius[at] + packing.radius[static_cast<std::size_t>(j)];
      const double limit = std::max(r_h, contact_distance);
      if (branch.x * branch.x + branch.y * branch.y > limit * limit) continue;
      if (perforations.separates(packing.x[at], packing.y[at], branch)) continue;
      found(i, j, branch);
    }
  }
}

}  // namespace

BondNetwork make_bond_network(const geometry::Packing& clipped, const geometry::PerforationLayout& layout,
                              const MaterialOptions& material, const NoiseOptions& noise, std::uint64_t noise_seed,
                              double mean_diameter, const FieldFrame& frame) {
  std::optional<PerlinField> field;
  if (noise.kind == NoiseKind::perlin)
    field.emplace(frame.width > 0.0 ? frame.width : clipped.width, frame.height > 0.0 ? frame.height : clipped.height,
                  noise.length, noise_seed);
  const double amplitude = perlin_amplitude(noise);
  BondNetwork network;
  find_bonds(clipped, layout, material.horizon, mean_diameter,
             [&](std::int32_t i, std::int32_t j, const Branch& branch) {
               const double length = std::sqrt(branch.x * branch.x + branch.y * branch.y);
               const auto at = static_cast<std::size_t>(i);
               double strength = 1.0;
               if (field)
                 strength = perlin_factor(field->value(clipped.x[at] - frame.origin_x + 0.5 * branch.x,
                                                       clipped.y[at] - frame.origin_y + 0.5 * branch.y),
                                          amplitude, noise.mapping);
               if (noise.kind == NoiseKind::weibull)
                 strength = weibull_factor(noise_seed, network.size(), noise.weibull_modulus);
               network.i.push_back(i);
               network.j.push_back(j);
               network.reference_length.push_back(length);
               network.direction_x.push_back(branch.x / length);
               network.direction_y.push_back(branch.y / length);
               network.strength.push_back(strength);
             });
  network.damage.assign(network.i.size(), 0.0);
  network.state.assign(network.i.size(), BondState::intact);
  return network;
}

StrengthStatistics strength_statistics(const BondNetwork& network) {
  StrengthStatistics s;
  if (network.strength.empty()) return s;
  double sum = 0.0, squares = 0.0;
  s.smallest = std::numeric_limits<double>::infinity();
  s.largest = 0.0;
  for (const double f : network.strength) {
    sum += f;
    s.smallest = std::min(s.smallest, f);
    s.largest = std::max(s.largest, f);
  }
  const double count = static_cast<double>(network.size());
  s.mean = sum / count;
  for (const double f : network.strength) squares += (f - s.mean) * (f - s.mean);
  s.deviation = std::sqrt(squares / count);
  return s;
}

std::int64_t count_bonds(const geometry::Packing& clipped, const geometry::PerforationLayout& layout, double horizon,
                         double mean_diameter) {
  std::int64_t count = 0;
  find_bonds(clipped, layout, horizon, mean_diameter, [&](std::int32_t, std::int32_t, const Branch&) { ++count; });
  return count;
}

}  // namespace perfora::solver
