// What is here: the size law of the discs, number density p(d) ~ d^-q on [d_max/ratio, d_max] (docs/user/theory.md,
// "Block, perforations, packing"): moments and samples. What is not: the search for q (size_law_exponent of
// make_packing.h), the places of the discs.
#pragma once

#include <cstdint>
#include <vector>

namespace perfora::geometry {

/// A power law of diameters, in units of the largest one.
struct SizeLaw {
  double exponent = 0.0;    ///< q
  double size_ratio = 1.0;  ///< d_max/d_min >= 1

  /// <d^n>/d_max^n over the number density.
  double mean_power(int n) const;
  /// Diameter over d_max below which the share u in [0, 1] of all discs lies.
  double quantile(double u) const;
};

/// `count` diameters in ascending order, in units of d_max: one from each of `count` strata of equal probability, so
/// that the mean of the sample is that of the law to about 1/count^(3/2).
std::vector<double> sample_diameters(const SizeLaw& law, std::int64_t count, std::uint64_t seed);

}  // namespace perfora::geometry
