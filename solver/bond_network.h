// What is here: BondNetwork, one row a bond with an id for life, and how it is made from a clipped packing.
// What is not: kernel layouts (each backend builds its own), forces.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/packing.h"
#include "geometry/perforation.h"
#include "solver/options.h"

namespace perfora::solver {

/// State of a bond: intact, broken in this layout of the kernels (its slot still there, empty), broken and compacted
/// away.
enum class BondState : std::uint8_t { intact = 0, broken = 1, compacted = 2 };

/// Bonds as equally long arrays, i < j, sorted by (i, j). Files, events, analysis and checkpoints see only this.
struct BondNetwork {
  std::vector<std::int32_t> i, j;
  std::vector<double> reference_length;          ///< l0, m
  std::vector<double> direction_x, direction_y;  ///< e0 from i to j in the undeformed cell
  std::vector<double> strength;                  ///< factor on both thresholds
  std::vector<double> damage;                    ///< D
  std::vector<BondState> state;

  std::int64_t size() const { return static_cast<std::int64_t>(i.size()); }
};

/// Where the strength field lies when the packing is a block inside a larger cell.
struct FieldFrame {
  double width = 0.0, height = 0.0;       ///< periods, m; 0: the packing's own
  double origin_x = 0.0, origin_y = 0.0;  ///< of the field in the packing, m
};

/// Bonds every pair with centre distance <= r_H = horizon x mean_diameter, and every touching pair; none where the
/// segment dips into a perforation by more than 0.25 mean_diameter (docs/user/theory.md, "Bonds"). Strength factors
/// from the noise options at the bond's midpoint. Periodic. Cost O(discs + bonds).
BondNetwork make_bond_network(const geometry::Packing& clipped, const geometry::PerforationLayout& layout,
                              const MaterialOptions& material, const NoiseOptions& noise, std::uint64_t noise_seed,
                              double mean_diameter, const FieldFrame& frame = {});

struct StrengthStatistics {
  double mean = 1.0, deviation = 0.0, smallest = 1.0, largest = 1.0;
};
StrengthStatistics strength_statistics(const BondNetwork& network);

/// Number of bonds of a clipped packing without making them, for pack's bonds_per_disc.
std::int64_t count_bonds(const geometry::Packing& clipped, const geometry::PerforationLayout& layout, double horizon,
                         double mean_diameter);

}  // namespace perfora::solver
