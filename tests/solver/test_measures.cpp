// What is here: Measures of a curve against curves whose integrals are known in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/measures.h"
#include "solver/noise.h"
#include "tests/solver/sample_packings.h"

namespace perfora::solver {
namespace {

/// A history sampled from stress(strain); work is its exact integral times the area when given.
template <class Stress, class Work>
History sampled(double until, int rows, const Stress& stress, const Work& work) {
  History h;
  for (int k = 0; k <= rows; ++k) {
    const double e = until * k / rows;
    for (const History::Column& column : History::columns()) (h.*column.values).push_back(0.0);
    h.strain_yy.back() = e;
    h.stress_yy.back() = stress(e);
    h.external_work.back() = work(e);
  }
  return h;
}

// Constant stress: plateau = the constant, undulation 0, minimum the constant, energy = s x end of the window, no
// densification.
TEST(Measures, ConstantStress) {
  const History h = sampled(
      0.6, 1200, [](double) { return 5e4; }, [](double e) { return 5e4 * e * 0.01; });
  Summary s;
  s.first_peak_stress = s.first_peak_strain = std::nan("");
  measure_curve(h, 0.2, 0.4, 0.01, s);
  EXPECT_NEAR(s.plateau_stress, 5e4, 1e-6);
  EXPECT_NEAR(s.undulation, 0.0, 1e-12);
  EXPECT_NEAR(s.minimum_stress_in_window, 5e4, 1e-6);
  EXPECT_NEAR(s.energy_absorbed, 2e4, 1e-6);
  EXPECT_TRUE(std::isnan(s.densification_strain));
  EXPECT_TRUE(std::isnan(s.only_rising_strain));
}

// Linear stress s = a e: mean over [0.2, 0.4] = 0.3 a; |s - mean| integrates to a (0.1)^2; undulation = 0.01 a/(0.06 a)
// = 1/6; 1.3 x 0.3 a = 0.39 a is crossed at 0.39; row spacing 0.0005 puts 0.3 on a row, so linear interpolation is
// exact.
TEST(Measures, LinearStress) {
  const History h = sampled(
      0.6, 1200, [](double e) { return 1e5 * e; }, [](double e) { return 0.5e5 * e * e * 2.0; });
  Summary s;
  s.first_peak_stress = s.first_peak_strain = std::nan("");
  measure_curve(h, 0.2, 0.4, 2.0, s);
  EXPECT_NEAR(s.plateau_stress, 3e4, 1e-6);
  EXPECT_NEAR(s.undulation, 1.0 / 6.0, 1e-9);
  EXPECT_NEAR(s.densification_strain, 0.39, 1e-9);
  EXPECT_NEAR(s.energy_absorbed, 0.5e5 * 0.16, 1e-6);
  EXPECT_NEAR(s.efficiency_strain, 0.6, 1e-12);  // efficiency e/2 grows to the end
}

// Window not reached: null, not a number from less.
TEST(Measures, ShortRunHasNoPlateau) {
  const History h = sampled(
      0.3, 600, [](double) { return 1.0; }, [](double) { return 0.0; });
  Summary s;
  s.first_peak_stress = s.first_peak_strain = std::nan("");
  measure_curve(h, 0.2, 0.4, 1.0, s);
  EXPECT_TRUE(std::isnan(s.plateau_stress));
  EXPECT_TRUE(std::isnan(s.energy_absorbed));
}

// A triangle up to 1 at 0.01, down to 0.1 at 0.02, up again from 0.45: drop ratio 0.1; only rising after the last row
// below 0.9 of the running maximum.
TEST(Measures, PeakDropAndRise) {
  const auto stress = [](double e) {
    if (e < 0.01) return e / 0.01;
    if (e < 0.02) return 1.0 - 0.9 * (e - 0.01) / 0.01;
    if (e < 0.45) return 0.1;
    return 0.1 + (e - 0.45) / 0.15 * 3.0;
  };
  const History h = sampled(0.6, 1200, stress, [](double) { return 0.0; });
  Summary s;
  s.first_peak_stress = 1.0;
  s.first_peak_strain = 0.01;
  measure_curve(h, 0.2, 0.4, 1.0, s);
  EXPECT_NEAR(s.stress_drop_ratio, 0.1, 1e-9);
  // The 0.5 %-smoothed peak of slopes 100 and -90 is m = 1 - (0.25 x 0.5 + 0.225 x 0.5)/2 = 0.88125; 0.9 m is passed on
  // the rise at 0.45 + (0.9 m - 0.1)/20. Rows of 0.0005 and the discrete smoothing leave two rows of slack.
  EXPECT_NEAR(s.only_rising_strain, 0.45 + (0.9 * 0.88125 - 0.1) * 0.05, 0.001);
}

TEST(Measures, ResidualAndModulus) {
  History h = sampled(
      0.01, 20, [](double e) { return 7e7 * e; }, [](double e) { return e; });
  for (std::size_t k = 0; k < h.rows(); ++k)
    h.damage[k] = 0.75 * h.external_work[k], h.cundall[k] = 0.24 * h.external_work[k];
  EXPECT_NEAR(energy_residual(h, 0.002), 0.01, 1e-12);
  EXPECT_NEAR(loading_modulus(h, 7e5, 0.01), 7e7, 1.0);
}

// Perlin: periodic, bounded by 1, zero at the lattice nodes, mean 0 and the standard deviation of the closed form
// (noise.cpp); the sample of 60 lattices of 10 x 10 nodes leaves about 1 % of spread.
TEST(Noise, PerlinStatistics) {
  double sum = 0.0, squares = 0.0, largest = 0.0;
  std::int64_t count = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
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
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), perlin_deviation(), 0.02 * perlin_deviation());
  EXPECT_NEAR(perlin_deviation() * perlin_amplitude_for(0.3) / 2.0, 0.3, 1e-12);
  // docs/theory.md: the default Delta = 1.8 gives a spread of about 0.24.
  EXPECT_NEAR(0.9 * perlin_deviation(), 0.24, 0.02);
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
