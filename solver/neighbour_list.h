// What is here: near pairs with their contact history (Verlet list, full rows: each pair stands in both its discs'
// rows, mirrored). What is not: the contact force (laws.h), the loops over rows (kernels).
#pragma once

#include <cstdint>
#include <vector>

#include "solver/bond_network.h"
#include "solver/cell.h"
#include "solver/cell_grid.h"
#include "solver/laws.h"
#include "solver/state.h"

namespace perfora::solver {

/// One end of a near pair. Both ends hold the same values at the end of a step.
struct NeighbourSlot {
  std::int32_t neighbour = 0;
  std::int32_t bonded = 0;  ///< 1 while an intact bond keeps the pair from contact
  double contact_distance =
      0.0;  ///< distance at which it touches: R_i + R_j, or l0 after a break until it has once separated
  ContactHistory history;
};

class NeighbourList {
 public:
  /// `skin`: pairs are listed up to R_i + R_j + skin, m.
  void configure(std::int32_t discs, double largest_radius, double skin);
  /// Lists all near pairs anew and carries histories over. Intact bonds are looked up in the network (rows of
  /// `first_bond`). Keeps its memory.
  void rebuild(const DiscState& discs, const CellMatrix& cell, const BondNetwork& network, int threads = 1);
  /// Whether the list may miss a pair: largest fluctuating displacement since the last rebuild and the change of the
  /// cell against the skin.
  bool outdated(double largest_displacement, const CellMatrix& cell) const;
  /// Farthest fluctuating displacement of a disc since the last rebuild, m.
  double largest_displacement(const DiscState& discs, const CellMatrix& cell) const;
  /// A bond i-j just broke: the end in row i becomes a contact candidate. Called once from each end. Does nothing for a
  /// pair that is not near. Returns the index of the slot, -1 for none.
  std::int32_t release(std::int32_t i, std::int32_t j, double contact_distance);

  std::int32_t row_begin(std::int32_t i) const { return start_[static_cast<std::size_t>(i)]; }
  std::int32_t row_end(std::int32_t i) const { return start_[static_cast<std::size_t>(i) + 1]; }
  /// Number of slots of row i without an intact bond: 0 lets a kernel skip the row.
  std::int32_t active(std::int32_t i) const { return active_[static_cast<std::size_t>(i)]; }
  std::vector<NeighbourSlot>& slots() { return slots_; }
  const std::vector<NeighbourSlot>& slots() const { return slots_; }
  NeighbourSlot* find(std::int32_t i, std::int32_t j);

  double skin() const { return skin_; }
  const std::vector<std::uint64_t>& reference_x() const { return reference_x_; }
  const std::vector<std::uint64_t>& reference_y() const { return reference_y_; }
  std::int64_t rebuilds() const { return rebuilds_; }

  /// Everything a checkpoint needs to give the same bits again.
  struct Snapshot {
    std::vector<std::int32_t> start, neighbour, bonded, active;
    std::vector<double> contact_distance, shear, viscous_force;
    std::vector<std::uint64_t> reference_x, reference_y;
    CellMatrix reference_cell;
    std::int64_t rebuilds = 0;
  };
  Snapshot snapshot() const;
  void restore(const Snapshot& snapshot);

 private:
  void find_bond_rows(const BondNetwork& network, std::int32_t discs);
  bool intact(const BondNetwork& network, std::int32_t i, std::int32_t j) const;
  /// Appends row i to `slots`; its length stands in start_[i + 1] until all rows are there.
  void list_row(std::int32_t i, const DiscState& discs, const CellMatrix& cell, const BondNetwork& network,
                std::vector<NeighbourSlot>& slots);

  double largest_radius_ = 0.0;
  double skin_ = 0.0;
  CellMatrix reference_cell_;
  std::vector<std::uint64_t> reference_x_, reference_y_;
  std::vector<std::int32_t> start_, active_, old_start_, first_bond_;
  std::vector<NeighbourSlot> slots_, old_slots_;
  std::vector<std::vector<NeighbourSlot>> chunk_slots_;
  CellGrid grid_;
  std::int64_t rebuilds_ = 0;
};

}  // namespace perfora::solver
