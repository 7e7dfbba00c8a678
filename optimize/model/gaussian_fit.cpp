// What is here: likelihood, prior and gradient over the logarithms of hyperparameters. What is not: a minimiser.
#include "optimize/model/gaussian_fit.h"

#include <algorithm>
#include <boost/math/special_functions/trigamma.hpp>
#include <cmath>

namespace perfora::model {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of lengths, in units of the inputs' range: shorter than the distance of neighbours is noise, longer is a constant.
constexpr double shortest = 0.02, longest = 200.0;

struct Normal {
  double mean = 0.0, deviation = 1.0;
  double cost(double x) const { return 0.5 * (x - mean) * (x - mean) / (deviation * deviation); }
  double slope(double x) const { return (x - mean) / (deviation * deviation); }
};

double variance_of(const VectorXd& values) {
  if (values.size() < 2) return 1.0;
  const double variance = (values.array() - values.mean()).square().sum() / static_cast<double>(values.size() - 1);
  return std::max(variance, 1e-12);
}

/// Priors of ln(lengths ..., family length, bias, signal, noise).
std::vector<Normal> priors(const Observations& observations, const FitOptions& options) {
  const int d = observations.inputs.dimension();
  const double variance = variance_of(observations.values);
  std::vector<Normal> all(static_cast<std::size_t>(d),
                          {std::sqrt(2.0) + 0.5 * std::log(std::max(d, 1)), std::sqrt(3.0)});
  all.push_back({0.0, 1.0});
  all.push_back({std::log(0.1), 1.0});
  all.push_back({std::log(variance), 1.0});
  if (options.known_noise)
    all.push_back({0.0, 1.0});
  else if (options.pooled_freedom > 0 && options.pooled_noise > 0.0)
    // A pooled variance scatters by its degrees of freedom, and noise that varies smoothly is not quite pooled.
    all.push_back({std::log(options.pooled_noise),
                   0.5 + std::sqrt(boost::math::trigamma(0.5 * static_cast<double>(options.pooled_freedom)))});
  else
    all.push_back({std::log(0.1 * variance), 1.5});
  return all;
}

Hyperparameters from_logarithms(std::span<const double> at, int d, bool known_noise) {
  Hyperparameters made;
  made.kernel.length = VectorXd(d);
  for (int j = 0; j < d; ++j) made.kernel.length(j) = std::exp(at[static_cast<std::size_t>(j)]);
  const auto further = at.subspan(static_cast<std::size_t>(d));
  made.kernel.family_length = std::exp(further[0]);
  made.kernel.bias = std::exp(further[1]);
  made.signal = std::exp(further[2]);
  made.noise = known_noise ? 1.0 : std::exp(further[3]);
  return made;
}

}  // namespace

double fit_objective(const Observations& observations, const FitOptions& options, std::span<const double> at,
                     std::span<double> gradient) {
  const Inputs& inputs = observations.inputs;
  const int n = inputs.rows(), d = inputs.dimension();
  const Hyperparameters made = from_logarithms(at, d, options.known_noise);
  const KernelParts parts = kernel_parts(made.kernel, inputs);
  const MatrixXd factor = made.signal * (MatrixXd::Ones(n, n) + made.kernel.bias * parts.same);
  MatrixXd covariance = factor.cwiseProduct(parts.value);
  const MatrixXd clean = covariance;
  covariance.diagonal() += made.noise * observations.relative_noise;
  const Eigen::LLT<MatrixXd> root = safe_root(std::move(covariance));
  const MatrixXd constants = constant_columns(inputs, other_fidelities(inputs));
  const MatrixXd solved = root.solve(constants);
  const Eigen::LLT<MatrixXd> inner = safe_root(constants.transpose() * solved);
  // Minus the logarithm of the restricted likelihood is (y'Py + ln|K| + ln|H'K^-1 H|)/2; by a hyperparameter with dK it
  // changes by (tr(P dK) - alpha' dK alpha)/2, alpha = P y.
  const MatrixXd projected = root.solve(MatrixXd::Identity(n, n)) - solved * inner.solve(solved.transpose());
  const VectorXd alpha = projected * observations.values;
  double cost = 0.5 * (observations.values.dot(alpha) + 2.0 * root.matrixLLT().diagonal().array().log().sum() +
                       2.0 * inner.matrixLLT().diagonal().array().log().sum());
  const MatrixXd weight = 0.5 * (projected - alpha * alpha.transpose());
  const MatrixXd sloped = weight.cwiseProduct(factor).cwiseProduct(parts.slope);
  const VectorXd sums = sloped.rowwise().sum();
  for (int j = 0; j < d; ++j) {
    const VectorXd x = (inputs.points.col(j).array() - inputs.points.col(j).mean()) / made.kernel.length(j);
    gradient[static_cast<std::size_t>(j)] = 2.0 * (x.cwiseAbs2().dot(sums) - x.dot(sloped * x));
  }
  const auto further = gradient.subspan(static_cast<std::size_t>(d));
  further[0] = sloped.cwiseProduct(parts.different).sum() / (made.kernel.family_length * made.kernel.family_length);
  further[1] = made.signal * made.kernel.bias * weight.cwiseProduct(parts.value).cwiseProduct(parts.same).sum();
  further[2] = weight.cwiseProduct(clean).sum();
  further[3] = options.known_noise ? 0.0 : made.noise * weight.diagonal().dot(observations.relative_noise);
  const std::vector<Normal> known = priors(observations, options);
  for (std::size_t k = 0; k < known.size(); ++k) {
    cost += known[k].cost(at[k]);
    gradient[k] += known[k].slope(at[k]);
  }
  return cost;
}

GaussianProcess fitted(const Observations& observations, const FitOptions& options) {
  const int d = observations.inputs.dimension();
  const std::vector<Normal> known = priors(observations, options);
  std::vector<double> start, low, high;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const bool length = k < static_cast<std::size_t>(d);
    start.push_back(known[k].mean);
    low.push_back(length ? std::log(shortest) : known[k].mean - 12.0);
    high.push_back(length ? std::log(longest) : known[k].mean + 12.0);
    start.back() = std::clamp(start.back(), low.back(), high.back());
  }
  const Smooth cost = [&](std::span<const double> at, std::span<double> gradient) {
    return fit_objective(observations, options, at, gradient);
  };
  std::vector<double> best, unused(known.size());
  double least = 0.0;
  for (const double shorter : {0.0, 1.5}) {  // From smooth, and from lengths a fifth of that.
    std::vector<double> from = start;
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) from[k] = std::max(from[k] - shorter, low[k]);
    std::vector<double> found = options.minimiser(cost, from, low, high);
    const double value = cost(found, unused);
    if (best.empty() || value < least) {
      least = value;
      best = std::move(found);
    }
  }
  return {observations, from_logarithms(best, d, options.known_noise)};
}

}  // namespace perfora::model
