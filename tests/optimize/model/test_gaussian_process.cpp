// What is here: a Gaussian process against closed forms and against scikit-learn. What is not: its use
// (test_response_model.cpp).
#include "optimize/model/gaussian_process.h"

#include <gtest/gtest.h>

#include <cmath>

namespace perfora::model {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Inputs inputs(const MatrixXd& points, std::vector<int> family = {}, std::vector<int> fidelity = {}) {
  const auto n = static_cast<std::size_t>(points.rows());
  if (family.empty()) family.assign(n, 0);
  if (fidelity.empty()) fidelity.assign(n, 0);
  return {points, family, fidelity};
}

Observations observed(const Inputs& at, const VectorXd& values, const VectorXd& noise) {
  Observations made{at, values, noise, {}};
  for (int k = 0; k < at.rows(); ++k) made.design.push_back(k);
  return made;
}

Hyperparameters hyper(const VectorXd& length, double signal, double noise) {
  return {{length, 1.0, 0.1}, signal, noise};
}

/// Matern 5/2 at distance r.
double matern(double r) {
  return (1.0 + std::sqrt(5.0) * r + 5.0 * r * r / 3.0) * std::exp(-std::sqrt(5.0) * r);
}

// One value: the constant is that value, so it is expected everywhere; the variance of a mean that is known from one
// value with noise v at covariance c is signal (2 - 2 c) + v.
TEST(GaussianProcess, OfOneValue) {
  const GaussianProcess process(observed(inputs(MatrixXd::Zero(1, 1)), VectorXd::Constant(1, 3.0), VectorXd::Ones(1)),
                                hyper(VectorXd::Constant(1, 0.5), 2.0, 0.1));
  const Expected expected = process.at(inputs(MatrixXd::Constant(1, 1, 0.25)));
  EXPECT_NEAR(expected.mean, 3.0, 1e-8);
  EXPECT_NEAR(expected.variance, 2.0 * (2.0 - 2.0 * matern(0.5)) + 0.1, 1e-7);
}

// Two values without noise, +1 and -1: by symmetry the constant is their mean 0, and at distances a and b the mean is
// (k(a) - k(b))/(1 - k(d)).
TEST(GaussianProcess, OfTwoValues) {
  MatrixXd points(2, 1);
  points << 0.0, 1.0;
  VectorXd values(2);
  values << 1.0, -1.0;
  const GaussianProcess process(observed(inputs(points), values, VectorXd::Zero(2)),
                                hyper(VectorXd::Constant(1, 0.8), 1.7, 1.0));
  const double expected = (matern(0.3 / 0.8) - matern(0.7 / 0.8)) / (1.0 - matern(1.0 / 0.8));
  EXPECT_NEAR(process.at(inputs(MatrixXd::Constant(1, 1, 0.3))).mean, expected, 1e-7);
}

// Six values in two dimensions with unequal noise, constants integrated: scikit-learn 1.2.1, GaussianProcessRegressor
// with the kernel 1e5 + 1.3 Matern(length_scale = [0.4, 0.7], nu = 2.5) and alpha = the noise, run once; its constant
// of variance 1e5 stands for a flat prior (1e4 gives the same to five digits).
class SixValues : public testing::Test {
 protected:
  MatrixXd points{{0.05, 0.2}, {0.3, 0.9}, {0.45, 0.1}, {0.6, 0.55}, {0.8, 0.35}, {0.95, 0.75}};
  VectorXd values{{1.2, 0.4, 2.1, 1.5, 0.3, -0.6}}, noise{{0.01, 0.02, 0.005, 0.04, 0.01, 0.02}};
  GaussianProcess process(double l1, double l2, double signal, double level) const {
    return {observed(inputs(points), values, noise), hyper(VectorXd{{l1, l2}}, signal, level)};
  }
};

TEST_F(SixValues, AreThoseOfScikitLearn) {
  const MatrixXd questions{{0.5, 0.5}, {0.1, 0.8}, {1.2, 0.0}};
  const GaussianProcess::Joint joint = process(0.4, 0.7, 1.3, 1.0).together(inputs(questions));
  const double mean[] = {1.72679030, 0.38092860, -0.23897691}, variance[] = {0.07545590, 0.31172487, 1.12703678};
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(joint.mean(k), mean[k], 2e-5) << k;
    EXPECT_NEAR(joint.covariance(k, k), variance[k], 2e-5) << k;
  }
}

// The restricted likelihood differs from that with the wide constant by the same amount for all hyperparameters.
TEST_F(SixValues, HaveTheLikelihoodOfScikitLearn) {
  const double first = process(0.4, 0.7, 1.3, 1.0).log_likelihood();
  const double second = process(0.25, 1.1, 0.8, 2.0).log_likelihood();
  EXPECT_NEAR(first - second, 0.15615260, 1e-4);
}

