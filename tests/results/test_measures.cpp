// What is here: measures of a curve against curves whose integrals are known in closed form. What is not: the table of
// measures (test_measure_table.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "results/measures.h"

namespace perfora::results {
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

// 1000 bonds a unit of strain break up to 0.3 and none behind: 100 in [0.2, 0.4]; none is counted in a window that the
// run does not reach.
TEST(Measures, BondsBrokenInTheWindow) {
  History h = sampled(
      0.6, 1200, [](double) { return 1.0; }, [](double) { return 0.0; });
  for (std::size_t k = 0; k < h.rows(); ++k) h.broken_bonds[k] = 1000.0 * std::min(h.strain_yy[k], 0.3);
  Summary s;
  measure_curve(h, 0.2, 0.4, 1.0, s);
  EXPECT_NEAR(s.broken_in_window, 100.0, 1e-9);
  measure_curve(h, 0.4, 0.7, 1.0, s);
  EXPECT_TRUE(std::isnan(s.broken_in_window));
}

// 50 kPa of which damage takes a tenth, friction four tenths, dashpots none and Cundall damping half, on 2 m2; the path
// runs at 2 1/s up to 0.3 and at 1 1/s behind it, so [0.2, 0.4] takes 0.15 s; 10 kPa a 1/s of impact stress make
// 10 kPa x 0.2/0.15.
TEST(Measures, WhereThePlateauGoesAndItsImpactStress) {
  History h = sampled(
      0.6, 1200, [](double) { return 5e4; }, [](double e) { return 5e4 * e * 2.0; });
  for (std::size_t k = 0; k < h.rows(); ++k) {
    const double e = h.strain_yy[k], work = 5e4 * e * 2.0;
    h.damage[k] = 0.1 * work;
    h.friction[k] = 0.4 * work;
    h.cundall[k] = 0.5 * work;
    h.time[k] = e < 0.3 ? 0.5 * e : 0.15 + (e - 0.3);
  }
  Summary s;
  s.impact_stress_per_rate = 1e4;
  measure_curve(h, 0.2, 0.4, 2.0, s);
  EXPECT_NEAR(s.damage_stress, 5e3, 1e-6);
  EXPECT_NEAR(s.friction_stress, 2e4, 1e-6);
  EXPECT_NEAR(s.viscous_stress, 0.0, 1e-6);
  EXPECT_NEAR(s.cundall_stress, 2.5e4, 1e-6);
  EXPECT_NEAR(s.impact_stress, 1e4 * 0.2 / 0.15, 1e-6);
  EXPECT_NEAR(s.impact_ratio, 0.2 / 0.15 / 5.0, 1e-9);
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

/// Piecewise linear through corners.
auto through(std::vector<std::pair<double, double>> corners) {
  return [corners](double e) {
    for (std::size_t k = 1; k < corners.size(); ++k)
      if (e <= corners[k].first) {
        const auto [x0, y0] = corners[k - 1];
        const auto [x1, y1] = corners[k];
        return y0 + (e - x0) / (x1 - x0) * (y1 - y0);
      }
    return corners.back().second;
  };
}

Summary measured(const std::vector<std::pair<double, double>>& corners, double peak_strain, double peak_stress) {
  const History h = sampled(0.6, 2400, through(corners), [](double) { return 0.0; });
  Summary s;
  s.first_peak_stress = peak_stress;
  s.first_peak_strain = peak_strain;
  measure_curve(h, 0.2, 0.4, 1.0, s);
  return s;
}

// Up to 1 at 0.01, down to 0.1 at 0.02, level to 0.45, then up by 20 a unit strain: drop ratio 0.1; half the peak again
// at 0.45 + 0.4/20 = 0.47 (a straight line is its own running mean); the last stress that a later one falls a tenth
// short of is on the way down, where the running mean of slope -90 passes 0.1/0.9, so at 0.02 - 0.0111/90; within half
// the smoothing width (0.0025) of the corner.
TEST(Measures, PeakDropAndRise) {
  const Summary s = measured({{0.0, 0.0}, {0.01, 1.0}, {0.02, 0.1}, {0.45, 0.1}, {0.6, 3.1}}, 0.01, 1.0);
  EXPECT_NEAR(s.stress_drop_ratio, 0.1, 1e-9);
  EXPECT_NEAR(s.recovery_strain, 0.47, 0.0005);
  EXPECT_NEAR(s.only_rising_strain, 0.02, 0.0026);
  EXPECT_EQ(s.intermediate_peaks, 0.0);
}

// Triangles of height h and slopes +- a over a level of 0.1: the running mean of width w lowers a tip by a w/4. Heights
// 0.4 (at 0.1) and 0.2 (at 0.3) with slopes of 10 stay above 5 % of the first peak (tips at 0.4875, 0.2875), one of
// 0.05 at 0.2 (tip 0.0375 above the level) does not. The stress falls for the last time behind 0.3.
TEST(Measures, PeaksBehindTheFirst) {
  const Summary s = measured({{0.0, 0.0},
                              {0.01, 1.0},
                              {0.02, 0.1},
                              {0.06, 0.1},
                              {0.1, 0.5},
                              {0.14, 0.1},
                              {0.195, 0.1},
                              {0.2, 0.15},
                              {0.205, 0.1},
                              {0.28, 0.1},
                              {0.3, 0.3},
                              {0.32, 0.1},
                              {0.5, 0.1},
                              {0.6, 2.1}},
                             0.01, 1.0);
  ASSERT_EQ(s.peaks.size(), 2U);
  EXPECT_EQ(s.intermediate_peaks, 2.0);
  EXPECT_NEAR(s.peaks[0].strain, 0.1, 0.0003);
  EXPECT_NEAR(s.peaks[0].stress, 0.5 - 10.0 * 0.005 / 4.0, 0.0015);
  EXPECT_NEAR(s.peaks[1].strain, 0.3, 0.0003);
  EXPECT_NEAR(s.peaks[1].stress, 0.3 - 10.0 * 0.005 / 4.0, 0.0015);
  EXPECT_NEAR(s.only_rising_strain, 0.32, 0.0026);
  EXPECT_NEAR(s.recovery_strain, 0.5 + 0.4 / 20.0, 0.0005);
}

// A peak on the flank of a higher one counts by the valley between them, not by its own height.
TEST(Measures, ProminenceIsCountedFromTheValley) {
  const Summary s = measured(
      {{0.0, 0.0}, {0.01, 1.0}, {0.02, 0.1}, {0.1, 0.6}, {0.12, 0.57}, {0.2, 0.9}, {0.3, 0.1}, {0.5, 0.1}, {0.6, 2.1}},
      0.01, 1.0);
  ASSERT_EQ(s.peaks.size(), 1U);
  EXPECT_NEAR(s.peaks[0].strain, 0.2, 0.0026);
  EXPECT_NEAR(s.recovery_strain, 0.02 + 0.4 / 6.25, 0.0005);
}

// A stress that only falls is never recovered and never only rises.
TEST(Measures, NoRecovery) {
  const Summary s = measured({{0.0, 0.0}, {0.01, 1.0}, {0.02, 0.3}, {0.6, 0.0}}, 0.01, 1.0);
  EXPECT_TRUE(std::isnan(s.recovery_strain));
  EXPECT_TRUE(std::isnan(s.only_rising_strain));
  EXPECT_EQ(s.intermediate_peaks, 0.0);
}

TEST(Measures, ResidualAndModulus) {
  History h = sampled(
      0.01, 20, [](double e) { return 7e7 * e; }, [](double e) { return e; });
  for (std::size_t k = 0; k < h.rows(); ++k)
    h.damage[k] = 0.75 * h.external_work[k], h.cundall[k] = 0.24 * h.external_work[k];
  EXPECT_NEAR(energy_residual(h, 0.002), 0.01, 1e-12);
  EXPECT_NEAR(loading_modulus(h, 7e5, 0.01), 7e7, 1.0);
}

}  // namespace
}  // namespace perfora::results
