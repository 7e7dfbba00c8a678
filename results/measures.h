// What is here: the numbers read from a compression curve. What is not: the run.
#pragma once

#include <string>

#include "results/history.h"
#include "results/measure_options.h"
#include "results/summary.h"

namespace perfora::results {

/// Fills the measures of the curve (measure_table.cpp, docs/user/theory.md, "Measures") from the history: those of the
/// plateau within the frame's window or on the found plateau, and those of the whole curve. What the history does not
/// reach is NaN. first_peak_* and impact_stress_per_rate of `summary` must be set.
void measure_curve(const History& history, const MeasuringFrame& frame, Summary& summary);

/// The ledger is judged from this strain on: before it the work is too small to divide by.
inline constexpr double residual_from_strain = 0.002;

/// Why a completed run ended: "reached strain 0.6".
std::string reached_text(double strain);

/// All energies of a row, J per metre of depth: what the external work went into.
double energy_sum(const History& history, std::size_t row);

/// Largest |external work - sum of all energies| over the rows so far, over the largest work so far; rows before
/// `from_strain` are left out.
double energy_residual(const History& history, double from_strain);

/// Mean of the run, smallest and largest of all rows; NaN without a row after the first.
void measure_rate(const History& history, Summary& summary);

/// Slope of the curve between a quarter and three quarters of the first peak, Pa; NaN when it cannot be fitted.
double loading_modulus(const History& history, double peak_stress, double peak_strain);

}  // namespace perfora::results
