// What is here: the score against its formula worked out by hand. What is not: who asks for it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "optimize/campaign/executor.h"
#include "optimize/search/constraints.h"
#include "optimize/search/objective.h"

namespace perfora::optimize {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

Evaluation run(double plateau, double undulation = 0.0, double peak = 0.0) {
  Evaluation evaluation;
  evaluation.status = results::RunStatus::completed;
  evaluation.summary.plateau_stress = plateau;
  evaluation.summary.undulation = undulation;
  evaluation.summary.first_peak_stress = peak;
  return evaluation;
}

Score score(const TargetKeys& target, const std::vector<Evaluation>& runs) {
  std::vector<const Evaluation*> pointers;
  for (const Evaluation& evaluation : runs) pointers.push_back(&evaluation);
  return score_of(target, pointers);
}

TargetKeys target_of(double stress) {
  TargetKeys target;
  target.plateau_stress = stress;
  return target;
}

TEST(Objective, IsTheSquaredRelativeMissPlusItsWeightedTerms) {
  TargetKeys target = target_of(2e5);
  // mean 2.4e5, std (n - 1) sqrt(2) 0.2e5: (0.2)^2 + w (0.1 sqrt 2)^2.
  const std::vector<Evaluation> runs{run(2.2e5, 0.1, 4e5), run(2.6e5, 0.3, 6e5)};
  target.weight_std = 0.0;
  EXPECT_NEAR(score(target, runs).value, 0.04, 1e-14);
  target.weight_std = 3.0;
  EXPECT_NEAR(score(target, runs).value, 0.04 + 3.0 * 0.02, 1e-14);
  target.weight_undulation = 10.0;  // mean undulation 0.2
  EXPECT_NEAR(score(target, runs).value, 0.1 + 10.0 * 0.04, 1e-14);
  target.weight_peak = 0.5;  // mean peak 5e5: 1.5 targets above
  EXPECT_NEAR(score(target, runs).value, 0.5 + 0.5 * 2.25, 1e-14);
  EXPECT_NEAR(score(target, runs).plateau_std, std::sqrt(2.0) * 0.2e5, 1e-6);
}

TEST(Objective, APeakBelowTheTargetCostsNothing) {
  TargetKeys target = target_of(2e5);
  target.weight_peak = 1.0;
  EXPECT_EQ(score(target, {run(2e5, 0.0, 1e5)}).value, 0.0);
}

TEST(Objective, OneReplicateHasNoSpread) {
  const Score one = score(target_of(1e5), {run(1e5)});
  EXPECT_EQ(one.value, 0.0);
  EXPECT_EQ(one.plateau_std, 0.0);
  EXPECT_TRUE(one.valid);
}

TEST(Objective, IsFiniteWhateverTheRunsGave) {
  const TargetKeys target = target_of(1.0);
  for (const double plateau : {0.0, -1e300, 1e300, 1e-300, nan_value, std::numeric_limits<double>::infinity()}) {
    const Score value = score(target, {run(plateau, nan_value, nan_value), run(1.0)});
    EXPECT_TRUE(std::isfinite(value.value)) << plateau;
    EXPECT_LE(value.value, std::isfinite(plateau) ? largest_score : failed_score) << plateau;
  }
  EXPECT_TRUE(std::isfinite(score(target, {}).value));
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
