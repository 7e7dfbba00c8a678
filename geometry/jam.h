// What is here: the jammed state of given discs: compressed beyond it, then decompressed step by step towards zero
// pressure. What is not: the minimiser itself (overlap_minimiser.h), sizes and start (make_packing.cpp).
#pragma once

#include <cstdint>
#include <functional>

#include "geometry/overlap_minimiser.h"

namespace perfora::geometry {

struct JamResult {
  double scale = 0.0;  ///< radii scale * radius are jammed
  double max_overlap_ratio = 0.0;
  std::int64_t iterations = 0;
  bool reached = false;  ///< overlap limit and force balance met
};

/// Largest overlap over the smaller diameter of its pair that a finished packing may have.
inline constexpr double overlap_limit = 1e-3;

/// Leaves `minimiser` at the jammed positions. Where the radii will be `shrunk` * radius in the end (0: they stay) and
/// that opens gaps, it stops as soon as what still overlaps is small beside the gaps; the scale is extrapolated then.
/// `progress` (share done in [0, 1]) may be empty.
JamResult jam(OverlapMinimiser& minimiser, double shrunk, const std::function<void(double)>& progress);

}  // namespace perfora::geometry
