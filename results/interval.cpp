// What is here: Student's and Howe's intervals. What is not: verdicts.
#include "results/interval.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "results/statistic.h"

namespace perfora::results {

static_assert(confidence == 0.95, "Statistic gives the interval for 95 %");

Interval mean_interval(const std::vector<double>& values) {
  const Statistic of = statistic_of({}, values);
  const double low = of.mean - of.confidence_95;
  const bool negative = std::any_of(values.begin(), values.end(), [](double value) { return value < 0.0; });
  return {negative ? low : std::max(0.0, low), of.mean + of.confidence_95};
}

double tolerance_factor(int count, double fraction) {
  const double n = count;
  const double z = boost::math::quantile(boost::math::normal(), 0.5 * (1.0 + fraction));
  const double chi = boost::math::quantile(boost::math::chi_squared(n - 1.0), 1.0 - confidence);
  return z * std::sqrt((n - 1.0) * (1.0 + 1.0 / n) / chi);
}

Interval block_interval(const std::vector<double>& values, double fraction) {
  const bool positive = std::all_of(values.begin(), values.end(), [](double value) { return value > 0.0; });
  std::vector<double> on = values;
  if (positive)
    for (double& value : on) value = std::log(value);
  const Statistic of = statistic_of({}, on);
  const double half = tolerance_factor(of.count, fraction) * of.standard_deviation;
  Interval interval{of.mean - half, of.mean + half};
  if (positive) interval = {std::exp(interval.low), std::exp(interval.high)};
  return interval;
}

}  // namespace perfora::results
