// What is here: binning and principal components. What is not: measures of a curve (results/measures.h).
#include "optimize/model/response_curves.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "results/sampled_curve.h"

namespace perfora::model {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double mean_stress(const results::History& curve, double from, double to) {
  return results::integral(results::cut(curve.strain_yy, curve.stress_yy, from, to)) / (to - from);
}

}  // namespace

CurveBasis::CurveBasis(double strain_end, std::span<const results::History* const> curves) {
  edges_.push_back(0.0);
  // A last bin of less than half the width goes with the one before.
  for (int k = 1; k * bin < strain_end - 0.5 * bin; ++k) edges_.push_back(k * bin);
  edges_.push_back(strain_end);
  double sum = 0.0;
  for (const results::History* curve : curves) sum += std::max(0.0, mean_stress(*curve, 0.0, strain_end));
  floor_ = floor_share * sum / static_cast<double>(std::max<std::size_t>(1, curves.size()));
  mean_ = VectorXd::Zero(bins());
  components_.resize(bins(), 0);
}

VectorXd CurveBasis::binned(const results::History& curve) const {
  VectorXd logs(bins());
  for (int k = 0; k < bins(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    logs(k) = std::log(std::max(0.0, mean_stress(curve, edges_[at], edges_[at + 1])) + floor_);
  }
  return logs;
}

void CurveBasis::find_components(const MatrixXd& of_designs) {
  mean_ = of_designs.colwise().mean();
  const MatrixXd off = of_designs.rowwise() - mean_.transpose();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(off.transpose() * off);
  const VectorXd& found = solver.eigenvalues();  // rising
  const double total = std::max(found.sum(), 0.0);
  const int most = std::min({most_components, bins(), static_cast<int>(of_designs.rows()) - 1});
  int count = 0;
  double held = 0.0;
  while (count < most && held < wanted_share * total) held += found(bins() - 1 - count++);
  components_.resize(bins(), count);
  for (int k = 0; k < count; ++k) {
    VectorXd one = solver.eigenvectors().col(bins() - 1 - k);
    if (one.sum() < 0.0) one = -one;  // An eigenvector has no sign of its own.
    components_.col(k) = one;
  }
}

VectorXd CurveBasis::scores(const VectorXd& binned) const {
  return components_.transpose() * (binned - mean_);
}

VectorXd CurveBasis::curve(const VectorXd& scores) const {
  return mean_ + components_ * scores;
}

VectorXd CurveBasis::window(double from, double to) const {
  VectorXd share(bins());
  for (int k = 0; k < bins(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    share(k) = std::max(0.0, std::min(to, edges_[at + 1]) - std::max(from, edges_[at]));
  }
  const double sum = share.sum();
  return sum > 0.0 ? VectorXd(share / sum) : share;
}

}  // namespace perfora::model
