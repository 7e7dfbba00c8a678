// What is here: a minimiser for fits, and synthetic designs. What is not: tests.
#pragma once

#include <cmath>

#include "optimize/model/gaussian_fit.h"
#include "optimize/search/nlopt_search.h"

namespace perfora::model {

inline std::vector<double> lbfgs(const Smooth& function, std::vector<double> start, const std::vector<double>& low,
                                 const std::vector<double>& high) {
  return optimize::descend(function, std::move(start), low, high);
}

/// One row a point, one family and fidelity.
inline Inputs plain_inputs(const Eigen::MatrixXd& points) {
  const auto n = static_cast<std::size_t>(points.rows());
  return {points, std::vector<int>(n, 0), std::vector<int>(n, 0)};
}

/// Fixed numbers that look random, normal with deviation 1 (quasi-random).
inline double scatter(int k) {
  return std::sqrt(2.0) * std::sin(12.9898 * (k + 1.0) * (k + 2.0) + 78.233 * k);
}

}  // namespace perfora::model
