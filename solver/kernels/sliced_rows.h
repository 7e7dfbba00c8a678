// What is here: rows of unequal length, one a disc, as the vector kernels read them: sliced, one disc a lane
// (SELL-C-sigma: Kreutzer et al., SIAM J. Sci. Comput. 36, 2014, with sigma = a chunk of discs). What is not: what
// stands in the rows (bond_rows.h, contact_rows.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "solver/state.h"

namespace perfora::solver {

/// Memory that starts on a cache line.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}  // NOLINT: allocators convert
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  bool operator==(const CacheLineAllocator&) const { return true; }
};

/// Where a disc's record stands, in bytes of the array of records.
inline std::int32_t record_offset(std::int32_t disc) {
  return static_cast<std::int32_t>(static_cast<std::int64_t>(disc) * std::int64_t{sizeof(DiscRecord)});
}

/// The `lanes` discs of a slice have about equally long rows: within a chunk, discs are sorted by length. The k-th
/// places of a slice's discs make a group of `lanes` consecutive places.
class SlicedRows {
 public:
  explicit SlicedRows(int lanes) : lanes_(lanes) {}

  /// `length`: of each disc's row.
  void build(const std::vector<std::int32_t>& length);

  int lanes() const { return lanes_; }
  std::size_t groups() const { return static_cast<std::size_t>(first_.back()); }
  std::size_t slices() const { return first_.size() - 1; }
  std::int32_t slice_of(std::int32_t disc) const { return slice_of_[static_cast<std::size_t>(disc)]; }
  /// The k-th place of a disc's row.
  std::int64_t place(std::int32_t disc, std::int32_t k) const {
    const auto d = static_cast<std::size_t>(disc);
    return static_cast<std::int64_t>(first_[static_cast<std::size_t>(slice_of_[d])] + k) * lanes_ + lane_of_[d];
  }
  /// Calls visit(place, disc) for every place, those to spare included; these go with a disc of their slice.
  template <class Visit>
  void for_each_place(const Visit& visit) const {
    for (std::size_t slice = 0; slice < slices(); ++slice) {
      const std::int32_t* const disc = &disc_[slice * static_cast<std::size_t>(lanes_)];
      for (std::int32_t g = first_[slice]; g < first_[slice + 1]; ++g)
        for (int lane = 0; lane < lanes_; ++lane)
          visit(static_cast<std::int64_t>(g) * lanes_ + lane, disc[lane] >= 0 ? disc[lane] : disc[0]);
    }
  }

  /// Points the layout's part of a kernel task at the rows of chunk `chunk`.
  template <class Task>
  void aim(Task& task, std::int32_t chunk) const {
    task.slice_first = first_.data();
    task.slice_disc = disc_.data();
    task.slice_begin = chunk_first_[static_cast<std::size_t>(chunk)];
    task.slice_end = chunk_first_[static_cast<std::size_t>(chunk) + 1];
  }

 private:
  int lanes_;
  std::vector<std::int32_t> first_ = {0};         // per slice: its first group; one more at the end
  std::vector<std::int32_t> disc_;                // per slice and lane, -1: none
  std::vector<std::int32_t> chunk_first_;         // per chunk: its first slice; one more at the end
  std::vector<std::int32_t> slice_of_, lane_of_;  // per disc
};

}  // namespace perfora::solver
