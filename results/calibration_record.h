// What is here: what the chart of a calibration shows, as plain data read from its files. What is not: the search
// (optimize/search/), drawing (report/).
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace perfora::results {

struct CalibrationRecord {
  struct Point {
    double rupture_delay = 0.0, shear_ratio = 0.0;  ///< zeta_max, delta_t0/delta_n0
    double strength_ratio = 0.0;                    ///< compressive over tensile, finite
    bool of_chart = false;                          ///< false: tested on the way
  };
  std::vector<Point> points;
  std::optional<double> wanted;  ///< ratio of strengths
  std::optional<double> found;   ///< delta_t0/delta_n0
};

/// Reads the folder of a calibration or its result.json; of one that was killed, the points of its journal. Throws
/// io::InputError.
CalibrationRecord read_calibration_record(const std::filesystem::path& path);

}  // namespace perfora::results
