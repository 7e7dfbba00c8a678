// What is here: how much of the variation of an answer is due to which variable: Sobol indices. What is not: the
// answer, which is handed in.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace perfora::model {

struct SobolIndices {
  std::vector<double> first;  ///< share of the variance that the variable explains alone
  std::vector<double> total;  ///< with all its interactions
  double mean = 0.0, variance = 0.0;
};

/// Of a function over the unit cube, by (dimension + 2) x `count` evaluations on scrambled Sobol points; a power of two
/// is best. First-order by Saltelli et al. 2010 (Computer Physics Communications 181, table 2, b), total by Jansen 1999
/// (f). Zeros where the function does not vary.
SobolIndices sobol_indices(const std::function<double(std::span<const double>)>& function, int dimension, int count,
                           std::uint64_t seed);

}  // namespace perfora::model
