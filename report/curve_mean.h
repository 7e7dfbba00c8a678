// What is here: the mean of replicate curves, smoothed to the level that people compare. What is not: drawing.
#pragma once

#include <vector>

namespace perfora::report {

/// One curve; engineering strain, Pa; equally long.
struct StudyCurve {
  std::vector<double> strain, stress;
};

/// Mean over the replicates, up to the shortest of them, as a running mean over 2 % strain that narrows towards the
/// first peak (below 3 % strain nothing is smoothed: the peak is no spike). Empty without curves.
StudyCurve smoothed_mean(const std::vector<StudyCurve>& curves);

}  // namespace perfora::report