// scikit-learn fitted to the other five, noise of the sixth added.
TEST_F(SixValues, LeftOutAreThoseOfFits) {
  const std::vector<LeftOut> out = process(0.4, 0.7, 1.3, 1.0).left_out();
  EXPECT_NEAR(out[0].mean, 1.06868597, 2e-5);
  EXPECT_NEAR(out[0].variance, 0.93307993, 2e-5);
  EXPECT_NEAR(out[3].mean, 0.70498567, 2e-5);
  EXPECT_NEAR(out[3].variance, 0.32191851, 2e-5);
  EXPECT_EQ(out[3].value, 1.5);
}

// What is left out together is not told by its other half: the same as a process of the others.
TEST_F(SixValues, AreLeftOutByDesigns) {
  Observations seen = observed(inputs(points), values, noise);
  seen.design = {0, 1, 2, 0, 3, 4};
  const Hyperparameters known = hyper(VectorXd{{0.4, 0.7}}, 1.3, 1.0);
  const LeftOut out = GaussianProcess(seen, known).left_out()[3];
  const std::vector<int> rest{1, 2, 4, 5};
  const GaussianProcess others(observed(inputs(points(rest, Eigen::all)), values(rest), noise(rest)), known);
  const Expected expected = others.at(inputs(points.row(3)));
  EXPECT_NEAR(out.mean, expected.mean, 1e-6);
  EXPECT_NEAR(out.variance, expected.variance + noise(3), 1e-6);
}

TEST_F(SixValues, WithoutNoiseAreMetExactly) {
  const GaussianProcess process(observed(inputs(points), values, VectorXd::Zero(6)),
                                hyper(VectorXd{{0.4, 0.7}}, 1.3, 1.0));
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(process.at(inputs(points.row(k))).mean, values(k), 1e-6) << k;
    EXPECT_NEAR(process.at(inputs(points.row(k))).variance, 0.0, 1e-6) << k;
  }
}

// Told what it expects, it expects the same everywhere, and is surer.
TEST_F(SixValues, ToldWhatItExpectsItIsSurer) {
  const GaussianProcess before = process(0.4, 0.7, 1.3, 1.0);
  const Inputs at = inputs(MatrixXd{{0.2, 0.5}}), elsewhere = inputs(MatrixXd{{0.3, 0.4}});
  const GaussianProcess after = before.told(at, before.at(at).mean, 0.01);
  EXPECT_NEAR(after.at(elsewhere).mean, before.at(elsewhere).mean, 1e-8);
  EXPECT_LT(after.at(elsewhere).variance, 0.5 * before.at(elsewhere).variance);
}

// Equal inputs twice, without noise: the matrix is singular but for the jitter.
TEST(GaussianProcess, BearsEqualInputs) {
  const GaussianProcess process(
      observed(inputs(MatrixXd::Constant(3, 1, 0.5)), VectorXd{{1.0, 1.0, 1.0}}, VectorXd::Zero(3)),
      hyper(VectorXd::Constant(1, 0.5), 1.0, 1.0));
  EXPECT_NEAR(process.at(inputs(MatrixXd::Constant(1, 1, 0.5))).mean, 1.0, 1e-6);
}

// A family that is far from the others (length 0.1: covariance matern(10) = 5e-8) hears of the constant alone.
TEST(GaussianProcess, FamiliesShareAsMuchAsTheirLengthSays) {
  Hyperparameters known = hyper(VectorXd::Constant(1, 1.0), 1.0, 1.0);
  const Observations seen =
      observed(inputs(MatrixXd{{0.0}, {0.1}, {0.2}}), VectorXd{{5.0, 5.1, 4.9}}, VectorXd::Constant(3, 0.01));
  const auto off = [&](double length) {
    known.kernel.family_length = length;
    return GaussianProcess(seen, known).at(inputs(MatrixXd{{0.1}}, {7})).variance;
  };
  EXPECT_GT(off(0.1), 0.9);
  EXPECT_LT(off(100.0), 0.02);
}

// Runs at a cheaper fidelity that are 2 above: two designs at both tell the constant, the third is known at the cheaper
// one alone.
TEST(GaussianProcess, FidelitiesDifferByAConstant) {
  Hyperparameters known = hyper(VectorXd::Constant(1, 0.5), 1.0, 1.0);
  known.kernel.bias = 1e-6;
  Observations seen = observed(inputs(MatrixXd{{0.0}, {1.0}, {0.0}, {0.5}, {1.0}}, {}, {0, 0, 1, 1, 1}),
                               VectorXd{{1.0, 2.0, 3.0, 5.0, 4.0}}, VectorXd::Constant(5, 1e-6));
  const GaussianProcess process(seen, known);
  EXPECT_NEAR(process.at(inputs(MatrixXd{{0.5}})).mean, 3.0, 1e-2);
  EXPECT_LT(process.at(inputs(MatrixXd{{0.5}})).variance, 1e-2);
  EXPECT_NEAR(process.at(inputs(MatrixXd{{0.5}}, {0}, {1})).mean, 5.0, 1e-2);
}

}  // namespace
}  // namespace perfora::model
