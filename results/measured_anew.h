// What is here: an evaluation for another window or a smaller strain, computed from what a stored one holds. What is
// not: which stored evaluation answers a request (optimize/evaluate/answers.h).
#pragma once

#include <optional>

#include "results/evaluation.h"

namespace perfora::results {

/// What the measures of an evaluation depend on beside its history.
struct MeasuringFrame {
  double plateau_start = 0.0, plateau_end = 0.0;  ///< window, engineering strain
  double until = 0.0;                             ///< strain that the run ends at
  double reference_area = 0.0;                    ///< of the undeformed cell, m2
};

/// The evaluation that a run with this frame would have given, to the last bit (but for `performance`, and the
/// lateral stresses of the last row of the curve), from a
/// completed one of the same path that went at least as far. `stored.curve` must be the full history. Nothing where
/// that does not tell: a history without all columns, one that ends before, or the first peak not known yet at a
/// smaller strain.
std::optional<Evaluation> measured_anew(const Evaluation& stored, const MeasuringFrame& frame);

}  // namespace perfora::results
