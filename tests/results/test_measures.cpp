// What is here: measures of a curve against curves whose integrals are known in closed form. What is not: the table of
// measures (test_measure_table.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "results/found_plateau.h"
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

/// Measured over a window, on a cell of this area.
MeasuringFrame window(double start, double end, double area = 1.0) {
  MeasuringFrame frame;
  frame.options.plateau_start = start;
  frame.options.plateau_end = end;
  frame.reference_area = area;
  return frame;
}

// Constant stress: plateau = the constant, undulation 0, minimum the constant, energy = s x end of the window, no
// densification.
TEST(Measures, ConstantStress) {
  const History h = sampled(
      0.6, 1200, [](double) { return 5e4; }, [](double e) { return 5e4 * e * 0.01; });
  Summary s;
  s.first_peak_stress = s.first_peak_strain = std::nan("");
  measure_curve(h, window(0.2, 0.4, 0.01), s);
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
  measure_curve(h, window(0.2, 0.4, 2.0), s);
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
  measure_curve(h, window(0.2, 0.4, 1.0), s);
  EXPECT_NEAR(s.broken_in_window, 100.0, 1e-9);
  measure_curve(h, window(0.4, 0.7, 1.0), s);
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
  measure_curve(h, window(0.2, 0.4, 2.0), s);
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
  measure_curve(h, window(0.2, 0.4, 1.0), s);
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
  measure_curve(h, window(0.2, 0.4, 1.0), s);
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

/// A curve through corners to 60 % strain, measured by a frame; the first peak is given.
Summary measured_by(const MeasuringFrame& frame, const std::vector<std::pair<double, double>>& corners,
                    double peak_strain, double peak_stress, double until = 0.6) {
  const History h = sampled(until, 2400, through(corners), [](double) { return 0.0; });
  Summary s;
  s.first_peak_stress = peak_stress;
  s.first_peak_strain = peak_strain;
  measure_curve(h, frame, s);
  return s;
}

MeasuringFrame on_found_plateau() {
  MeasuringFrame frame = window(0.2, 0.4);
  frame.options.plateau = PlateauPlace::found;
  return frame;
}

// A straight ramp from 0.6 to 1.4 of its mean: ULC = 0.2 (|s - mean| is a triangle of height 0.4 on either side, mean
// 0.2), smallest and largest 0.6 and 1.4 up to half the smoothing width at a slope of 4 a unit strain (0.02), slope
// 1.4/0.6; the cap is the end of the ramp; no peak, so no crush force efficiency.
TEST(Measures, ARampThatFlatnessAloneLetsThrough) {
  const Summary s =
      measured_by(window(0.2, 0.4), {{0.0, 0.6 - 0.8}, {0.2, 0.6}, {0.4, 1.4}, {0.6, 2.2}}, std::nan(""), std::nan(""));
  EXPECT_NEAR(s.plateau_stress, 1.0, 1e-9);
  EXPECT_NEAR(s.undulation, 0.2, 1e-9);
  EXPECT_NEAR(s.smallest_over_mean, 0.6, 1e-9) << "a running mean leaves a straight line as it is";
  EXPECT_NEAR(s.largest_over_mean, 1.4, 1e-9);
  EXPECT_NEAR(s.slope, 1.4 / 0.6, 1e-9);
  EXPECT_NEAR(s.cap_ratio, 1.4, 1e-9);
  EXPECT_TRUE(std::isnan(s.crush_force_efficiency));
}

// The fitted line of a parabola s = x^2 on [0, 1] is x - 1/6 (orthogonal projection); on [0.2, 0.4] with
// s = 1 + ((e - 0.2)/0.2)^2 it runs from 1 - 1/6 to 2 - 1/6.
TEST(Measures, SlopeOfAParabolaIsThatOfItsProjection) {
  const History h = sampled(
      0.6, 4800, [](double e) { return 1.0 + (e - 0.2) / 0.2 * (e - 0.2) / 0.2; }, [](double) { return 0.0; });
  Summary s;
  measure_curve(h, window(0.2, 0.4), s);
  EXPECT_NEAR(s.slope, (2.0 - 1.0 / 6.0) / (1.0 - 1.0 / 6.0), 1e-5) << "chords of a parabola lie h^2/8 above it";
}

// Saw-tooth of period 2 % between 0.5 and 1.5 about a mean of 1: ULC 0.25 (a triangle wave deviates by half its
// amplitude in the mean); the running mean over half a period lifts the lowest and lowers the highest point to half the
// amplitude: 0.75 and 1.25. A whole number of periods has no slope.
TEST(Measures, ASawToothIsSmoothedBeforeItsExtremesAreTaken) {
  std::vector<std::pair<double, double>> corners{{0.0, 0.5}};
  for (int k = 1; k <= 60; ++k) corners.push_back({0.01 * k, k % 2 == 1 ? 1.5 : 0.5});
  const Summary s = measured_by(window(0.2, 0.4), corners, std::nan(""), std::nan(""));
  EXPECT_NEAR(s.plateau_stress, 1.0, 1e-9);
  EXPECT_NEAR(s.undulation, 0.25, 1e-9);
  // The mean over 40 or 41 samples, as the ends are rounded, is at most 0.25/40 nearer to the middle than the integral.
  EXPECT_NEAR(s.smallest_over_mean, 0.75, 0.25 / 40.0);
  EXPECT_NEAR(s.largest_over_mean, 1.25, 0.25 / 40.0);
  EXPECT_NEAR(s.slope, 1.0, 1e-9);
  EXPECT_NEAR(s.cap_ratio, 1.5, 1e-9);
}

// Peak 3 at 1 %, trough 0.5 from 2 to 8 %, plateau 1 from 10 to 40 %, then up by 20 a unit strain.
const std::vector<std::pair<double, double>> crushed = {{0.0, 0.0},  {0.01, 3.0}, {0.02, 0.5}, {0.08, 0.5},
                                                        {0.10, 1.0}, {0.40, 1.0}, {0.60, 5.0}};

TEST(Measures, PeakTroughAndCapOfACrushedBlock) {
  const Summary s = measured_by(window(0.2, 0.4), crushed, 0.01, 3.0);
  EXPECT_NEAR(s.plateau_stress, 1.0, 1e-9);
  EXPECT_NEAR(s.cap_ratio, 3.0, 1e-9);
  EXPECT_NEAR(s.crush_force_efficiency, 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(s.trough_stress, 0.5, 1e-9);
  EXPECT_NEAR(s.densification_strain, 0.40 + 0.3 / 20.0, 1e-6);
}

// The stress passes 4 for good at 0.4 + 3/20; it is last below 2 at 0.4 + 1/20, whatever the first peak did; the
// largest up to 30 % is the peak, up to 58 % the branch: 1 + 20 x 0.18.
TEST(Measures, StrokeAtACapAndLargestStressUpToAStrain) {
  MeasuringFrame frame = window(0.2, 0.4);
  frame.cap = 2.0;
  frame.cap_strain = 0.3;
  const Summary s = measured_by(frame, crushed, 0.01, 3.0);
  EXPECT_NEAR(s.stroke_at_cap, 0.45, 1e-9);
  EXPECT_NEAR(s.stress_until, 3.0, 1e-9);
  frame.cap = 10.0;
  frame.cap_strain = 0.58;
  const Summary high = measured_by(frame, crushed, 0.01, 3.0);
  EXPECT_NEAR(high.stroke_at_cap, 0.6, 1e-9) << "below the cap to the end of the run";
  EXPECT_NEAR(high.stress_until, 4.6, 1e-9);
}

// A bump that passes 1.3 times the plateau is not the end of it: the stress falls again. Without a rise at the end
// there is none.
TEST(Measures, AnEarlyBumpIsNoDensification) {
  const std::vector<std::pair<double, double>> bump = {{0.0, 0.0},  {0.01, 1.0}, {0.10, 1.0}, {0.11, 1.8},
                                                       {0.12, 1.0}, {0.50, 1.0}, {0.60, 3.0}};
  EXPECT_NEAR(measured_by(window(0.2, 0.4), bump, 0.01, 1.0).densification_strain, 0.5 + 0.3 / 20.0, 1e-6);
  EXPECT_TRUE(std::isnan(measured_by(window(0.2, 0.4), bump, 0.01, 1.0, 0.45).densification_strain));
}

// A stress that is 25 % above the target throughout is ln 1.25 away; one that is half of it over half of the window and
// twice of it over the other half ln 2; nothing at all counts as the floor.
TEST(Measures, DistanceToATargetIsInLogarithms) {
  MeasuringFrame frame = window(0.2, 0.4);
  frame.target_stress = 1.0;
  EXPECT_NEAR(measured_by(frame, {{0.0, 1.25}, {0.6, 1.25}}, 0.0, 1.25).target_distance, std::log(1.25), 1e-9);
  EXPECT_NEAR(measured_by(frame, {{0.0, 0.0}, {0.6, 0.0}}, 0.0, 1.25).target_distance, -std::log(0.05), 1e-9);
  const Summary halves = measured_by(frame, {{0.0, 0.5}, {0.2999, 0.5}, {0.3001, 2.0}, {0.6, 2.0}}, 0.0, 0.5);
  // The running mean turns the jump into a ramp of 1 % strain, 5 % of the window, on which the distance is smaller.
  EXPECT_NEAR(halves.target_distance, std::log(2.0), 0.05 * std::log(2.0));
}

// exp(5 e) against a wished curve exp(5 e)/1.5: ln 1.5 throughout. The wish is linear between its points 0.0025 apart,
// so at most (5 x 0.0025)^2/8 = 2e-5 above the exponential; the running mean over 1 % lifts it by (5 x 0.01)^2/24 =
// 1e-4.
TEST(Measures, DistanceToAWishedCurve) {
  MeasuringFrame frame = window(0.2, 0.4);
  for (int k = 0; k <= 240; ++k) {
    frame.target_curve.push_back(0.0025 * k);
    frame.target_curve.push_back(std::exp(5.0 * 0.0025 * k) / 1.5);
  }
  const History h = sampled(
      0.6, 2400, [](double e) { return std::exp(5.0 * e); }, [](double) { return 0.0; });
  Summary s;
  measure_curve(h, frame, s);
  EXPECT_NEAR(s.target_distance, std::log(1.5), 2e-4);
  // Mean of the exponential over the window and where it passes 1.3 times that for good.
  const double mean = (std::exp(2.0) - std::exp(1.0)) / (5.0 * 0.2);
  EXPECT_NEAR(s.plateau_stress, mean, 1e-5 * mean);
  EXPECT_NEAR(s.densification_strain, std::log(1.3 * mean) / 5.0, 1e-5);
}

// The plateau of `crushed`: samples whose running mean over 1 % stays within 25 % of the mean. At its start the ramp
// from 0.5 to 1 is within that from some 0.75 on. From the foot some 0.35 are absorbed up to 40 % strain; from there
// on the largest stress grows by 20 a unit strain, the energy by 1 to 5, so efficiency falls: densification sets in
// where the running mean begins to rise, half the smoothing before 40 % at the earliest, and its smoothing lifts it
// slowly.
TEST(Measures, FindsThePlateauBeforeDensification) {
  const Summary s = measured_by(on_found_plateau(), crushed, 0.01, 3.0);
  EXPECT_NEAR(s.densification_onset, 0.40, 0.005);
  EXPECT_GT(s.found_plateau_start, 0.08);
  EXPECT_LE(s.found_plateau_start, 0.10);
  EXPECT_NEAR(s.found_plateau_end, s.densification_onset, 3e-4) << "the next sample of a fortieth of the smoothing";
  EXPECT_NEAR(s.found_plateau_length, s.found_plateau_end - s.found_plateau_start, 1e-12);
  EXPECT_NEAR(s.found_plateau_stress, 1.0, 0.02);
  EXPECT_EQ(s.plateau_start, s.found_plateau_start) << "all measures of the plateau are taken there";
  EXPECT_EQ(s.plateau_stress, s.found_plateau_stress);
  EXPECT_NEAR(s.cap_ratio, 3.0 / s.found_plateau_stress, 1e-9);
}

// A ramp that doubles within every 10 points has no plateau: within +-25 % of a mean it stays at most over a ratio of
// 1.25/0.75, in a straight line from 1 at 10 points a doubling less than 10 points. What follows from one is null.
TEST(Measures, ARampHasNoFoundPlateau) {
  const History h = sampled(
      0.6, 2400, [](double e) { return std::exp2(e / 0.1); }, [](double) { return 0.0; });
  Summary s;
  s.first_peak_stress = s.first_peak_strain = std::nan("");
  measure_curve(h, on_found_plateau(), s);
  EXPECT_TRUE(std::isnan(s.found_plateau_stress));
  EXPECT_EQ(s.found_plateau_length, 0.0);
  EXPECT_TRUE(std::isnan(s.plateau_stress));
  EXPECT_TRUE(std::isnan(s.cap_ratio));
}

// sigma = 1 + e from 0 to 0.4: the slope may be 1.25 at most, so the longest plateau goes from 1.4/1.25 = 1.12 to 1.4.
// The band alone would take all of it: the mean of 1.2 is less than 25 % from 1 and from 1.4.
TEST(Measures, TheSlopeEndsAFoundPlateauWithinItsBand) {
  std::vector<double> strain, stress;
  for (int k = 0; k <= 4000; ++k) {
    strain.push_back(1e-4 * k);
    stress.push_back(1.0 + strain.back());
  }
  MeasureOptions options;
  const auto found = found_plateau(strain, stress, 0.0, 0.4, options);
  ASSERT_TRUE(found);
  const double sample = options.smoothing / 40.0;  // samples that lie closer are left out
  EXPECT_NEAR(found->start, 0.12, 2.0 * sample);
  EXPECT_NEAR(found->end, 0.4, 2.0 * sample);
}

// The curve of a lattice: peak 1 MPa, 0.1 MPa to 40 % strain, then a dense branch that is flat enough from 44 to 55 %
// at some 3.7 MPa before it rises on. Behind the peak 0.04 MJ/m3 are absorbed at 40 %, over 0.1 MPa: an efficiency of
// 0.4; with the branch it is (0.04 + 0.5)/4 = 0.14 at most, so the branch lies behind the onset. Over the largest
// stress from the start, the peak, efficiency would go on growing there.
TEST(Measures, TheDenseBranchIsNotFound) {
  const Summary s = measured_by(
      on_found_plateau(), {{0.0, 0.0}, {0.01, 1.0}, {0.02, 0.1}, {0.40, 0.1}, {0.44, 3.5}, {0.55, 4.0}, {0.6, 12.0}},
      0.01, 1.0);
  EXPECT_NEAR(s.densification_onset, 0.40, 0.006);
  EXPECT_NEAR(s.found_plateau_stress, 0.1, 0.002);
  EXPECT_LE(s.found_plateau_end, s.densification_onset);
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
