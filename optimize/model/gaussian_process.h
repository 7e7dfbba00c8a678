// What is here: a Gaussian process given its hyperparameters: what it expects where, and left-out designs. What is not:
// the choice of hyperparameters (gaussian_fit.h).
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "optimize/model/kernel.h"

namespace perfora::model {

/// One response of several designs.
struct Observations {
  Inputs inputs;
  Eigen::VectorXd values;  ///< means over the replicates, one a row
  /// Variance of each value over that of a single replicate where the noise is of its mean size: w/n with n replicates
  /// and the relative noise w of noise_model.h.
  Eigen::VectorXd relative_noise;
  std::vector<int> design;  ///< which rows are of one design (at several fidelities): left out together
};

struct Hyperparameters {
  Kernel kernel;
  double signal = 1.0;  ///< variance of the response over designs
  double noise = 0.1;   ///< variance of a single replicate where the noise is of its mean size
};

/// What is expected of the mean over blocks of a design: normal.
struct Expected {
  double mean = 0.0;
  double variance = 0.0;  ///< of not knowing the mean; the scatter from block to block is not in it
};

/// What the others say of a row that was left out, against what it was.
struct LeftOut {
  double value = 0.0, mean = 0.0;
  double variance = 0.0;  ///< of the value: its replicates' noise included
};

/// Kriging with an unknown constant, and one more for each fidelity beside the first that has observations: the
/// constants are integrated over a flat prior, so their uncertainty is in every variance. Rasmussen and Williams
/// (2006), sections 2.2 and 2.7. O(n^3) to make, O(n^2) a question; sequential, so the bits depend on the input alone.
class GaussianProcess {
 public:
  /// At least one observation; values finite.
  GaussianProcess(Observations observations, Hyperparameters hyperparameters);

  Expected at(const Inputs& one) const;  ///< of its first row
  /// All rows, with what they have in common: n x n.
  struct Joint {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
  };
  Joint together(const Inputs& inputs) const;
  /// Every row in turn, with all rows of its design left out; hyperparameters stay (section 5.4.2, by groups).
  std::vector<LeftOut> left_out() const;
  /// The same process told of one more value with this relative noise; hyperparameters stay.
  GaussianProcess told(const Inputs& one, double value, double relative_noise) const;

  /// Logarithm of the restricted marginal likelihood (constants integrated), up to a constant.
  double log_likelihood() const { return log_likelihood_; }
  const Observations& observations() const { return observations_; }
  const Hyperparameters& hyperparameters() const { return hyperparameters_; }

 private:
  Eigen::MatrixXd constants_of(const Inputs& inputs) const;
  Observations observations_;
  Hyperparameters hyperparameters_;
  std::vector<int> fidelities_;  ///< those with a constant of their own
  // Eigen leaves the state of an empty one undefined, even to copies.
  Eigen::LLT<Eigen::MatrixXd> root_ = Eigen::LLT<Eigen::MatrixXd>(Eigen::MatrixXd(0, 0));
  Eigen::MatrixXd constants_;  ///< n x constants
  Eigen::MatrixXd solved_;     ///< K^-1 constants
  Eigen::LLT<Eigen::MatrixXd> constants_root_ =
      Eigen::LLT<Eigen::MatrixXd>(Eigen::MatrixXd(0, 0));  ///< of constants' K^-1 constants
  Eigen::VectorXd beta_, alpha_;
  double log_likelihood_ = 0.0;
};

/// Fidelities beside the first observed one: each has a constant of its own.
std::vector<int> other_fidelities(const Inputs& inputs);
/// A column of ones and one for each of `others`, 1 where a row is of it.
Eigen::MatrixXd constant_columns(const Inputs& inputs, const std::vector<int>& others);

/// Cholesky's root of signal x (kernel with itself) + noise x relative noise, with as little more on the diagonal
/// (beginning at 1e-10 of the largest entry) as makes it positive definite.
Eigen::LLT<Eigen::MatrixXd> safe_root(Eigen::MatrixXd covariance);

}  // namespace perfora::model
