// What is here: hyperparameters from data, pooled noise. What is not: the process itself (test_gaussian_process.cpp).
#include "optimize/model/gaussian_fit.h"

#include <gtest/gtest.h>

#include <random>

#include "optimize/model/noise_model.h"
#include "optimize/model/quasi_random.h"
#include "tests/optimize/model/model_support.h"

namespace perfora::model {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Observations of(const Inputs& at, const std::function<double(int)>& value, double noise) {
  Observations made{at, VectorXd(at.rows()), VectorXd::Constant(at.rows(), noise), {}};
  for (int k = 0; k < at.rows(); ++k) {
    made.values(k) = value(k);
    made.design.push_back(k);
  }
  return made;
}

// The gradient against differences of the objective, with families and fidelities.
TEST(GaussianFit, GradientIsTheSlopeOfTheObjective) {
  Inputs at = plain_inputs(sobol_matrix(9, 2, 3));
  at.family = {0, 1, 0, 2, 1, 0, 0, 1, 2};
  at.fidelity = {0, 0, 1, 1, 0, 2, 2, 1, 0};
  const Observations seen = of(
      at, [](int k) { return scatter(k); }, 0.5);
  const FitOptions options{lbfgs, 0.2, 6, false};
  const std::vector<double> x{-0.3, 0.4, 0.2, -1.0, 0.1, -1.5};
  std::vector<double> gradient(6), unused(6);
  fit_objective(seen, options, x, gradient);
  for (std::size_t k = 0; k < x.size(); ++k) {
    std::vector<double> up = x, down = x;
    up[k] += 1e-5;
    down[k] -= 1e-5;
    const double slope = (fit_objective(seen, options, up, unused) - fit_objective(seen, options, down, unused)) / 2e-5;
    EXPECT_NEAR(gradient[k], slope, 1e-5 * std::max(1.0, std::abs(slope))) << k;
  }
}

// A response of the first input alone: the length of the second becomes long, and the noise is found.
TEST(GaussianFit, FindsWhichInputMattersAndTheNoise) {
  const MatrixXd points = sobol_matrix(64, 2, 5);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0.0, 0.1);
  std::vector<double> noise;
  for (int k = 0; k < 64; ++k) noise.push_back(normal(random));
  const Observations seen = of(
      plain_inputs(points), [&](int k) { return std::sin(6.0 * points(k, 0)) + noise[static_cast<std::size_t>(k)]; },
      1.0);
  const GaussianProcess process = fitted(seen, {lbfgs, 0.0, 0, false});
  const Hyperparameters& found = process.hyperparameters();
  EXPECT_GT(found.kernel.length(1), 5.0 * found.kernel.length(0));
  EXPECT_NEAR(std::sqrt(found.noise), 0.1, 0.025) << "a deviation from 64 values is known to a tenth";
  double worst = 0.0;
  for (double x = 0.1; x < 0.95; x += 0.1)
    worst = std::max(worst, std::abs(process.at(plain_inputs(MatrixXd{{x, 0.5}})).mean - std::sin(6.0 * x)));
  EXPECT_LT(worst, 0.15);
}

TEST(GaussianFit, IsTheSameAgain) {
  const Observations seen = of(
      plain_inputs(sobol_matrix(20, 3, 8)), [](int k) { return scatter(k); }, 1.0);
  const GaussianProcess first = fitted(seen, {lbfgs, 0.1, 10, false}), second = fitted(seen, {lbfgs, 0.1, 10, false});
  EXPECT_EQ(first.hyperparameters().kernel.length, second.hyperparameters().kernel.length);
  EXPECT_EQ(first.log_likelihood(), second.log_likelihood());
}

// Variances pooled by their degrees of freedom: (1 x 2 + 3 x 6)/4 = 5.
TEST(NoiseModel, PoolsByDegreesOfFreedom) {
  const NoiseModel noise(plain_inputs(MatrixXd{{0.0}, {0.5}, {1.0}}), {{2, 2.0}, {4, 6.0}, {1, 0.0}}, lbfgs);
  EXPECT_DOUBLE_EQ(noise.pooled(), 5.0);
  EXPECT_EQ(noise.freedom(), 4);
  EXPECT_EQ(noise.relative(plain_inputs(MatrixXd{{0.3}})), 1.0);
}

// Sample variances of normal numbers whose deviation grows fourfold along the input: the relative noise follows it
// (variances of 1 to 16), though a variance of four replicates alone is off by a factor of two.
TEST(NoiseModel, FollowsNoiseThatVaries) {
  const int designs = 40, replicates = 4;
  MatrixXd points(designs, 1);
  std::vector<Spread> spreads;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int k = 0; k < designs; ++k) {
    points(k, 0) = (k + 0.5) / designs;
    double sum = 0.0, square = 0.0;
    for (int r = 0; r < replicates; ++r) {
      const double value = std::exp(std::log(4.0) * points(k, 0)) * normal(random);
      sum += value / replicates;
      square += value * value;
    }
    spreads.push_back({replicates, (square - replicates * sum * sum) / (replicates - 1)});
  }
  const NoiseModel noise(plain_inputs(points), spreads, lbfgs);
  const auto variance = [&](double x) { return noise.pooled() * noise.relative(plain_inputs(MatrixXd{{x}})); };
  EXPECT_NEAR(std::log(variance(0.1)), std::log(16.0) * 0.1, 0.6);
  EXPECT_NEAR(std::log(variance(0.9)), std::log(16.0) * 0.9, 0.6);
  EXPECT_GT(variance(0.9) / variance(0.1), 4.0);
}

}  // namespace
}  // namespace perfora::model
