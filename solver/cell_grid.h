// What is here: a periodic cell grid over reduced coordinates that visits all pairs of near points. What is not: skins,
// histories (neighbour_list.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace perfora::solver {

/// Bins points of the unit square by counting sort; points of one bin stay in index order. Memory is kept between
/// builds.
class CellGrid {
 public:
  /// Bins of at least `reach_x` x `reach_y` (reduced units), so that all neighbours within reach lie in the 3 x 3 bins
  /// around. s in [0, 1).
  template <class Coordinates>
  void build(std::int32_t count, double reach_x, double reach_y, const Coordinates& coordinates) {
    const auto bins = [&](double reach) {
      return std::max(1, static_cast<int>(std::min(std::floor(1.0 / reach),
                                                   std::ceil(std::sqrt(static_cast<double>(count) + 1.0)))));
    };
    nx_ = bins(reach_x);
    ny_ = bins(reach_y);
    start_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) + 1, 0);
    bin_.resize(static_cast<std::size_t>(count));
    member_.resize(static_cast<std::size_t>(count));
    for (std::int32_t k = 0; k < count; ++k) {
      const auto s = coordinates(k);
      const int bx = std::min(nx_ - 1, static_cast<int>(s.first * nx_)),
                by = std::min(ny_ - 1, static_cast<int>(s.second * ny_));
      bin_[static_cast<std::size_t>(k)] = by * nx_ + bx;
      ++start_[static_cast<std::size_t>(by * nx_ + bx) + 1];
    }
    for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
    cursor_.assign(start_.begin(), start_.end() - 1);
    for (std::int32_t k = 0; k < count; ++k)
      member_[static_cast<std::size_t>(cursor_[static_cast<std::size_t>(bin_[static_cast<std::size_t>(k)])]++)] = k;
  }

  /// Calls visit(j) once for every other point in the bins around point i (each bin once, even when the grid is one or
  /// two bins wide).
  template <class Visit>
  void around(std::int32_t i, const Visit& visit) const {
    const int bin = bin_[static_cast<std::size_t>(i)];
    const int bx = bin % nx_, by = bin / nx_;
    const int reach_x = nx_ >= 3 ? 3 : nx_, reach_y = ny_ >= 3 ? 3 : ny_;
    for (int oy = 0; oy < reach_y; ++oy) {
      const int cy = ny_ >= 3 ? (by + oy - 1 + ny_) % ny_ : oy;
      for (int ox = 0; ox < reach_x; ++ox) {
        const int cx = nx_ >= 3 ? (bx + ox - 1 + nx_) % nx_ : ox;
        const std::size_t b = static_cast<std::size_t>(cy * nx_ + cx);
        for (std::int32_t m = start_[b]; m < start_[b + 1]; ++m)
          if (member_[static_cast<std::size_t>(m)] != i) visit(member_[static_cast<std::size_t>(m)]);
      }
    }
  }

 private:
  int nx_ = 1, ny_ = 1;
  std::vector<std::int32_t> start_, cursor_, member_, bin_;
};

}  // namespace perfora::solver
