// What is here: a result over several replicates: mean, deviation, interval, extremes. What is not: which results are
// taken (measure_table.h).
#pragma once

#include <string>
#include <vector>

namespace perfora::results {

/// One result over the replicates in which it was reached.
struct Statistic {
  std::string name;
  int count = 0;
  double mean = 0.0;
  double standard_deviation = 0.0;  ///< of the replicates (n - 1); NaN for fewer than two
  double confidence_95 =
      0.0;  ///< half width of the 95 % confidence interval of the mean (Student's t); NaN for fewer than two
  double minimum = 0.0, maximum = 0.0;
};

/// Mean, deviation, interval, extremes of `values`, NaN left out.
Statistic statistic_of(const std::string& name, const std::vector<double>& values);

}  // namespace perfora::results
