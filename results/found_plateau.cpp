// What is here: the search over all intervals, with running sums. What is not: smoothing (sampled_curve.h).
#include "results/found_plateau.h"

#include <algorithm>

#include "results/history.h"

namespace perfora::results {
namespace {

/// Sums over an interval that grows by one sample at a time, of the curve that is linear between its samples.
struct GrowingInterval {
  double start = 0.0, end = 0.0;
  double area = 0.0, moment = 0.0;  ///< of y and (x - start) y
  double smallest = 0.0, largest = 0.0;

  GrowingInterval(double x, double y) : start(x), end(x), smallest(y), largest(y) {}

  void add(double x0, double y0, double x1, double y1) {
    const double a = x0 - start, b = x1 - start, width = x1 - x0;
    area += 0.5 * width * (y0 + y1);
    moment += width / 6.0 * (a * y0 + (a + b) * (y0 + y1) + b * y1);
    end = x1;
    smallest = std::min(smallest, y1);
    largest = std::max(largest, y1);
  }
  double length() const { return end - start; }

  bool is_plateau(double band) const {
    const double mean = area / length();
    if (!(mean > 0.0) || smallest < (1.0 - band) * mean || largest > (1.0 + band) * mean) return false;
    const double rise = 6.0 * (moment - 0.5 * length() * area) / (length() * length());  // as in fitted_line()
    const double first = mean - rise, last = mean + rise;
    return first > 0.0 && last >= flattest_fall * first && last <= steepest_rise * first;
  }
};

/// A smoothed curve holds no more than a few tens of numbers over the width of its mean: samples that lie closer are
/// left out, since all pairs of samples are looked at.
constexpr double samples_per_smoothing = 40.0;

struct Samples {
  std::vector<double> strain, stress;
};

Samples thinned(const std::vector<double>& strain, const std::vector<double>& smooth, double smoothing) {
  const double step = smoothing / samples_per_smoothing;
  Samples kept;
  for (std::size_t k = 0; k < strain.size(); ++k) {
    if (!kept.strain.empty() && strain[k] - kept.strain.back() < step) continue;
    kept.strain.push_back(strain[k]);
    kept.stress.push_back(smooth[k]);
  }
  return kept;
}

}  // namespace

std::optional<StrainInterval> found_plateau(const std::vector<double>& all_strains, const std::vector<double>& all,
                                            double from, double to, const MeasureOptions& options) {
  const auto [strain, smooth] = thinned(all_strains, all, options.smoothing);
  const double widest = (1.0 + options.found_band) / (1.0 - options.found_band);
  std::optional<StrainInterval> longest;
  double least = options.found_length - strain_rounding;
  for (std::size_t first = 0; first < strain.size(); ++first) {
    if (strain[first] < from) continue;
    if (to - strain[first] < least) break;
    GrowingInterval interval(strain[first], smooth[first]);
    for (std::size_t k = first + 1; k < strain.size() && strain[k] <= to; ++k) {
      interval.add(strain[k - 1], smooth[k - 1], strain[k], smooth[k]);
      // No longer interval from here can lie within the band.
      if (!(interval.smallest > 0.0) || interval.largest > widest * interval.smallest) break;
      if (interval.length() < least || !interval.is_plateau(options.found_band)) continue;
      longest = StrainInterval{interval.start, interval.end};
      least = interval.length() + strain_rounding;
    }
  }
  return longest;
}

}  // namespace perfora::results
