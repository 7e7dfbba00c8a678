// What is here: how long the cracks of a sample are. What is not: the tests that break it (material_test.h).
#pragma once

#include <vector>

#include "results/break_event.h"

namespace perfora::solver {

/// Length of the cracks across `direction` (0: measured along x, 1: along y) in metres: broken bonds whose midpoints
/// lie within `link` of each other (periodic cell width x height) form a crack; each crack counts with the part of the
/// side that its midpoints occupy, in pieces of `link`; cracks shorter than `shortest` do not count.
double projected_crack_length(const std::vector<results::BreakEvent>& events, double width, double height,
                              int direction, double link, double shortest);

}  // namespace perfora::solver
