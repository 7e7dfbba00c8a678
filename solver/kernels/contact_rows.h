// What is here: the near pairs of all discs as the vector kernels read them, in sliced rows with the contacts' history.
// What is not: the slicing (sliced_rows.h), which pairs are near (neighbour_list.h).
#pragma once

#include <cstdint>
#include <vector>

#include "solver/kernels/sliced_rows.h"
#include "solver/kernels/vector_kernels.h"
#include "solver/neighbour_list.h"

namespace perfora::solver {

/// Places for all near pairs, bonded ones too: those are empty (touch 0, neighbour the disc itself) until their bond
/// breaks. The order is that of the near pairs and does not depend on when the rows were laid out.
class ContactRows {
 public:
  explicit ContactRows(int lanes) : lanes_(lanes), rows_(lanes) {}

  void build(const NeighbourList& pairs, const DiscState& discs, const ContactLaw& law);
  /// Histories and touching distances back into the near pairs.
  void export_history(NeighbourList& pairs) const;
  /// Fills the place of near pair `pair` (its index in the slots), whose bond has just broken.
  void open(const NeighbourList& pairs, std::int32_t i, std::int32_t pair, const DiscState& discs,
            const ContactLaw& law);

  /// Points the layout's part of a kernel task at the rows of chunk `chunk`.
  void aim(ContactTask& task, std::int32_t chunk);

 private:
  template <class T>
  using Aligned = std::vector<T, CacheLineAllocator<T>>;

  int lanes_;
  SlicedRows rows_;
  Aligned<std::int32_t> neighbour_;
  Aligned<float> contact_distance_, damping_, shear_, viscous_force_;
  std::vector<std::int32_t> place_;         // of each near pair
  std::vector<std::uint8_t> active_;        // per group: some place is filled
  std::vector<std::int32_t> slice_active_;  // per slice: groups with a filled place
};

}  // namespace perfora::solver
