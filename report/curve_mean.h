// What is here: the mean of replicate curves, smoothed to the level that people compare. What is not: drawing.
#pragma once

#include <vector>

#include "results/curve.h"

namespace perfora::report {

/// Mean over the replicates, up to the shortest of them, as a running mean over 2 % strain that narrows towards the
/// first peak (below 3 % strain nothing is smoothed: the peak is no spike). Empty without curves.
results::Curve smoothed_mean(const std::vector<results::Curve>& curves);

}  // namespace perfora::report
