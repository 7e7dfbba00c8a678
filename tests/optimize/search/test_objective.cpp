// What is here: the score against its formula worked out by hand. What is not: who asks for it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "optimize/campaign/executor.h"
#include "optimize/search/constraints.h"
#include "optimize/search/objective.h"

namespace perfora::optimize {
namespace {

using results::Target;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

std::size_t place_of(const char* key) {
  return static_cast<std::size_t>(results::measure_called(key) - results::measures().data());
}

/// A run whose plateau, distance to `target` and cap ratio fit together.
Evaluation run(double plateau, double undulation = 0.0, double peak = 0.0, double target = 2e5) {
  Evaluation evaluation;
  evaluation.status = results::RunStatus::completed;
  results::Summary& summary = evaluation.summary;
  summary.plateau_start = 0.2;
  summary.plateau_end = 0.4;
  summary.plateau_stress = plateau;
  summary.target_distance = std::abs(std::log(plateau / target));
  summary.cap_ratio = peak > plateau ? peak / plateau : 1.0;
  summary.undulation = undulation;
  summary.first_peak_stress = peak;
  return evaluation;
}

Score score(const Target& target, const std::vector<Evaluation>& runs) {
  std::vector<const Evaluation*> pointers;
  for (const Evaluation& evaluation : runs) pointers.push_back(&evaluation);
  return score_of(target, pointers);
}

Target target_of(double stress) {
  Target target;
  target.plateau_stress = stress;
  return target;
}

double square(double value) {
  return value * value;
}

/// What a wish that is not kept costs beyond its distance: (ln floor)^2 with the floor of 5 %.
const double step = square(std::log(0.05));

TEST(Objective, IsTheSquaredDistanceInLogarithmsAndATenthOfTheCapRatios) {
  const std::vector<Evaluation> runs{run(1e5, 0.0, 2e5), run(4e5, 0.0, 4e5)};
  // Half and twice the target: ln 2 each; cap ratios 2 and 1; their mean of 250 kPa lies beyond 200 kPa + 20 %.
  EXPECT_NEAR(score(target_of(2e5), runs).value,
              square(std::log(2.0)) + 0.1 * 0.5 * square(std::log(2.0)) + step + square(std::log(2.5 / 2.4)), 1e-13);
  EXPECT_NEAR(score(target_of(2e5), runs).plateau_std, 3e5 / std::sqrt(2.0), 1e-6);
}

TEST(Objective, UndershootAndOvershootByOneFactorCostTheSame) {
  Target target = target_of(2e5);
  target.weight_limits = 0.0;  // tolerances are in percent, so bounds are no factors
  EXPECT_NEAR(score(target, {run(5e4)}).value, score(target, {run(8e5)}).value, 1e-14);
}

// Wished 90 kPa within 20 %: a flat curve of 241 kPa is (ln 2.68)^2 = 0.97 away, one whose mean is 88 kPa but which is
// off by a factor of e throughout (first half too low, then too high) is 1 away, and keeps the wish.
TEST(Objective, ADesignThatKeepsItsWishesComesBeforeAFlatterOneThatDoesNot) {
  const Target target = target_of(9e4);
  const Evaluation flat = run(2.41e5, 0.0, 0.0, 9e4);
  Evaluation rugged = run(8.8e4, 0.0, 0.0, 9e4);
  rugged.summary.target_distance = 1.0;
  EXPECT_LT(flat.summary.target_distance, rugged.summary.target_distance);
  EXPECT_LT(score(target, {rugged}).value, score(target, {flat}).value);
  EXPECT_EQ(score(target, {rugged}).not_kept, 0);
  EXPECT_EQ(score(target, {flat}).not_kept, 1);
  EXPECT_EQ(score(target, {flat}).wishes, 1);
  EXPECT_EQ(wishes_text(score(target, {flat})), ", 0 of 1 wish kept");
}

// The larger part of the wishes first, whatever the distances: each term is at most (ln floor)^2 = 9.
TEST(Objective, MoreWishesKeptIsAlwaysBetter) {
  Target target = target_of(2e5);
  target.weights[place_of("cap_ratio")] = 0.0;
  target.limits[place_of("undulation")] = {0.3};
  target.limits[place_of("slope")] = {0.8, 1.25};
  Evaluation far = run(1.7e5, 0.2), near = run(2e5, 0.31);
  far.summary.slope = near.summary.slope = 1.0;
  far.summary.target_distance = std::log(20.0);
  EXPECT_LE(score(target, {far}).value, score(target, {near}).value);
  EXPECT_EQ(score(target, {near}).not_kept, 1);
  EXPECT_EQ(score(target, {near}).wishes, 3);
}

TEST(Objective, AddsWeightedTermsOfEachCurve) {
  Target target = target_of(2e5);
  target.weights[place_of("cap_ratio")] = 0.0;
  target.weights[place_of("undulation")] = 10.0;
  // Squares of each curve's own undulation: (0.01 + 0.09)/2.
  EXPECT_NEAR(score(target, {run(2e5, 0.1), run(2e5, 0.3)}).value, 10.0 * 0.05, 1e-14);
  target.weights[place_of("undulation")] = 0.0;
  target.weights[place_of("first_peak_stress")] = 0.5;  // twice the target; below it: nothing
  EXPECT_NEAR(score(target, {run(2e5, 0.0, 4e5), run(2e5, 0.0, 1e5)}).value, 0.25 * square(std::log(2.0)), 1e-14);
}

TEST(Objective, ALimitCostsWhereItsMeanIsNotKept) {
  Target target = target_of(2e5);
  target.weights[place_of("cap_ratio")] = 0.0;
  target.limits[place_of("first_peak_stress")] = {3e5};
  EXPECT_EQ(score(target, {run(2e5, 0.0, 3e5)}).value, 0.0);
  EXPECT_NEAR(score(target, {run(2e5, 0.0, 5e5), run(2e5, 0.0, 7e5)}).value, step + square(std::log(2.0)), 1e-13);
  target.limits[place_of("first_peak_stress")] = {};
  target.limits[place_of("slope")] = {0.8, 1.25};
  Evaluation steep = run(2e5);
  steep.summary.slope = 2.5;
  EXPECT_NEAR(score(target, {steep}).value, step + square(std::log(2.0)), 1e-13);
  steep.summary.slope = 0.4;
  EXPECT_NEAR(score(target, {steep}).value, step + square(std::log(2.0)), 1e-13);
}

// Four of five blocks have no slope (no plateau was found): a mean over the one that has says nothing of them, and each
// counts as a measure that was not reached, 2 (ln floor)^2.
TEST(Objective, BlocksWithoutTheMeasureDoNotKeepItsWish) {
  Target target = target_of(2e5);
  target.weights[place_of("cap_ratio")] = 0.0;
  target.limits[place_of("slope")] = {0.8, 1.25};
  std::vector<Evaluation> runs(5, run(2e5));
  for (Evaluation& one : runs) one.summary.slope = nan_value;
  runs.front().summary.slope = 1.0;
  const Score value = score(target, runs);
  EXPECT_NEAR(value.value, 0.8 * 2.0 * step, 1e-12);
  EXPECT_EQ(value.not_kept, 1);
}

// No plateau was found on the curve: the worst there is, ln(floor) squared, but a number that can be searched on.
TEST(Objective, ACurveWithoutAFoundPlateauIsWorstNotFailed) {
  Evaluation without = run(nan_value);
  without.summary.measured = "found";
  without.summary.cap_ratio = nan_value;
  const Score value = score(target_of(2e5), {without});
  EXPECT_TRUE(value.valid);
  EXPECT_NEAR(value.value, (1.1 + 2.0) * step, 1e-12);  // and the wish is not kept: as far off as can be
}

TEST(Objective, IsFiniteWhateverTheRunsGave) {
  const Target target = target_of(1.0);
  for (const double plateau : {0.0, -1e300, 1e300, 1e-300, nan_value, std::numeric_limits<double>::infinity()}) {
    const Score value = score(target, {run(plateau, nan_value, nan_value), run(1.0)});
    EXPECT_TRUE(std::isfinite(value.value)) << plateau;
    EXPECT_LE(value.value, std::isfinite(plateau) ? largest_score : failed_score) << plateau;
  }
  EXPECT_TRUE(std::isfinite(score(target, {}).value));
}

// A score that ends at the largest one: its terms stay, the wishes have the rest.
TEST(Objective, ThePartOfTheWishesIsNeverMoreThanTheRest) {
  Target target = target_of(2e5);
  target.weights[place_of("cap_ratio")] = 0.0;
  target.weights[place_of("undulation")] = 100.0;
  target.limits[place_of("undulation")] = {0.1};
  target.weight_limits = 100.0;
  const Score value = score(target, {run(2e5, 0.5)});  // 100 x 0.25, and more than 900 of one wish
  EXPECT_EQ(value.value, largest_score);
  EXPECT_NEAR(value.value - value.of_wishes, 25.0, 1e-10);
}

TEST(Objective, OrdersSimulatedBeforeFailedBeforeBrokenConstraints) {
  EXPECT_LT(largest_score, failed_score);
  EXPECT_LT(failed_score, violation_score(0.0));
  EXPECT_NEAR(violation_score(0.5), 1500.0, 1e-9);
}

TEST(Objective, OneFailedReplicateFailsTheCandidateAndSaysWhy) {
  const Request request = make_request(DesignFile(), 1, 0.4);
  const Score value = score(target_of(2e5), {run(2e5), failed_evaluation("unstable step", request.replicate)});
  EXPECT_FALSE(value.valid);
  EXPECT_EQ(value.value, failed_score);
  EXPECT_EQ(value.failed, 1);
  EXPECT_EQ(value.reason, "unstable step");
  EXPECT_EQ(value.plateau_mean, 2e5);
}

TEST(Objective, AStoppedRunIsNotUsable) {
  Evaluation stopped = run(2e5);
  stopped.status = results::RunStatus::stopped;
  EXPECT_FALSE(usable(stopped));
  EXPECT_FALSE(usable(run(nan_value)));
  EXPECT_TRUE(usable(run(1.0)));
}

}  // namespace
}  // namespace perfora::optimize
