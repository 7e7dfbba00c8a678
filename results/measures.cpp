// What is here: the measures of a curve one by one. What is not: integrals and fits (sampled_curve.h), the search for a
// plateau (found_plateau.h).
#include "results/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "results/found_plateau.h"
#include "results/measure_table.h"
#include "results/sampled_curve.h"

namespace perfora::results {
namespace {

constexpr double nan = not_reached;
constexpr double densification_factor = 1.3;  // ISO 13314: end of the plateau at 1.3 x plateau stress
constexpr double smoothing_width = 0.005;     // docs/user/theory.md: the 0.5 %-smoothed stress
constexpr double rising_fraction = 0.9;       // "only rises": never falls below this share of an earlier stress
constexpr double recovery_fraction = 0.5;     // of the first peak
constexpr double peak_prominence = 0.05;      // of the first peak: what a peak must stand above its surroundings

/// Strain from which on the stress stays at or above `level`: 0 where it never was below; NaN where it is below at the
/// end.
double above_for_good(const std::vector<double>& strain, const std::vector<double>& stress, double level) {
  for (std::size_t k = stress.size(); k-- > 0;) {
    if (stress[k] >= level) continue;
    if (k + 1 == stress.size()) return nan;
    return strain[k] + (level - stress[k]) / (stress[k + 1] - stress[k]) * (strain[k + 1] - strain[k]);
  }
  return 0.0;
}

/// Strain of the largest energy efficiency from `from` on: energy absorbed over (stress reached x 1), Li et al.'s
/// definition with the running maximum of the stress.
double largest_efficiency_strain(const std::vector<double>& strain, const std::vector<double>& stress,
                                 double from = 0.0) {
  double absorbed = 0.0, best = -1.0, at = nan, largest = 0.0;
  for (std::size_t k = 0; k < strain.size(); ++k) {
    if (strain[k] < from) continue;
    if (k > 0 && strain[k - 1] >= from) absorbed += 0.5 * (stress[k] + stress[k - 1]) * (strain[k] - strain[k - 1]);
    largest = std::max(largest, stress[k]);
    if (largest > 0.0 && absorbed / largest > best) {
      best = absorbed / largest;
      at = strain[k];
    }
  }
  return at;
}

/// Where the first peak has come down: the smallest smoothed stress within the length of a found plateau behind it.
double foot_of_first_peak(const std::vector<double>& strain, const std::vector<double>& smooth, double behind,
                          double within) {
  double least = std::numeric_limits<double>::infinity(), at = behind;
  for (std::size_t k = 0; k < strain.size() && strain[k] <= behind + within; ++k)
    if (strain[k] >= behind && smooth[k] < least) {
      least = smooth[k];
      at = strain[k];
    }
  return at;
}

/// Strain of the first row from which on `stress` never falls below `rising_fraction` of what it was; NaN where it
/// never falls, or still does at the end.
double only_rising_from(const std::vector<double>& strain, const std::vector<double>& stress) {
  double later = std::numeric_limits<double>::infinity();
  for (std::size_t k = stress.size(); k-- > 0;) {
    later = std::min(later, stress[k]);
    if (stress[k] > 0.0 && later < rising_fraction * stress[k])
      return strain.back() - strain[k + 1] > smoothing_width ? strain[k + 1] : nan;
  }
  return nan;
}

/// First strain at which `stress`, once below `level` after `from`, reaches it again.
double recovery_strain(const std::vector<double>& strain, const std::vector<double>& stress, double from,
                       double level) {
  bool fallen = false;
  for (std::size_t k = 0; k < stress.size(); ++k) {
    if (strain[k] <= from) continue;
    if (fallen && stress[k] >= level) return strain[k];
    fallen = fallen || stress[k] < level;
  }
  return nan;
}

/// Height of the maximum at row k above the higher of the two valleys that part it from higher ground, or from the end
/// of the curve where there is none (topographic prominence).
double prominence(const std::vector<double>& y, std::size_t k) {
  double left = y[k], right = y[k];
  for (std::size_t j = k; j-- > 0 && y[j] <= y[k];) left = std::min(left, y[j]);
  for (std::size_t j = k + 1; j < y.size() && y[j] <= y[k]; ++j) right = std::min(right, y[j]);
  return y[k] - std::max(left, right);
}

/// Maxima of `stress` behind the first peak that stand `height` above their surroundings.
std::vector<CurvePeak> peaks_behind(const std::vector<double>& strain, const std::vector<double>& stress, double from,
                                    double height) {
  std::vector<CurvePeak> peaks;
  for (std::size_t k = 1; k + 1 < stress.size(); ++k)
    if (strain[k] > from && stress[k] > stress[k - 1] && stress[k] >= stress[k + 1] && prominence(stress, k) >= height)
      peaks.push_back({strain[k], stress[k]});
  return peaks;
}

}  // namespace

std::string reached_text(double strain) {
  return fmt::format("reached strain {:.6g}", strain);
}

double energy_sum(const History& history, std::size_t row) {
  return history.elastic_bonds[row] + history.elastic_contacts[row] + history.kinetic[row] + history.damage[row] +
         history.friction[row] + history.viscous[row] + history.cundall[row];
}

double energy_residual(const History& history, double from_strain) {
  double largest_work = 0.0, worst = 0.0;
  for (std::size_t k = 0; k < history.rows(); ++k) {
    largest_work = std::max(largest_work, std::fabs(history.external_work[k]));
    if (history.strain_yy[k] >= from_strain && largest_work > 0.0)
      worst = std::max(worst, std::fabs(history.external_work[k] - energy_sum(history, k)) / largest_work);
  }
  return worst;
}

void measure_rate(const History& history, Summary& summary) {
  summary.rate = summary.smallest_rate = summary.largest_rate = nan;
  if (history.rows() < 2) return;
  const auto [smallest, largest] = std::minmax_element(history.rate.begin() + 1, history.rate.end());
  summary.rate = history.strain_yy.back() / history.time.back();
  summary.smallest_rate = *smallest;
  summary.largest_rate = *largest;
}

double loading_modulus(const History& history, double peak_stress, double peak_strain) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, n = 0.0;
  for (std::size_t k = 0; k < history.rows() && history.strain_yy[k] <= peak_strain; ++k) {
    if (history.stress_yy[k] < 0.25 * peak_stress || history.stress_yy[k] > 0.75 * peak_stress) continue;
    sx += history.strain_yy[k];
    sy += history.stress_yy[k];
    sxx += history.strain_yy[k] * history.strain_yy[k];
    sxy += history.strain_yy[k] * history.stress_yy[k];
    n += 1.0;
  }
  const double spread = n * sxx - sx * sx;
  return n >= 3.0 && spread > 0.0 ? (n * sxy - sx * sy) / spread : nan;
}

