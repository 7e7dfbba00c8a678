// What is here: how much single blocks of a design scatter, pooled over designs and smooth over them. What is not: the
// response itself (gaussian_process.h).
#pragma once

#include <optional>
#include <vector>

#include "optimize/model/gaussian_fit.h"

namespace perfora::model {

/// Replicates of one design.
struct Spread {
  int count = 0;
  double variance = 0.0;  ///< of single replicates (n - 1); read where count > 1
};

/// Variance of single replicates: a pooled one times a relative one that is smooth over the inputs. The logarithms of
/// the designs' variances, freed of their bias digamma((n - 1)/2) - ln((n - 1)/2), are values of a Gaussian process
/// with the noise trigamma((n - 1)/2) that a sample variance of normal numbers has (stochastic kriging: Ankenman,
/// Nelson, Staum, Operations Research 58, 2010, with the variances modelled apart).
class NoiseModel {
 public:
  /// One spread a row. With fewer than `fewest` designs of two replicates or more, the relative noise is 1 everywhere.
  NoiseModel(const Inputs& inputs, const std::vector<Spread>& spreads, const Minimiser& minimiser);

  double pooled() const { return pooled_; }  ///< 0: no design has two replicates
  int freedom() const { return freedom_; }   ///< its degrees of freedom
  /// Relative noise of a single replicate; 1 on the mean over the designs that it was made from.
  double relative(const Inputs& one) const;

  static constexpr int fewest = 8;

 private:
  double pooled_ = 0.0;
  int freedom_ = 0;
  double level_ = 0.0;  ///< ln of the mean of exp(process)
  std::optional<GaussianProcess> process_;
};

}  // namespace perfora::model
