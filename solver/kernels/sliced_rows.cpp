// What is here: laying out sliced rows. What is not: what stands in them.
#include "solver/kernels/sliced_rows.h"

#include <algorithm>
#include <numeric>

namespace perfora::solver {

void SlicedRows::build(const std::vector<std::int32_t>& length) {
  const auto at = [](std::int64_t k) { return static_cast<std::size_t>(k); };
  const auto discs = static_cast<std::int32_t>(length.size());
  const std::int32_t chunks = (discs + chunk_discs - 1) / chunk_discs;
  first_.assign(1, 0);
  disc_.clear();
  chunk_first_.assign(1, 0);
  slice_of_.resize(length.size());
  lane_of_.resize(length.size());
  std::vector<std::int32_t> order;
  for (std::int32_t chunk = 0; chunk < chunks; ++chunk) {
    const std::int32_t begin = chunk * chunk_discs, end = std::min(discs, begin + chunk_discs);
    order.resize(at(end - begin));
    std::iota(order.begin(), order.end(), begin);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int32_t a, std::int32_t b) { return length[at(a)] > length[at(b)]; });
    for (std::size_t k = 0; k < order.size(); k += at(lanes_)) {
      const auto slice = static_cast<std::int32_t>(slices());
      for (int lane = 0; lane < lanes_; ++lane) {
        const bool real = k + at(lane) < order.size();
        disc_.push_back(real ? order[k + at(lane)] : -1);
        if (!real) continue;
        slice_of_[at(disc_.back())] = slice;
        lane_of_[at(disc_.back())] = lane;
      }
      first_.push_back(first_.back() + length[at(order[k])]);  // the longest row comes first
    }
    chunk_first_.push_back(static_cast<std::int32_t>(slices()));
  }
}

}  // namespace perfora::solver
