// What is here: how alike two lists of numbers order the same things. What is not: where the numbers come from.
#pragma once

#include <vector>

namespace perfora::optimize {

/// Places of `values` in ascending order, from 1; equal values share the mean of their places.
std::vector<double> ranks(const std::vector<double>& values);

/// Spearman's rank correlation with its 95 % confidence interval.
struct RankCorrelation {
  int count = 0;                 ///< pairs of which both are finite
  double coefficient = 0.0;      ///< NaN for fewer than three pairs, or where one list is all ties
  double low = 0.0, high = 0.0;  ///< NaN for fewer than four pairs and where the coefficient is 1 or -1
};

/// Of two lists of the same length; pairs with a NaN are left out. Ties by mean ranks. The interval is that of Fisher's
/// transform with variance (1 + rho^2/2)/(n - 3): Bonett and Wright, Psychometrika 65 (2000) 23-28.
RankCorrelation rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace perfora::optimize