namespace {

/// All measures that measure_curve() fills are not reached.
void reset_curve_measures(Summary& summary) {
  for (const Measure& measure : measures()) {
    const bool given = std::string_view(measure.key).starts_with("first_peak_");
    if (measure.group != MeasureGroup::curve || given) continue;
    if (const auto* member = std::get_if<double Summary::*>(&measure.member)) summary.** member = nan;
  }
  summary.peaks.clear();
}

/// From here on the smoothed stress holds nothing of the first peak; the start where there was none.
double behind_first_peak(const Summary& summary, const MeasuringFrame& frame) {
  return std::isnan(summary.first_peak_strain) ? 0.0 : summary.first_peak_strain + 0.5 * frame.options.smoothing;
}

/// Largest stress from the start to `end`, the first peak included.
double largest_stress_until(const History& history, const Summary& summary, double end) {
  double largest = interpolate(history.strain_yy, history.stress_yy, end);
  for (std::size_t k = 0; k < history.rows() && history.strain_yy[k] <= end; ++k)
    largest = std::max(largest, history.stress_yy[k]);
  if (summary.first_peak_strain <= end) largest = std::max(largest, summary.first_peak_stress);
  return largest;
}

/// Root of the mean over the window of ln(stress/target)^2, with the floor under the stress.
double target_distance(const std::vector<double>& strain, const std::vector<double>& smooth,
                       const MeasuringFrame& frame, double start, double end) {
  std::vector<double> at, wanted;
  for (std::size_t k = 0; k + 1 < frame.target_curve.size(); k += 2) {
    at.push_back(frame.target_curve[k]);
    wanted.push_back(frame.target_curve[k + 1]);
  }
  if (wanted.empty() && !(frame.target_stress > 0.0)) return nan;
  CurvePiece window = cut(strain, smooth, start, end);
  for (std::size_t k = 0; k < window.x.size(); ++k) {
    const double target = wanted.empty() ? frame.target_stress : interpolate(at, wanted, window.x[k]);
    const double off = std::log(std::max(window.y[k], frame.floor * target) / target);
    window.y[k] = off * off;
  }
  return std::sqrt(integral(window) / (end - start));
}

/// What is asked of the whole curve, whatever the plateau.
void measure_whole_curve(const History& history, const MeasuringFrame& frame, const std::vector<double>& smooth,
                         Summary& summary) {
  const auto& strain = history.strain_yy;
  const auto& stress = history.stress_yy;
  if (!std::isnan(summary.first_peak_strain) && summary.first_peak_stress > 0.0) {
    double smallest = nan;
    for (std::size_t k = 0; k < strain.size(); ++k)
      if (strain[k] > summary.first_peak_strain && strain[k] <= 2.0 * summary.first_peak_strain + 0.01 &&
          !(stress[k] >= smallest))
        smallest = stress[k];
    summary.stress_drop_ratio = smallest / summary.first_peak_stress;
  }
  const std::vector<double> half_smooth = smoothed(strain, stress, smoothing_width);
  summary.only_rising_strain = only_rising_from(strain, half_smooth);
  if (!std::isnan(summary.first_peak_strain) && summary.first_peak_stress > 0.0) {
    // Smoothing carries the first peak half its width on.
    const double behind = summary.first_peak_strain + 0.5 * smoothing_width;
    summary.recovery_strain =
        recovery_strain(strain, half_smooth, behind, recovery_fraction * summary.first_peak_stress);
    summary.peaks = peaks_behind(strain, half_smooth, behind, peak_prominence * summary.first_peak_stress);
    summary.intermediate_peaks = static_cast<double>(summary.peaks.size());
  }
  summary.efficiency_strain = largest_efficiency_strain(strain, stress);
  const double behind = behind_first_peak(summary, frame);
  // The flank of the peak is neither energy nor stress of what is crushed behind it.
  const bool has_peak = !std::isnan(summary.first_peak_strain);
  const double foot = has_peak ? foot_of_first_peak(strain, smooth, behind, frame.options.found_length) : 0.0;
  summary.densification_onset = largest_efficiency_strain(strain, smooth, foot);
  if (const auto found = found_plateau(strain, smooth, behind, summary.densification_onset, frame.options)) {
    summary.found_plateau_start = found->start;
    summary.found_plateau_end = found->end;
    summary.found_plateau_length = found->end - found->start;
    summary.found_plateau_stress =
        integral(cut(strain, stress, found->start, found->end)) / (found->end - found->start);
  } else {
    summary.found_plateau_length = 0.0;
  }
  if (frame.cap > 0.0) {
    const double above = above_for_good(strain, stress, frame.cap);
    summary.stroke_at_cap = std::isnan(above) ? strain.back() : above;
  }
  if (frame.cap_strain > 0.0 && strain.back() >= frame.cap_strain - strain_rounding)
    summary.stress_until = largest_stress_until(history, summary, frame.cap_strain);
}

/// What is asked of the plateau between two strains that the history holds.
void measure_plateau(const History& history, const MeasuringFrame& frame, const std::vector<double>& smooth,
                     double start, double end, Summary& summary) {
  const auto& strain = history.strain_yy;
  const auto& stress = history.stress_yy;
  const CurvePiece window = cut(strain, stress, start, std::min(end, strain.back()));
  const double width = end - start, total = integral(window);
  summary.plateau_stress = total / width;
  summary.minimum_stress_in_window = *std::min_element(window.y.begin(), window.y.end());
  CurvePiece deviation = window;
  for (double& y : deviation.y) y -= summary.plateau_stress;
  summary.undulation = total != 0.0 ? absolute_integral(deviation) / total : nan;
  const CurvePiece smooth_window = cut(strain, smooth, start, std::min(end, strain.back()));
  const auto [smallest, largest] = std::minmax_element(smooth_window.y.begin(), smooth_window.y.end());
  if (summary.plateau_stress > 0.0) {
    summary.smallest_over_mean = *smallest / summary.plateau_stress;
    summary.largest_over_mean = *largest / summary.plateau_stress;
    summary.cap_ratio = largest_stress_until(history, summary, end) / summary.plateau_stress;
    if (summary.first_peak_stress > 0.0)
      summary.crush_force_efficiency = summary.plateau_stress / summary.first_peak_stress;
  }
  const FittedLine line = fitted_line(window);
  if (line.at_start > 0.0) summary.slope = line.at_end / line.at_start;
  const double behind = behind_first_peak(summary, frame);
  double trough = interpolate(strain, smooth, behind);
  for (std::size_t k = 0; k < strain.size() && strain[k] <= start; ++k)
    if (strain[k] > behind) trough = std::min(trough, smooth[k]);
  summary.trough_stress = trough;
  summary.target_distance = target_distance(strain, smooth, frame, start, std::min(end, strain.back()));
  const auto change = [&](const std::vector<double>& column) {
    return interpolate(strain, column, end) - interpolate(strain, column, start);
  };
  summary.broken_in_window = change(history.broken_bonds);
  const double swept = width * frame.reference_area;
  summary.damage_stress = change(history.damage) / swept;
  summary.friction_stress = change(history.friction) / swept;
  summary.viscous_stress = change(history.viscous) / swept;
  summary.cundall_stress = change(history.cundall) / swept;
  const double duration = change(history.time);
  if (duration > 0.0) summary.impact_stress = summary.impact_stress_per_rate * width / duration;
  if (summary.plateau_stress > 0.0) summary.impact_ratio = summary.impact_stress / summary.plateau_stress;
  summary.energy_absorbed = interpolate(strain, history.external_work, end) / frame.reference_area;
  summary.densification_strain = above_for_good(strain, stress, densification_factor * summary.plateau_stress);
}

}  // namespace

void measure_curve(const History& history, const MeasuringFrame& frame, Summary& summary) {
  const auto& strain = history.strain_yy;
  summary.plateau_start = frame.options.plateau_start;
  summary.plateau_end = frame.options.plateau_end;
  summary.measured = frame.text();
  reset_curve_measures(summary);
  if (strain.size() < 2) return;
  const std::vector<double> smooth = smoothed(strain, history.stress_yy, frame.options.smoothing);
  measure_whole_curve(history, frame, smooth, summary);
  if (frame.options.plateau == PlateauPlace::found) {
    summary.plateau_start = summary.found_plateau_start;
    summary.plateau_end = summary.found_plateau_end;
    if (std::isnan(summary.plateau_end)) return;
  }
  const double end = summary.plateau_end, work_end = std::min(end, strain.back());
  const double work = interpolate(strain, history.external_work, work_end);
  summary.cundall_fraction = work > 0.0 ? interpolate(strain, history.cundall, work_end) / work : nan;
  if (strain.back() < end - strain_rounding) return;
  measure_plateau(history, frame, smooth, summary.plateau_start, end, summary);
}

}  // namespace perfora::results
