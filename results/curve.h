// What is here: a stress-strain curve as plain data. What is not: the history of a run (history.h).
#pragma once

#include <vector>

namespace perfora::results {

/// Engineering strain, Pa; equally long.
struct Curve {
  std::vector<double> strain, stress;
};

}  // namespace perfora::results
