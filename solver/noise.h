// What is here: the strength factor of a bond as a function of place (Perlin) or of its identity (Weibull). What is
// not: bonds.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "solver/options.h"

namespace perfora::solver {

/// Perlin's improved noise (K. Perlin, Improving Noise, SIGGRAPH 2002): twelve edge gradients, quintic fade, slice z =
/// 0, periodic lattice.
class PerlinField {
 public:
  /// Lattice of round(width/length) x round(height/length) nodes (at least one), permutation and phase from `seed`.
  PerlinField(double width, double height, double length, std::uint64_t seed);
  /// Noise p in [-1, 1] at (x, y), metres; periodic in the cell.
  double value(double x, double y) const;
  int nodes_x() const { return nodes_x_; }
  int nodes_y() const { return nodes_y_; }

 private:
  double width_, height_;
  int nodes_x_, nodes_y_;
  double phase_x_, phase_y_;
  std::array<std::uint8_t, 512> permutation_;
};

/// Standard deviation of p over the plane, from the closed form of the noise at random points (see noise.cpp).
double perlin_deviation();
/// Delta of the options: `amplitude`, or what gives the wanted deviation of the factor (of its logarithm).
double perlin_amplitude(const NoiseOptions& noise);
/// Where the linear mapping could give a factor of zero.
double largest_perlin_amplitude();
double largest_perlin_deviation();

/// 1 + Delta (noise - 1/2) or exp(Delta (noise - 1/2)), noise = (p + 1)/2 (docs/user/theory.md, "Heterogeneity").
inline double perlin_factor(double p, double amplitude, NoiseMapping mapping) {
  const double deviation = amplitude * ((p + 1.0) / 2.0 - 0.5);
  return mapping == NoiseMapping::linear ? 1.0 + deviation : std::exp(deviation);
}

/// Weibull factor of mean 1 for one bond: a counter-based draw of (seed, bond).
double weibull_factor(std::uint64_t seed, std::int64_t bond, double modulus);

}  // namespace perfora::solver
