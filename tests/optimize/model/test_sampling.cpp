// What is here: quasi-random points, Sobol indices, classification: closed forms. What is not: designs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "optimize/model/classifier.h"
#include "optimize/model/quasi_random.h"
#include "optimize/model/sensitivity.h"
#include "tests/optimize/model/model_support.h"

namespace perfora::model {
namespace {

// A (0, m, 2)-net in base 2: each of the 2^m boxes of area 2^-m of every shape holds one of its 2^m points. True of the
// first two coordinates of Sobol's sequence (Sobol 1967), and scrambling keeps it (Owen 1995).
TEST(Sobol, EveryBoxOfANetHoldsOnePoint) {
  constexpr int m = 6, count = 1 << m;
  const auto points = sobol_points(count, 2, 7);
  for (int wide = 0; wide <= m; ++wide) {
    std::vector<int> boxes(count, 0);
    for (const auto& point : points) {
      const int column = static_cast<int>(std::ldexp(point[0], wide)),
                row = static_cast<int>(std::ldexp(point[1], m - wide));
      ++boxes[static_cast<std::size_t>((row << wide) + column)];
    }
    EXPECT_TRUE(std::all_of(boxes.begin(), boxes.end(), [](int held) { return held == 1; })) << wide;
  }
}

TEST(Sobol, SeedsDifferAndLongerListsBeginAlike) {
  const auto few = sobol_points(5, 3, 1), many = sobol_points(20, 3, 1);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  EXPECT_NE(few, sobol_points(5, 3, 2));
}

// Mean 0, variance 1 and no correlation, far nearer than the 1/sqrt(1024) = 0.03 of random numbers.
TEST(Sobol, NormalNumbersAreNormal) {
  const Eigen::MatrixXd draws = normal_matrix(1024, 3, 4);
  const Eigen::MatrixXd moments = draws.transpose() * draws / 1024.0;
  EXPECT_LT(draws.colwise().mean().cwiseAbs().maxCoeff(), 5e-3);
  EXPECT_LT((moments - Eigen::MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff(), 2e-2);
}

// Ishigami and Homma 1990, a = 7, b = 0.1: V = a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2, V1 = (1 + b pi^4/5)^2/2,
// V2 = a^2/8, V13 = 8 b^2 pi^8/225; all other parts vanish.
TEST(SobolIndices, AreThoseOfIshigami) {
  const double a = 7.0, b = 0.1, pi = std::numbers::pi;
  const auto function = [&](std::span<const double> u) {
    const double x = pi * (2.0 * u[0] - 1.0), y = pi * (2.0 * u[1] - 1.0), z = pi * (2.0 * u[2] - 1.0);
    return std::sin(x) + a * std::pow(std::sin(y), 2) + b * std::pow(z, 4) * std::sin(x);
  };
  const SobolIndices found = sobol_indices(function, 3, 4096, 2);
  const double variance = a * a / 8.0 + b * std::pow(pi, 4) / 5.0 + b * b * std::pow(pi, 8) / 18.0 + 0.5;
  const double first = 0.5 * std::pow(1.0 + b * std::pow(pi, 4) / 5.0, 2) / variance, second = a * a / 8.0 / variance;
  const double both = 8.0 * b * b * std::pow(pi, 8) / 225.0 / variance;
  EXPECT_NEAR(found.mean, a / 2.0, 0.01);
  EXPECT_NEAR(found.variance, variance, 0.01 * variance);
  const double firsts[] = {first, second, 0.0}, totals[] = {first + both, second, both};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found.first[k], firsts[k], 0.01) << k;
    EXPECT_NEAR(found.total[k], totals[k], 0.01) << k;
  }
}

TEST(SobolIndices, OfAConstantAreZero) {
  EXPECT_EQ(sobol_indices([](std::span<const double>) { return 4.0; }, 2, 16, 1).total,
            (std::vector<double>{0.0, 0.0}));
}

// Laplace's rule of succession: after four successes in four the next one has (4 + 1)/(4 + 2).
TEST(Classifier, OfOneClassIsTheRuleOfSuccession) {
  const Classifier always(plain_inputs(sobol_matrix(4, 1, 1)), {true, true, true, true});
  EXPECT_NEAR(always.probability(plain_inputs(Eigen::MatrixXd{{0.3}})), 5.0 / 6.0, 1e-12);
}

// Members above 0.6: sure on either side, undecided at the border.
TEST(Classifier, FindsABorder) {
  const Eigen::MatrixXd points = sobol_matrix(40, 2, 6);
  std::vector<bool> members;
  for (int k = 0; k < 40; ++k) members.push_back(points(k, 0) > 0.6);
  const Classifier classifier(plain_inputs(points), members);
  const auto at = [&](double x) { return classifier.probability(plain_inputs(Eigen::MatrixXd{{x, 0.5}})); };
  EXPECT_GT(at(0.95), 0.9);
  EXPECT_LT(at(0.1), 0.1);
  EXPECT_NEAR(at(0.6), 0.5, 0.25);
}

// One observation of each class, far apart: Laplace's mode f solves f = sum k(x, x_i)(y_i - logistic(f_i)) (Rasmussen
// and Williams 2006, eq. 3.17); by symmetry the probability between the two is one half, and those at them add up to 1.
TEST(Classifier, IsSymmetricInItsClasses) {
  const Classifier two(plain_inputs(Eigen::MatrixXd{{0.0}, {1.0}}), {false, true});
  const auto at = [&](double x) { return two.probability(plain_inputs(Eigen::MatrixXd{{x}})); };
  EXPECT_NEAR(at(0.5), 0.5, 1e-9);
  EXPECT_NEAR(at(0.0) + at(1.0), 1.0, 1e-9);
  EXPECT_GT(at(1.0), 0.5);
}

}  // namespace
}  // namespace perfora::model
