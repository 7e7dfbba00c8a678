// What is here: statistics of the strength fields against closed forms. What is not: the strengths of bonds
// (test_network.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "solver/noise.h"

namespace perfora::solver {
namespace {

// Perlin: periodic, bounded by 1, mean 0. Its variance is that of four independent gradients, faded and averaged over a
// lattice cell: 4 A B (E[gx^2] + E[gy^2]) with A = int w^2 = 181/462 and B = int t^2 w^2 = 535/18018 for w = 1 - 10 t^3
// + 15 t^4 - 6 t^5, and 10/16 and 12/16 over the sixteen entries: 0.25294. A sample of 600 lattices of 10 x 10 nodes
// spreads by 0.3 %; linear fading has 2.2 % less, the cubic one of 1985 1.8 % less, twelve equal edges 1.5 % less.
TEST(Noise, PerlinStatistics) {
  double sum = 0.0, squares = 0.0, largest = 0.0;
  std::int64_t count = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const PerlinField field(0.05, 0.05, 5.04e-3, seed);
    EXPECT_EQ(field.nodes_x(), 10);
    for (int a = 0; a < 97; ++a)
      for (int b = 0; b < 97; ++b) {
        const double x = 0.05 * a / 97.0, y = 0.05 * b / 97.0, p = field.value(x, y);
        sum += p;
        squares += p * p;
        largest = std::max(largest, std::fabs(p));
        ++count;
        if (a % 16 == 0 && b % 16 == 0) {
          EXPECT_NEAR(field.value(x + 0.05, y), p, 1e-9);
          EXPECT_NEAR(field.value(x, y - 0.05), p, 1e-9);
        }
      }
  }
  EXPECT_LE(largest, 1.0);
  EXPECT_NEAR(sum / static_cast<double>(count), 0.0, 0.01);
  const double closed = std::sqrt(4.0 * (181.0 / 462.0) * (535.0 / 18018.0) * (10.0 + 12.0) / 16.0);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), closed, 0.01 * closed);
  EXPECT_NEAR(perlin_deviation(), closed, 1e-10) << "Simpson's rule of a polynomial of degree 12";
  NoiseOptions wanted;
  wanted.deviation = 0.3;
  EXPECT_NEAR(perlin_deviation() * perlin_amplitude(wanted) / 2.0, 0.3, 1e-12);
  // docs/user/theory.md: the default Delta = 1.8 gives a spread of 0.23.
  EXPECT_NEAR(0.9 * perlin_deviation(), 0.23, 0.005);
}

// Both mappings: 1 at p = 0, slope Delta/2 there; the exponential one has the logarithm Delta p/2 everywhere.
TEST(Noise, Mappings) {
  for (const double delta : {0.5, 1.8, 6.0}) {
    EXPECT_EQ(perlin_factor(0.0, delta, NoiseMapping::exponential), 1.0);
    EXPECT_EQ(perlin_factor(0.0, delta, NoiseMapping::linear), 1.0);
    constexpr double h = 1e-6;
    for (const auto mapping : {NoiseMapping::linear, NoiseMapping::exponential})
      EXPECT_NEAR((perlin_factor(h, delta, mapping) - perlin_factor(-h, delta, mapping)) / (2.0 * h), 0.5 * delta,
                  1e-8);
    for (const double p : {-1.0, -0.4, 0.7})
      EXPECT_NEAR(std::log(perlin_factor(p, delta, NoiseMapping::exponential)), 0.5 * delta * p, 1e-12);
  }
}

// Weibull factor: mean 1 and variance Gamma(1+2/m)/Gamma(1+1/m)^2 - 1.
TEST(Noise, WeibullMoments) {
  const double m = 4.0;
  double sum = 0.0, squares = 0.0;
  const int count = 200000;
  for (int k = 0; k < count; ++k) {
    const double f = weibull_factor(7, k, m);
    sum += f;
    squares += f * f;
  }
  const double mean = sum / count, variance = squares / count - mean * mean;
  const double expected = std::tgamma(1.0 + 2.0 / m) / std::pow(std::tgamma(1.0 + 1.0 / m), 2) - 1.0;
  EXPECT_NEAR(mean, 1.0, 4.0 * std::sqrt(expected / count));
  EXPECT_NEAR(variance, expected, 0.02 * expected);
}

}  // namespace
}  // namespace perfora::solver
