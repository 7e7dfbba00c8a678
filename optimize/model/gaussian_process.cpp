// What is here: kriging. What is not: hyperparameters (gaussian_fit.cpp).
#include "optimize/model/gaussian_process.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <set>

namespace perfora::model {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double log_determinant(const Eigen::LLT<MatrixXd>& root) {
  return 2.0 * root.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

Eigen::LLT<MatrixXd> safe_root(MatrixXd covariance) {
  double jitter = 1e-10 * covariance.diagonal().maxCoeff();
  covariance.diagonal().array() += jitter;
  Eigen::LLT<MatrixXd> root(covariance);
  while (root.info() != Eigen::Success) {
    covariance.diagonal().array() += 9.0 * jitter;
    jitter *= 10.0;
    root.compute(covariance);
  }
  return root;
}

std::vector<int> other_fidelities(const Inputs& inputs) {
  const std::set<int> all(inputs.fidelity.begin(), inputs.fidelity.end());
  return {std::next(all.begin()), all.end()};
}

MatrixXd constant_columns(const Inputs& inputs, const std::vector<int>& others) {
  MatrixXd columns = MatrixXd::Zero(inputs.rows(), 1 + static_cast<int>(others.size()));
  for (int i = 0; i < inputs.rows(); ++i) {
    columns(i, 0) = 1.0;
    for (std::size_t k = 0; k < others.size(); ++k)
      if (inputs.fidelity[static_cast<std::size_t>(i)] == others[k]) columns(i, 1 + static_cast<int>(k)) = 1.0;
  }
  return columns;
}

GaussianProcess::GaussianProcess(Observations observations, Hyperparameters hyperparameters)
    : observations_(std::move(observations)),
      hyperparameters_(std::move(hyperparameters)),
      fidelities_(other_fidelities(observations_.inputs)) {
  assert(observations_.inputs.rows() > 0 && observations_.values.allFinite());
  const Inputs& inputs = observations_.inputs;
  MatrixXd covariance = hyperparameters_.signal * hyperparameters_.kernel(inputs, inputs);
  covariance.diagonal() += hyperparameters_.noise * observations_.relative_noise;
  root_ = safe_root(std::move(covariance));
  constants_ = constants_of(inputs);
  solved_ = root_.solve(constants_);
  constants_root_ = safe_root(constants_.transpose() * solved_);
  beta_ = constants_root_.solve(solved_.transpose() * observations_.values);
  const VectorXd rest = observations_.values - constants_ * beta_;
  alpha_ = root_.solve(rest);
  log_likelihood_ = -0.5 * (rest.dot(alpha_) + log_determinant(root_) + log_determinant(constants_root_));
}

MatrixXd GaussianProcess::constants_of(const Inputs& inputs) const {
  return constant_columns(inputs, fidelities_);
}

GaussianProcess::Joint GaussianProcess::together(const Inputs& inputs) const {
  const MatrixXd cross = hyperparameters_.signal * hyperparameters_.kernel(observations_.inputs, inputs);
  const MatrixXd own = hyperparameters_.signal * hyperparameters_.kernel(inputs, inputs);
  const MatrixXd half = root_.matrixL().solve(cross);
  const MatrixXd constants = constants_of(inputs);
  const MatrixXd unknown = constants.transpose() - solved_.transpose() * cross;  // of the constants
  Joint joint;
  joint.mean = constants * beta_ + cross.transpose() * alpha_;
  joint.covariance = own - half.transpose() * half + unknown.transpose() * constants_root_.solve(unknown);
  return joint;
}

Expected GaussianProcess::at(const Inputs& one) const {
  const Joint joint = together(one);
  return {joint.mean(0), std::max(joint.covariance(0, 0), 0.0)};
}

std::vector<LeftOut> GaussianProcess::left_out() const {
  const int n = observations_.inputs.rows();
  const MatrixXd inverse = root_.solve(MatrixXd::Identity(n, n));
  const MatrixXd projected = inverse - solved_ * constants_root_.solve(solved_.transpose());
  const VectorXd weights = projected * observations_.values;
  std::map<int, std::vector<int>> designs;
  for (int i = 0; i < n; ++i) designs[observations_.design[static_cast<std::size_t>(i)]].push_back(i);
  std::vector<LeftOut> found(static_cast<std::size_t>(n));
  for (const auto& [design, rows] : designs) {
    const auto size = static_cast<int>(rows.size());
    MatrixXd block(size, size);
    VectorXd own(size);
    for (int a = 0; a < size; ++a) {
      own(a) = weights(rows[static_cast<std::size_t>(a)]);
      for (int b = 0; b < size; ++b)
        block(a, b) = projected(rows[static_cast<std::size_t>(a)], rows[static_cast<std::size_t>(b)]);
    }
    // Where the rest cannot tell a fidelity's constant, the block has no inverse: the variance is as good as infinite.
    const Eigen::LLT<MatrixXd> root = safe_root(block);
    const VectorXd off = root.solve(own);
    const MatrixXd variance = root.solve(MatrixXd::Identity(size, size));
    for (int a = 0; a < size; ++a) {
      const int row = rows[static_cast<std::size_t>(a)];
      const double value = observations_.values(row);
      found[static_cast<std::size_t>(row)] = {value, value - off(a), variance(a, a)};
    }
  }
  return found;
}

GaussianProcess GaussianProcess::told(const Inputs& one, double value, double relative_noise) const {
  Observations longer = observations_;
  const auto n = longer.values.size();
  longer.inputs.append(one.row(0));
  longer.values.conservativeResize(n + 1);
  longer.relative_noise.conservativeResize(n + 1);
  longer.values(n) = value;
  longer.relative_noise(n) = relative_noise;
  longer.design.push_back(1 + *std::max_element(longer.design.begin(), longer.design.end()));
  return {std::move(longer), hyperparameters_};
}

}  // namespace perfora::model
