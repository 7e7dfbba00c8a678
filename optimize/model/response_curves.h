// What is here: stress-strain curves as a few numbers: logarithms of the stress in bins of strain, and their principal
// components. What is not: what is learnt of them (response_model.h).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "results/history.h"

namespace perfora::model {

/// Bins of strain and the principal components of ln(stress + floor) in them over known curves. One basis serves every
/// window and wished curve.
class CurveBasis {
 public:
  static constexpr double bin = 0.02;           ///< width of a bin, engineering strain
  static constexpr double floor_share = 0.02;   ///< of the mean stress of all curves: the floor
  static constexpr double wanted_share = 0.98;  ///< of the variance over designs that the components hold
  static constexpr int most_components = 6;

  CurveBasis() = default;
  /// Bins from 0 to `strain_end`, the last one shorter; `curves` (one or more, of any designs) set the floor.
  CurveBasis(double strain_end, std::span<const results::History* const> curves);
  /// Components of the designs' mean curves (rows: designs, columns: bins): as many as hold wanted_share, at most
  /// most_components and rows - 1.
  void find_components(const Eigen::MatrixXd& of_designs);

  int bins() const { return static_cast<int>(edges_.size()) - 1; }
  int components() const { return static_cast<int>(components_.cols()); }
  double floor() const { return floor_; }  ///< Pa
  const std::vector<double>& edges() const { return edges_; }
  double strain_end() const { return edges_.back(); }

  /// ln(mean stress + floor) in each bin; the curve must reach strain_end.
  Eigen::VectorXd binned(const results::History& curve) const;
  Eigen::VectorXd scores(const Eigen::VectorXd& binned) const;
  /// Logarithms in the bins for these scores.
  Eigen::VectorXd curve(const Eigen::VectorXd& scores) const;
  /// Share of each bin that lies in [from, to], over the length of it: weights of a mean over a window; sum 1.
  Eigen::VectorXd window(double from, double to) const;

 private:
  std::vector<double> edges_;
  double floor_ = 0.0;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd components_;  ///< bins x components, columns of length 1
};

}  // namespace perfora::model
