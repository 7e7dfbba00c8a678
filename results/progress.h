// What is here: how far one piece of work has come, as told to whoever started it. What is not: printing it
// (io/progress.h).
#pragma once

#include <functional>
#include <limits>
#include <string>

namespace perfora::results {

struct Progress {
  double fraction = 0.0;  ///< of the piece of work, 0 to 1; a smaller one than before belongs to the next piece
  std::string text;       ///< for people: "strain 12.30 %, stress 210 kPa, 1,234 steps/s"
  /// Of a compression, engineering strain and Pa; NaN of other work.
  double strain = std::numeric_limits<double>::quiet_NaN();
  double stress = std::numeric_limits<double>::quiet_NaN();
};

using ProgressCallback = std::function<void(const Progress&)>;

}  // namespace perfora::results
