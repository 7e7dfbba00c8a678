// What is here: mean, standard deviation and Student's interval of a sample. What is not: which results are sampled.
#include "results/statistic.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iterator>
#include <limits>

namespace perfora::results {

Statistic statistic_of(const std::string& name, const std::vector<double>& values) {
  Statistic result;
  result.name = name;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  result.mean = result.standard_deviation = result.confidence_95 = result.minimum = result.maximum = nan;
  std::vector<double> reached;
  std::copy_if(values.begin(), values.end(), std::back_inserter(reached), [](double v) { return std::isfinite(v); });
  result.count = static_cast<int>(reached.size());
  if (reached.empty()) return result;
  const double n = static_cast<double>(reached.size());
  double sum = 0.0;
  for (const double value : reached) sum += value;
  result.mean = sum / n;
  const auto [low, high] = std::minmax_element(reached.begin(), reached.end());
  result.minimum = *low;
  result.maximum = *high;
  if (reached.size() < 2) return result;
  double squares = 0.0;
  for (const double value : reached) squares += (value - result.mean) * (value - result.mean);
  result.standard_deviation = std::sqrt(squares / (n - 1.0));
  const double quantile = boost::math::quantile(boost::math::students_t(n - 1.0), 0.975);
  result.confidence_95 = quantile * result.standard_deviation / std::sqrt(n);
  return result;
}

}  // namespace perfora::results
