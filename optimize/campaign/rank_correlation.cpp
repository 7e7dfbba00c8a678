// What is here: Spearman's coefficient with its interval. What is not: reading tables (sweep_record.h).
#include "optimize/campaign/rank_correlation.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace perfora::optimize {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Pearson's correlation; NaN where one list does not vary.
double linear_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    ab += (a[k] - mean_a) * (b[k] - mean_b);
    aa += (a[k] - mean_a) * (a[k] - mean_a);
    bb += (b[k] - mean_b) * (b[k] - mean_b);
  }
  return aa > 0.0 && bb > 0.0 ? std::clamp(ab / std::sqrt(aa * bb), -1.0, 1.0) : unknown;
}

}  // namespace

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> places(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (std::size_t k = first; k < end; ++k) places[order[k]] = 0.5 * static_cast<double>(first + 1 + end);
    first = end;
  }
  return places;
}

RankCorrelation rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  assert(a.size() == b.size());
  std::vector<double> kept_a, kept_b;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (std::isfinite(a[k]) && std::isfinite(b[k])) {
      kept_a.push_back(a[k]);
      kept_b.push_back(b[k]);
    }
  RankCorrelation result{static_cast<int>(kept_a.size()), unknown, unknown, unknown};
  if (result.count < 3) return result;
  result.coefficient = linear_correlation(ranks(kept_a), ranks(kept_b));
  if (result.count < 4 || !(std::abs(result.coefficient) < 1.0)) return result;
  const double centre = std::atanh(result.coefficient);
  const double deviation = std::sqrt((1.0 + 0.5 * result.coefficient * result.coefficient) / (result.count - 3));
  const double half = boost::math::quantile(boost::math::normal(), 0.975) * deviation;
  result.low = std::tanh(centre - half);
  result.high = std::tanh(centre + half);
  return result;
}

}  // namespace perfora::optimize
