// What is here: hyperparameters of a Gaussian process from its data. What is not: the process (gaussian_process.h), the
// minimiser, which is handed in.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "optimize/model/gaussian_process.h"

namespace perfora::model {

/// A function with its gradient, which it writes to the second span.
using Smooth = std::function<double(std::span<const double>, std::span<double>)>;
/// The point with the lowest value that a local descent from `start` finds within the bounds; deterministic.
using Minimiser = std::function<std::vector<double>(const Smooth&, std::vector<double> start,
                                                    const std::vector<double>& low, const std::vector<double>& high)>;

struct FitOptions {
  Minimiser minimiser;
  /// Variance of a single replicate as the replicates themselves show it, with how many degrees of freedom; pulls the
  /// noise. 0: no design has two.
  double pooled_noise = 0.0;
  int pooled_freedom = 0;
  /// The relative noise is the whole of it: hyperparameter `noise` stays at 1.
  bool known_noise = false;
};

/// The process whose hyperparameters make restricted marginal likelihood x prior largest, best of two descents. Priors
/// on logarithms: lengths normal about sqrt(2) + ln(dimension)/2 with deviation sqrt(3) (Hvarfner, Hellsten, Nardi
/// 2024, for inputs in [0, 1]); family length about 1 and bias about 0.1 with deviation 1; signal about the variance of
/// the values and noise about what the replicates show (a tenth of the variance where none do), with 1 and 0.5 to 1.5.
/// Costs some hundred times n^3 / 3.
GaussianProcess fitted(const Observations& observations, const FitOptions& options);

/// What is made smallest, for tests: minus the logarithm of likelihood x prior at ln(lengths ..., family length, bias,
/// signal, noise), and its gradient.
double fit_objective(const Observations& observations, const FitOptions& options, std::span<const double> at,
                     std::span<double> gradient);

}  // namespace perfora::model
