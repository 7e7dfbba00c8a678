// What is here: what a few replicates say of the mean of all blocks, and of single blocks. What is not: which numbers
// are asked (verdict.h), means and deviations for tables (statistic.h).
#pragma once

#include <vector>

#include "results/target.h"

namespace perfora::results {

/// Confidence of every interval of a verdict.
inline constexpr double confidence = 0.95;
/// Fewer replicates show nothing: with two, one small difference by chance would pass for certainty.
inline constexpr int fewest_replicates = 3;

struct Interval {
  double low = 0.0, high = 0.0;
};

/// With probability `confidence` it holds the mean of all blocks: Student's t on the values, which assumes that they
/// scatter about normally (docs/user/theory.md, "Verdict"; its coverage is simulated in tests/results). Cut at 0 where no
/// value is below: stresses and ratios have no negative mean. Two values at least.
Interval mean_interval(const std::vector<double>& values);

/// With probability `confidence` it holds at least `fraction` of all single blocks: the normal tolerance interval with
/// Howe's factor (Howe 1969), on the logarithms where all values are positive. Two values at least.
Interval block_interval(const std::vector<double>& values, double fraction);

/// Howe's factor: the two-sided tolerance interval is mean +- factor x standard deviation.
double tolerance_factor(int count, double fraction);

}  // namespace perfora::results
