// What is here: the mean of some numbers. What is not: statistics over replicates (results/statistic.h).
#pragma once

#include <numeric>
#include <vector>

namespace perfora::model {

/// Mean of `values`, in their unit; 0 of none.
inline double mean_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace perfora::model
