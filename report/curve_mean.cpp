// What is here: curves of replicates averaged over equal steps of strain.
#include "report/curve_mean.h"

#include <algorithm>

namespace perfora::report {
namespace {

/// Running mean over this much strain: without the spikes of single contacts the level that people compare is left.
constexpr double smoothing_strain = 0.02;
/// Not smoothed up to here: the first peak is no spike.
constexpr double smoothing_start = 0.03;
constexpr std::size_t grid_points = 600;

double value_at(const results::Curve& curve, double strain) {
  const auto after = std::lower_bound(curve.strain.begin(), curve.strain.end(), strain);
  if (after == curve.strain.begin()) return curve.stress.front();
  if (after == curve.strain.end()) return curve.stress.back();
  const auto k = static_cast<std::size_t>(after - curve.strain.begin());
  const double width = curve.strain[k] - curve.strain[k - 1];
  const double fraction = width > 0.0 ? (strain - curve.strain[k - 1]) / width : 1.0;
  return curve.stress[k - 1] + fraction * (curve.stress[k] - curve.stress[k - 1]);
}

}  // namespace

results::Curve smoothed_mean(const std::vector<results::Curve>& curves) {
  results::Curve mean;
  double end = 0.0;
  for (const results::Curve& curve : curves)
    if (!curve.strain.empty()) end = end == 0.0 ? curve.strain.back() : std::min(end, curve.strain.back());
  if (end <= 0.0) return mean;
  std::vector<double> sum = {0.0};
  for (std::size_t k = 0; k < grid_points; ++k) {
    const double strain = end * static_cast<double>(k) / (grid_points - 1);
    double total = 0.0;
    double count = 0.0;
    for (const results::Curve& curve : curves)
      if (!curve.strain.empty()) {
        total += value_at(curve, strain);
        count += 1.0;
      }
    mean.strain.push_back(strain);
    sum.push_back(sum.back() + total / count);
  }
  const double step = end / (grid_points - 1);
  for (std::size_t k = 0; k < grid_points; ++k) {
    const double half = std::clamp(mean.strain[k] - smoothing_start, 0.0, 0.5 * smoothing_strain);
    const std::size_t reach = std::min({static_cast<std::size_t>(half / step), k, grid_points - 1 - k});
    mean.stress.push_back((sum[k + reach + 1] - sum[k - reach]) / static_cast<double>(2 * reach + 1));
  }
  return mean;
}

}  // namespace perfora::report
