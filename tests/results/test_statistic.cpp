// What is here: statistics over replicates against textbook numbers. What is not: which results they are taken of.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "results/statistic.h"

namespace perfora::results {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Statistic, MatchesTheTextbook) {
  // Mean 3, squares 4 + 1 + 0 + 1 + 4 over 4: variance 2.5. t(0.975, 4 degrees) = 2.776 (any table).
  const Statistic statistic = statistic_of("x", {1.0, 2.0, 3.0, 4.0, 5.0});
  EXPECT_EQ(statistic.count, 5);
  EXPECT_DOUBLE_EQ(statistic.mean, 3.0);
  EXPECT_DOUBLE_EQ(statistic.standard_deviation, std::sqrt(2.5));
  EXPECT_NEAR(statistic.confidence_95, 2.776 * std::sqrt(2.5 / 5.0), 1e-3);
  EXPECT_DOUBLE_EQ(statistic.minimum, 1.0);
  EXPECT_DOUBLE_EQ(statistic.maximum, 5.0);
}

TEST(Statistic, LeavesOutWhatWasNotReached) {
  const Statistic statistic = statistic_of("x", {nan, 2.0, nan, 4.0});
  EXPECT_EQ(statistic.count, 2);
  EXPECT_DOUBLE_EQ(statistic.mean, 3.0);
  // t(0.975, 1 degree) = 12.706, deviation sqrt 2.
  EXPECT_NEAR(statistic.confidence_95, 12.706, 1e-3);
}

TEST(Statistic, OneValueHasNoSpreadAndNoneHasNoMean) {
  EXPECT_TRUE(std::isnan(statistic_of("x", {2.0}).standard_deviation));
  EXPECT_TRUE(std::isnan(statistic_of("x", {2.0}).confidence_95));
  EXPECT_EQ(statistic_of("x", {2.0}).mean, 2.0);
  EXPECT_EQ(statistic_of("x", {nan}).count, 0);
  EXPECT_TRUE(std::isnan(statistic_of("x", {nan}).mean));
}

}  // namespace
}  // namespace perfora::results
