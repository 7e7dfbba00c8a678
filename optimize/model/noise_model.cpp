// What is here: pooled noise and its smooth variation. What is not: its use (response_model.cpp).
#include "optimize/model/noise_model.h"

#include <algorithm>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>
#include <cmath>

namespace perfora::model {
namespace {

/// A design whose replicates happen to agree is not without noise: of the pooled variance.
constexpr double least_relative = 1e-3;
/// Bounds of the relative noise: the recorded designs' deviations lie within a factor of ten of each other.
constexpr double smallest = 0.02, largest = 50.0;

}  // namespace

NoiseModel::NoiseModel(const Inputs& inputs, const std::vector<Spread>& spreads, const Minimiser& minimiser) {
  double sum = 0.0;
  std::vector<int> rows;
  for (int k = 0; k < inputs.rows(); ++k) {
    const Spread& spread = spreads[static_cast<std::size_t>(k)];
    if (spread.count < 2) continue;
    rows.push_back(k);
    freedom_ += spread.count - 1;
    sum += (spread.count - 1) * spread.variance;
  }
  if (freedom_ > 0) pooled_ = sum / freedom_;
  if (static_cast<int>(rows.size()) < fewest || !(pooled_ > 0.0)) return;
  Observations logs;
  logs.values.resize(static_cast<int>(rows.size()));
  logs.relative_noise.resize(static_cast<int>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Spread& spread = spreads[static_cast<std::size_t>(rows[k])];
    const double half = 0.5 * (spread.count - 1);
    const auto at = static_cast<Eigen::Index>(k);
    logs.inputs.append(inputs.row(rows[k]));
    logs.values(at) =
        std::log(std::max(spread.variance / pooled_, least_relative)) - (boost::math::digamma(half) - std::log(half));
    logs.relative_noise(at) = boost::math::trigamma(half);
    logs.design.push_back(static_cast<int>(k));
  }
  FitOptions options{minimiser, 0.0, 0, true};
  process_ = fitted(logs, options);
  double mean = 0.0;
  for (int k = 0; k < logs.inputs.rows(); ++k) mean += std::exp(process_->at(logs.inputs.row(k)).mean);
  level_ = std::log(mean / logs.inputs.rows());
}

double NoiseModel::relative(const Inputs& one) const {
  if (!process_) return 1.0;
  return std::clamp(std::exp(process_->at(one).mean - level_), smallest, largest);
}

}  // namespace perfora::model
