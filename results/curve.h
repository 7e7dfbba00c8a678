// What is here: a stress-strain curve as plain data. What is not: the history of a run (history.h), curves in files
// (curve_file.h).
#pragma once

#include <string>
#include <vector>

namespace perfora::results {

/// Engineering strain, Pa, compression positive; equally long.
struct Curve {
  std::vector<double> strain, stress;
  std::string name = {};  ///< of a curve that is shown beside others
};

}  // namespace perfora::results
