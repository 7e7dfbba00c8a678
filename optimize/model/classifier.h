// What is here: the probability that a design belongs to a class: that its runs succeed, that it fails by a front. What
// is not: what the classes are (response_model.h).
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "optimize/model/kernel.h"

namespace perfora::model {

/// Logistic regression with a Gaussian process as its argument, by Laplace's approximation (Rasmussen and Williams
/// 2006, algorithms 3.1 and 3.2, the mean of the logistic function by MacKay's formula). Signal and lengths (one for
/// all inputs) are the best of a small grid by the approximate likelihood. With one class alone: Laplace's rule of
/// succession.
class Classifier {
 public:
  /// `members`: whether each row is of the class; one row at least. O(n^3) a Newton step.
  Classifier(Inputs inputs, std::vector<bool> members);
  /// Of the first row of `one`, within (0, 1).
  double probability(const Inputs& one) const;
  double log_likelihood() const { return best_.log_likelihood; }

 private:
  struct Fit {
    Kernel kernel;
    double signal = 1.0;
    Eigen::VectorXd mode, gradient, root_weight;  ///< of the latent function; W^1/2
    /// Of I + W^1/2 K W^1/2. Of nothing before the fit: Eigen leaves the state of an empty one undefined, even to
    /// copies.
    Eigen::LLT<Eigen::MatrixXd> root = Eigen::LLT<Eigen::MatrixXd>(Eigen::MatrixXd(0, 0));
    double log_likelihood = 0.0;
  };
  Fit fit(const Kernel& kernel, double signal) const;

  Inputs inputs_;
  Eigen::VectorXd sign_;  ///< +1: a member, -1: none
  double prior_ = 0.0;    ///< latent mean: the log odds of the share of members
  bool both_ = false;
  Fit best_;
};

}  // namespace perfora::model
