// What is here: moments, quantiles and stratified samples of the power law, and the exponent that gives a wanted mean.
// What is not: the places of the discs.
#include "geometry/size_law.h"

#include <cmath>

#include "geometry/random.h"
#include "io/error.h"

namespace perfora::geometry {

namespace {

/// Integral of t^(s-1) over [1/ratio, 1], with log_ratio = ln(ratio); stable where s is near 0.
double power_integral(double s, double log_ratio) {
  const double product = s * log_ratio;
  if (std::abs(product) < 1e-12) return log_ratio * (1.0 - 0.5 * product);
  return -std::expm1(-product) / s;
}

}  // namespace

double SizeLaw::mean_power(int n) const {
  if (size_ratio == 1.0) return 1.0;
  const double log_ratio = std::log(size_ratio);
  return power_integral(static_cast<double>(n) + 1.0 - exponent, log_ratio) / power_integral(1.0 - exponent, log_ratio);
}

double SizeLaw::quantile(double u) const {
  if (size_ratio == 1.0) return 1.0;
  const double log_ratio = std::log(size_ratio);
  const double s = 1.0 - exponent;
  const double product = s * log_ratio;
  if (std::abs(product) < 1e-12) return std::exp((u - 1.0) * log_ratio);
  return std::exp(std::log1p(u * std::expm1(product)) / s - log_ratio);
}

std::vector<double> sample_diameters(const SizeLaw& law, std::int64_t count, std::uint64_t seed) {
  std::vector<double> diameters(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < diameters.size(); ++k) {
    const double within = uniform_pair(seed, RandomStream::disc_size, k)[0];
    diameters[k] = law.quantile((static_cast<double>(k) + within) / static_cast<double>(count));
  }
  return diameters;
}

double size_law_exponent(double mean_diameter, double maximum_diameter, double size_ratio) {
  const io::Origin origin{"", 0, "packing.mean_diameter"};
  const double mean = mean_diameter / maximum_diameter;
  // Beyond |q| = 80 nearly all discs have one size: a distribution nobody means.
  constexpr double steepest = 80.0;
  if (size_ratio == 1.0) {
    if (std::abs(mean - 1.0) < 1e-9) return 0.0;
    throw io::InputError(origin, "with packing.size_ratio = 1 all discs have the maximum diameter",
                         "mean_diameter = maximum_diameter", "make both equal or raise size_ratio");
  }
  const auto mean_of = [&](double q) { return SizeLaw{q, size_ratio}.mean_power(1); };
  double low = -steepest, high = steepest;
  if (!(size_ratio > 1.0) || !(maximum_diameter > 0.0) || !(mean <= mean_of(low) && mean >= mean_of(high)))
    throw io::InputError(origin, "no power law between the smallest and the largest diameter has this mean",
                         "a mean between maximum_diameter/size_ratio and maximum_diameter",
                         "change mean_diameter, maximum_diameter or size_ratio");
  for (int step = 0; step < 200 && low < high; ++step) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (mean_of(middle) > mean ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace perfora::geometry
