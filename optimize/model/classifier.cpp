// What is here: Laplace's approximation of a Gaussian-process classifier. What is not: classes.
#include "optimize/model/classifier.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace perfora::model {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_steps = 50;
constexpr double settled = 1e-9;

double logistic(double x) {
  return 1.0 / (1.0 + std::exp(-x));
}

/// ln(1/(1 + exp(-x))) without overflow.
double log_logistic(double x) {
  return x > 0.0 ? -std::log1p(std::exp(-x)) : x - std::log1p(std::exp(x));
}

}  // namespace

Classifier::Classifier(Inputs inputs, std::vector<bool> members) : inputs_(std::move(inputs)) {
  const auto n = static_cast<Eigen::Index>(members.size());
  const auto count = static_cast<double>(std::count(members.begin(), members.end(), true));
  const double share = (count + 1.0) / (static_cast<double>(n) + 2.0);
  prior_ = std::log(share / (1.0 - share));
  both_ = count > 0.0 && count < static_cast<double>(n);
  sign_.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) sign_(k) = members[static_cast<std::size_t>(k)] ? 1.0 : -1.0;
  if (!both_) return;
  const double usual = std::exp(std::sqrt(2.0)) * std::sqrt(std::max(1, inputs_.dimension()));
  bool first = true;
  for (const double shorter : {1.0, 0.5, 0.25, 0.125})
    for (const double signal : {1.0, 4.0, 16.0}) {
      const Kernel kernel{VectorXd::Constant(inputs_.dimension(), usual * shorter), 1.0, 0.0};
      Fit one = fit(kernel, signal);
      if (first || one.log_likelihood > best_.log_likelihood) best_ = std::move(one);
      first = false;
    }
}

Classifier::Fit Classifier::fit(const Kernel& kernel, double signal) const {
  const auto n = sign_.size();
  const MatrixXd covariance = signal * kernel(inputs_, inputs_);
  Fit found{kernel, signal, VectorXd::Zero(n), VectorXd::Zero(n), {}, {}, 0.0};
  VectorXd dual = VectorXd::Zero(n);  // K^-1 mode
  double before = -1e300;
  for (int step = 0; step < most_steps; ++step) {
    VectorXd weight(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double p = logistic(found.mode(k) + prior_);
      found.gradient(k) = 0.5 * (sign_(k) + 1.0) - p;
      weight(k) = std::max(p * (1.0 - p), 1e-12);
    }
    found.root_weight = weight.cwiseSqrt();
    const MatrixXd b =
        MatrixXd::Identity(n, n) + found.root_weight.asDiagonal() * covariance * found.root_weight.asDiagonal();
    found.root.compute(b);
    double objective = -0.5 * dual.dot(found.mode);
    for (Eigen::Index k = 0; k < n; ++k) objective += log_logistic(sign_(k) * (found.mode(k) + prior_));
    found.log_likelihood = objective - found.root.matrixLLT().diagonal().array().log().sum();
    if (std::abs(objective - before) < settled) break;
    before = objective;
    const VectorXd right = weight.cwiseProduct(found.mode) + found.gradient;
    dual = right - found.root_weight.cwiseProduct(found.root.solve(found.root_weight.cwiseProduct(covariance * right)));
    found.mode = covariance * dual;
  }
  return found;
}

double Classifier::probability(const Inputs& one) const {
  if (!both_) return logistic(prior_);
  const MatrixXd cross = best_.signal * best_.kernel(inputs_, one);
  const double mean = prior_ + cross.col(0).dot(best_.gradient);
  const VectorXd half = best_.root.matrixL().solve(best_.root_weight.cwiseProduct(cross.col(0)));
  const double variance = std::max(best_.signal - half.squaredNorm(), 0.0);
  return logistic(mean / std::sqrt(1.0 + std::numbers::pi * variance / 8.0));
}

}  // namespace perfora::model
