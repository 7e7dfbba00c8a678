// What is here: the numbers read from a compression curve. What is not: the run.
#pragma once

#include <string>

#include "results/history.h"
#include "results/summary.h"

namespace perfora::results {

/// Fills plateau_stress, minimum_stress_in_window, undulation, densification and efficiency strain, only_rising_strain,
/// recovery_strain, the peaks, stress_drop_ratio, energies and impact stress of `summary` from the history
/// (docs/user/theory.md, "Measures"; ISO 13314 and DIN 50134 for the window and the 1.3 x plateau end). What the
/// history does not reach is NaN. first_peak_* and impact_stress_per_rate must be set. `reference_area`: of the
/// undeformed cell, m2.
void measure_curve(const History& history, double plateau_start, double plateau_end, double reference_area,
                   Summary& summary);

/// The ledger is judged from this strain on: before it the work is too small to divide by.
inline constexpr double residual_from_strain = 0.002;

/// Why a completed run ended: "reached strain 0.6".
std::string reached_text(double strain);

/// Largest |external work - sum of all energies| over the rows so far, over the largest work so far; rows before
/// `from_strain` are left out.
double energy_residual(const History& history, double from_strain);

/// Mean of the run, smallest and largest of all rows; NaN without a row after the first.
void measure_rate(const History& history, Summary& summary);

/// Slope of the curve between a quarter and three quarters of the first peak, Pa; NaN when it cannot be fitted.
double loading_modulus(const History& history, double peak_stress, double peak_strain);

}  // namespace perfora::results
