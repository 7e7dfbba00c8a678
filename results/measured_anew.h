// What is here: an evaluation for another window or a smaller strain, computed from what a stored one holds. What is
// not: which stored evaluation answers a request (optimize/evaluate/answers.h).
#pragma once

#include <optional>

#include "results/evaluation.h"
#include "results/measure_options.h"

namespace perfora::results {

/// The evaluation that a run to `until` (strain) would have given, measured by this frame, to the last bit (but for
/// `performance`, and the lateral stresses of the last row of the curve), from a completed one of the same path that
/// went at least as far. `stored.curve` must be the full history. Nothing where that does not tell: a history without
/// all columns, one that ends before, or the first peak not known yet at a smaller strain.
std::optional<Evaluation> measured_anew(const Evaluation& stored, const MeasuringFrame& frame, double until);

}  // namespace perfora::results
