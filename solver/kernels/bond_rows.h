// What is here: the bonds of all discs as the vector kernels read them, in sliced rows. What is not: the slicing
// (sliced_rows.h), the loop over them (bond_kernel.h), the law.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/bond_network.h"
#include "solver/kernels/sliced_rows.h"
#include "solver/kernels/vector_kernels.h"
#include "solver/laws.h"

namespace perfora::solver {

/// Every bond stands in the rows of both its discs ("full list"), as seen from there. The `lanes` discs of a slice have
/// about equally many bonds: within a chunk, discs are sorted by their number of bonds. Rows are sorted by neighbour,
/// so that forces are summed in an order that depends on nothing else.
class BondRows {
 public:
  explicit BondRows(int lanes) : lanes_(lanes), rows_(lanes) {}

  /// Lays the rows out anew, rest lengths in `unit` m. Bonds that are `compacted` are left out, `broken` ones keep an
  /// empty place.
  void build(const BondNetwork& network, std::int32_t discs, const BondLaw& law, double unit);

  /// Points the layout's part of a kernel task at the rows of chunk `chunk`.
  void aim(BondTask& task, std::int32_t chunk) const;

  std::int32_t bond(std::int64_t slot) const { return bond_[static_cast<std::size_t>(slot)]; }
  std::int32_t neighbour(std::int64_t slot) const;
  double damage(std::int64_t slot) const { return static_cast<double>(damage_[static_cast<std::size_t>(slot)]); }
  void set_damage(std::int64_t slot, double damage, double threshold);
  /// Empties the place of a broken bond: its neighbour is then the disc itself and every force exactly zero.
  void clear(std::int64_t slot, std::int32_t own);

  /// Unit of the stored thresholds.
  double threshold_unit() const { return threshold_unit_; }
  /// Unit of the part of the rest lengths that floats do not hold, in the unit of length.
  double length_residual_unit() const { return length_residual_unit_; }
  /// Places over bond ends: 1 without padding.
  double padding() const;

 private:
  std::size_t group_bytes() const { return static_cast<std::size_t>(lanes_) * 4 * sizeof(float); }
  float* field(std::int64_t slot, int which);
  std::uint16_t stored(double threshold) const;

  int lanes_;
  SlicedRows rows_;
  double threshold_unit_ = 1.0, length_residual_unit_ = 0.0;
  std::vector<char, CacheLineAllocator<char>> groups_;
  std::vector<std::uint16_t, CacheLineAllocator<std::uint16_t>> threshold_;
  std::vector<std::int8_t, CacheLineAllocator<std::int8_t>> length_residual_;
  std::vector<float, CacheLineAllocator<float>> damage_;
  std::vector<std::uint8_t> damaged_;  // per group
  std::vector<std::int32_t> bond_;     // id, -1: empty
};

}  // namespace perfora::solver
