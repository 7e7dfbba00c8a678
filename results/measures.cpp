// What is here: integrals and crossings of a sampled curve, piecewise linear between rows.
#include "results/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "results/measure_table.h"

namespace perfora::results {
namespace {

constexpr double nan = not_reached;
constexpr double densification_factor = 1.3;  // ISO 13314: end of the plateau at 1.3 x plateau stress
constexpr double smoothing_width = 0.005;     // docs/user/theory.md: the 0.5 %-smoothed stress
constexpr double rising_fraction = 0.9;       // "only rises": never falls below this share of an earlier stress
constexpr double recovery_fraction = 0.5;     // of the first peak
constexpr double peak_prominence = 0.05;      // of the first peak: what a peak must stand above its surroundings

/// Value of y at x by linear interpolation; x inside the range.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto upper = std::upper_bound(x.begin(), x.end(), at);
  if (upper == x.begin()) return y.front();
  if (upper == x.end()) return y.back();
  const auto k = static_cast<std::size_t>(upper - x.begin());
  const double fraction = (at - x[k - 1]) / (x[k] - x[k - 1]);
  return y[k - 1] + fraction * (y[k] - y[k - 1]);
}

/// The curve between two strains: end points interpolated.
struct Piece {
  std::vector<double> x, y;
};
Piece cut(const std::vector<double>& x, const std::vector<double>& y, double from, double to) {
  Piece p;
  p.x.push_back(from);
  p.y.push_back(interpolate(x, y, from));
  for (std::size_t k = 0; k < x.size(); ++k)
    if (x[k] > from && x[k] < to) {
      p.x.push_back(x[k]);
      p.y.push_back(y[k]);
    }
  p.x.push_back(to);
  p.y.push_back(interpolate(x, y, to));
  return p;
}

double integral(const Piece& p) {
  double sum = 0.0;
  for (std::size_t k = 1; k < p.x.size(); ++k) sum += 0.5 * (p.y[k] + p.y[k - 1]) * (p.x[k] - p.x[k - 1]);
  return sum;
}

/// Integral of |y| exactly for a piecewise linear y.
double absolute_integral(const Piece& p) {
  double sum = 0.0;
  for (std::size_t k = 1; k < p.x.size(); ++k) {
    const double a = p.y[k - 1], b = p.y[k], h = p.x[k] - p.x[k - 1];
    if (a * b >= 0.0) {
      sum += 0.5 * (std::fabs(a) + std::fabs(b)) * h;
    } else {
      sum += 0.5 * h * (a * a + b * b) / (std::fabs(a) + std::fabs(b));
    }
  }
  return sum;
}

std::vector<double> smoothed(const std::vector<double>& x, const std::vector<double>& y, double width) {
  std::vector<double> out(y.size());
  std::size_t low = 0, high = 0;
  double sum = 0.0;
  for (std::size_t k = 0; k < y.size(); ++k) {
    while (high < y.size() && x[high] <= x[k] + 0.5 * width) sum += y[high++];
    while (x[low] < x[k] - 0.5 * width) sum -= y[low++];
    out[k] = sum / static_cast<double>(high - low);
  }
  return out;
}

/// Strain where the stress last crosses `level` upwards; NaN when it never does.
double last_upward_crossing(const std::vector<double>& strain, const std::vector<double>& stress, double level) {
  for (std::size_t k = stress.size(); k-- > 1;)
    if (stress[k - 1] < level && stress[k] >= level)
      return strain[k - 1] + (level - stress[k - 1]) / (stress[k] - stress[k - 1]) * (strain[k] - strain[k - 1]);
  return nan;
}

/// Strain of the largest energy efficiency: absorbed energy over (stress reached x 1), Li et al.'s definition with the
/// running maximum of the stress.
double largest_efficiency_strain(const std::vector<double>& strain, const std::vector<double>& stress) {
  double absorbed = 0.0, best = -1.0, at = nan, largest = 0.0;
  for (std::size_t k = 0; k < strain.size(); ++k) {
    if (k > 0) absorbed += 0.5 * (stress[k] + stress[k - 1]) * (strain[k] - strain[k - 1]);
    largest = std::max(largest, stress[k]);
    if (largest > 0.0 && absorbed / largest > best) {
      best = absorbed / largest;
      at = strain[k];
    }
  }
  return at;
}

/// Strain of the first row from which on `stress` never falls below `rising_share` of what it was; NaN where it never
/// falls, or still does at the end.
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

double energy_residual(const History& history, double from_strain) {
  double largest_work = 0.0, worst = 0.0;
  for (std::size_t k = 0; k < history.rows(); ++k) {
    largest_work = std::max(largest_work, std::fabs(history.external_work[k]));
    const double sum = history.elastic_bonds[k] + history.elastic_contacts[k] + history.kinetic[k] + history.damage[k] +
                       history.friction[k] + history.viscous[k] + history.cundall[k];
    if (history.strain_yy[k] >= from_strain && largest_work > 0.0)
      worst = std::max(worst, std::fabs(history.external_work[k] - sum) / largest_work);
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

}  // namespace

void measure_curve(const History& history, double plateau_start, double plateau_end, double reference_area,
                   Summary& summary) {
  const auto& strain = history.strain_yy;
  const auto& stress = history.stress_yy;
  summary.plateau_start = plateau_start;
  summary.plateau_end = plateau_end;
  reset_curve_measures(summary);
  if (strain.size() < 2) return;
  const double work_end = std::min(plateau_end, strain.back());
  const double work = interpolate(strain, history.external_work, work_end);
  summary.cundall_fraction = work > 0.0 ? interpolate(strain, history.cundall, work_end) / work : nan;

  if (!std::isnan(summary.first_peak_strain) && summary.first_peak_stress > 0.0) {
    double smallest = nan;
    for (std::size_t k = 0; k < strain.size(); ++k)
      if (strain[k] > summary.first_peak_strain && strain[k] <= 2.0 * summary.first_peak_strain + 0.01 &&
          !(stress[k] >= smallest))
        smallest = stress[k];
    summary.stress_drop_ratio = smallest / summary.first_peak_stress;
  }
  const std::vector<double> smooth = smoothed(strain, stress, smoothing_width);
  summary.only_rising_strain = only_rising_from(strain, smooth);
  if (!std::isnan(summary.first_peak_strain) && summary.first_peak_stress > 0.0) {
    // Smoothing carries the first peak half its width on.
    const double behind = summary.first_peak_strain + 0.5 * smoothing_width;
    summary.recovery_strain = recovery_strain(strain, smooth, behind, recovery_fraction * summary.first_peak_stress);
    summary.peaks = peaks_behind(strain, smooth, behind, peak_prominence * summary.first_peak_stress);
    summary.intermediate_peaks = static_cast<double>(summary.peaks.size());
  }
  summary.efficiency_strain = largest_efficiency_strain(strain, stress);

  constexpr double rounding = 1e-9;  // the last row sits at the end of the window up to rounding
  if (strain.back() < plateau_end - rounding) return;
  const Piece window = cut(strain, stress, plateau_start, std::min(plateau_end, strain.back()));
  const double width = plateau_end - plateau_start, total = integral(window);
  summary.plateau_stress = total / width;
  summary.minimum_stress_in_window = *std::min_element(window.y.begin(), window.y.end());
  Piece deviation = window;
  for (double& y : deviation.y) y -= summary.plateau_stress;
  summary.undulation = total != 0.0 ? absolute_integral(deviation) / total : nan;
  const auto change = [&](const std::vector<double>& column) {
    return interpolate(strain, column, plateau_end) - interpolate(strain, column, plateau_start);
  };
  summary.broken_in_window = change(history.broken_bonds);
  const double swept = width * reference_area;
  summary.damage_stress = change(history.damage) / swept;
  summary.friction_stress = change(history.friction) / swept;
  summary.viscous_stress = change(history.viscous) / swept;
  summary.cundall_stress = change(history.cundall) / swept;
  const double duration = change(history.time);
  if (duration > 0.0) summary.impact_stress = summary.impact_stress_per_rate * width / duration;
  if (summary.plateau_stress > 0.0) summary.impact_ratio = summary.impact_stress / summary.plateau_stress;
  summary.energy_absorbed = interpolate(strain, history.external_work, plateau_end) / reference_area;
  summary.densification_strain = last_upward_crossing(strain, stress, densification_factor * summary.plateau_stress);
}

}  // namespace perfora::results
