// What is here: shortening a history and measuring it again. What is not: the measures (measures.cpp).
#include "results/measured_anew.h"

#include <cmath>

#include "results/measures.h"

namespace perfora::results {
namespace {

/// Everything of the summary that belongs to the end of the run, taken from the last row.
void end_with_last_row(const History& history, Summary& summary) {
  const auto whole = [](const std::vector<double>& column) { return static_cast<std::int64_t>(column.back()); };
  summary.final_strain = history.strain_yy.back();
  summary.reason = reached_text(summary.final_strain);
  summary.steps = whole(history.steps);
  summary.broken_bonds = whole(history.broken_bonds);
  summary.broken_in_tension = whole(history.broken_in_tension);
  summary.broken_in_shear = summary.broken_bonds - summary.broken_in_tension;
  summary.fragments = whole(history.fragments);
  summary.largest_fragment_fraction = history.largest_fragment.back();
  summary.max_overlap_in_run = history.largest_overlap.back();
  summary.energy_residual = energy_residual(history, residual_from_strain);
  summary.stress_asymmetry = history.largest_asymmetry.back() / summary.first_peak_stress;
  measure_rate(history, summary);
}

}  // namespace

std::optional<Evaluation> measured_anew(const Evaluation& stored, const MeasuringFrame& frame, double until) {
  const History& full = stored.curve;
  if (stored.status != RunStatus::completed || !full.is_full()) return {};
  Evaluation evaluation = stored;
  evaluation.curve = full.up_to(until);
  const History& history = evaluation.curve;
  if (history.rows() == 0 || std::abs(history.strain_yy.back() - until) > strain_rounding) return {};
  if (history.rows() < full.rows()) {
    if (!full.knows_ends() || !(history.peak_passed.back() > 0.0)) return {};
    evaluation.curve.stress_yy.back() = history.stress_before.back();  // no run beyond it: half a mean
    end_with_last_row(history, evaluation.summary);
    evaluation.reason = evaluation.summary.reason;
  }
  measure_curve(history, frame, evaluation.summary);
  return evaluation;
}

}  // namespace perfora::results
