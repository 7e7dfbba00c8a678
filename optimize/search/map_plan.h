// What is here: which designs the map of a study is made of. What is not: running them (driver.h), what they tell
// (map_result.h).
#pragma once

#include <vector>

#include "optimize/search/batch.h"
#include "optimize/search/candidate.h"

namespace perfora::optimize {

struct MapChoice {
  std::vector<BatchPoint> points;  ///< that keep the constraints
  int tried = 0;                   ///< points looked at for them
};

/// The first `designs` points of a scrambled Sobol sequence over all arms together (the first coordinate is the arm)
/// that keep the constraints, each design once; fewer where hardly any does. A function of the study alone: a longer
/// list begins with the shorter one. Nothing is simulated.
MapChoice choose_map(const Study& study, CandidateBook& book, int designs);

}  // namespace perfora::optimize
