// What is here: what the measures of a curve depend on beside the curve. What is not: the measures (measures.h), wishes
// (target.h).
#pragma once

#include <string>
#include <vector>

#include "io/schema.h"

namespace perfora::results {

/// Where a plateau is measured: in a window of strain, or on the found plateau of each curve.
enum class PlateauPlace { window, found };

/// [measures] of a design.
struct MeasureOptions {
  PlateauPlace plateau = PlateauPlace::window;
  double plateau_start = 0.20, plateau_end = 0.40;  ///< the window, engineering strain
  double smoothing = 0.01;     ///< width of the moving mean behind trough, smallest, largest and found plateau, strain
  double found_band = 0.25;    ///< the found plateau stays within +- this of its mean
  double found_length = 0.10;  ///< and is at least this long, strain
};

/// Adds [measures].
void describe(io::Schema& schema, MeasureOptions& options);
/// Throws io::InputError for an empty window.
void validate(const MeasureOptions& options, const io::Schema& schema);

/// All that turns a history into the measures of its curve.
struct MeasuringFrame {
  MeasureOptions options;
  double reference_area = 0.0;       ///< of the undeformed cell, m2
  double target_stress = 0.0;        ///< Pa, for the distance to a target; 0: none
  std::vector<double> target_curve;  ///< strain, stress, strain, stress, ...: instead of one stress; empty: none
  double floor = 0.05;               ///< of the target: a smaller stress counts as this in the distance
  double cap = 0.0;                  ///< Pa, for the stroke at a cap; 0: none
  double cap_strain = 0.0;           ///< engineering strain, for the largest stress up to it; 0: none

  /// The same text for the same measures of the same history; for comparing, kept with the measures.
  std::string text() const;
};

}  // namespace perfora::results
