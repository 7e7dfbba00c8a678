// What is here: the size law of the discs, number density p(d) ~ d^-q on [d_max/ratio, d_max] (docs/user/theory.md,
// "Block, holes, packing"): exponent, moments, samples. What is not: the places of the discs.
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

/// Exponent q of the number density p(d) ~ d^-q on [d_max/ratio, d_max] whose mean is mean_diameter
/// (docs/user/theory.md, "Block, holes, packing"). Throws io::InputError when the mean cannot be reached.
double size_law_exponent(double mean_diameter, double maximum_diameter, double size_ratio);

}  // namespace perfora::geometry
