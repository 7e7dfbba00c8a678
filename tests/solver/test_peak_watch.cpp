// What is here: when a run has passed its first peak, on made histories. What is not: the peak's own stress and strain
// (test_truth_of_a_run.cpp), the rate behind it (test_loading_rate.cpp).
#include "solver/peak_watch.h"

#include <gtest/gtest.h>

#include <vector>

namespace perfora::solver {
namespace {

constexpr double estimated = 0.01;

/// Number of the piece after which the first peak is behind, with a piece for each of `stress`; -1: never.
int piece_behind_peak(const std::vector<double>& stress) {
  PeakWatch watch;
  for (std::size_t k = 0; k < stress.size(); ++k) {
    EXPECT_TRUE(watch.ends_piece(stress[k], PeakWatch::piece, static_cast<double>(k + 1) * PeakWatch::piece));
    if (watch.passed(estimated)) return static_cast<int>(k);
  }
  return -1;
}

TEST(PeakWatch, APieceBelowFourFifthsOfTheLargestEndsTheSearch) {
  EXPECT_EQ(piece_behind_peak({1.0, 2.0, 3.0, 2.5, 2.41, 2.39}), 5);
  EXPECT_EQ(piece_behind_peak({1.0, 2.0, 3.0, 2.5, 4.0, 3.3, 3.1}), 6) << "of the largest so far, not of the first";
  EXPECT_EQ(piece_behind_peak({1.0, 2.0, 3.0, 4.0}), -1);
}

// Ten times the estimated strain of the peak, 0.1: a maximum behind that is a serration of the rubble, whatever it
// falls by.
TEST(PeakWatch, AMaximumFarBeyondTheEstimateIsNoFirstPeak) {
  std::vector<double> rising;
  for (int k = 0; k < 300; ++k) rising.push_back(k);
  rising.push_back(0.0);
  EXPECT_EQ(piece_behind_peak(rising), -1) << "at 15 % strain";
  rising.assign(190, 1.0);
  rising.push_back(2.0);
  rising.push_back(1.0);
  EXPECT_EQ(piece_behind_peak(rising), 191) << "at 9.55 % strain";
}

// Three segments of a third of a piece each are one piece, whose stress is the mean over its strain.
TEST(PeakWatch, APieceIsTheMeanOverItsSegments) {
  PeakWatch watch;
  EXPECT_FALSE(watch.ends_piece(3.0, PeakWatch::piece / 3.0, 1e-4));
  EXPECT_FALSE(watch.ends_piece(6.0, PeakWatch::piece / 3.0, 2e-4));
  EXPECT_TRUE(watch.ends_piece(9.0, PeakWatch::piece / 3.0, PeakWatch::piece));
  EXPECT_NEAR(watch.last, 6.0, 1e-12);
  EXPECT_EQ(watch.largest, watch.last);
  EXPECT_EQ(watch.largest_at, PeakWatch::piece);
}

}  // namespace
}  // namespace perfora::solver
