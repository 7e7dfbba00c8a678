// What is here: the plateau that a curve has, wherever it lies. What is not: measures over a given window (measures.h).
#pragma once

#include <optional>
#include <vector>

#include "results/measure_options.h"

namespace perfora::results {

/// A plateau's slope, fitted stress at its end over that at its start, lies within these (the same steepness up and
/// down).
inline constexpr double flattest_fall = 0.8, steepest_rise = 1.25;

struct StrainInterval {
  double start = 0.0, end = 0.0;  ///< engineering strain
};

/// The found plateau: the longest interval of samples between `from` and `to` (strain), at least
/// options.found_length long, in which `smooth` stays within +- options.found_band of its mean and the slope of the
/// fitted line lies within flattest_fall to steepest_rise; the first of equally long ones; nothing where there is none.
/// `strain` rises; `smooth` is the stress smoothed over options.smoothing, as long; of samples nearer than a fortieth
/// of that one is taken. Cost: at most the square of the number of samples taken.
std::optional<StrainInterval> found_plateau(const std::vector<double>& strain, const std::vector<double>& smooth,
                                            double from, double to, const MeasureOptions& options);

}  // namespace perfora::results
