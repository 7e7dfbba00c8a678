// What is here: how long an evaluation may take before its worker is taken for hung. What is not: the estimate
// (optimize/evaluate/estimate.h), what happens then (executor_children.cpp).
#pragma once

#include "optimize/evaluate/request.h"

namespace perfora::optimize {

/// Limits that follow from estimates, scaled by what finished evaluations really took: 20 times that, and a minute. So
/// generous, since machines are shared and estimates good to a factor of two.
class TimeLimits {
 public:
  /// Of workers with so many threads each.
  explicit TimeLimits(int threads) : threads_(threads) {}
  /// s; 0: there is no estimate of this request, and no limit.
  double of(const Request& request) const;
  /// What one took, s.
  void learn(const Request& request, double seconds);

 private:
  int threads_;
  double slowest_ = 1.0;  ///< largest ratio of time taken to estimate
};

}  // namespace perfora::optimize
