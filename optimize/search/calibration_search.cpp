// What is here: the search for thresholds by replay over known points. What is not: keys and record (calibration.cpp).
#include "optimize/search/calibration_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/files.h"
#include "io/text.h"
#include "solver/mass.h"

namespace perfora::optimize {
namespace {

/// delta_t0/delta_n0 searched (docs/user/theory.md, "Calibration"); the ratio of strengths still grows at the upper
/// end.
constexpr double least_shear_ratio = 1.0, largest_shear_ratio = 32.0;
/// Other zeta_max to try, nearest to the design's first.
constexpr double rupture_delays[] = {1.0, 1.05, 1.1, 1.2, 1.35, 1.5, 2.0, 3.0};
/// The chart.
constexpr double chart_delays[] = {1.0, 1.1, 1.5, 2.0};
constexpr double chart_shear_ratios[] = {1.0, 2.0, 3.5, 6.0, 12.0, 32.0};

class Search {
 public:
  Search(const Calibration& calibration, const CalibrationBasis& basis, const KnownStrengths& known)
      : calibration_(calibration), keys_(calibration.keys), basis_(basis), known_(known) {
    search_.found.normal_stiffness = basis.normal_stiffness;
    search_.found.tangential_stiffness = basis.tangential_stiffness;
  }

  StrengthSearch run() {
    if (scale_thresholds() && fit_strengths() && keys_.chart) make_chart();
    return std::move(search_);
  }

 private:
  /// delta_n0 that all points are tested with: E delta_n0/<l> = wanted tensile strength (an aligned bond of mean
  /// length), as stated for the reference diameter.
  double reference_stretch() const {
    const double factor = solver::threshold_factor(calibration_.start->design().solver.material, basis_.mean_diameter);
    return io::rounded(keys_.tensile_strength / basis_.young_modulus * basis_.mean_bond_length / factor);
  }

  /// One point at reference_stretch(); its tensile strength says how far off that was. The ratio of strengths hangs a
  /// little on the strains reached, so the search is done at the right ones. False: it is not known yet.
  bool scale_thresholds() {
    const solver::MaterialOptions& material = calibration_.start->design().solver.material;
    critical_normal_ = reference_stretch();
    const double ratio = material.critical_shear_displacement / material.critical_normal_displacement;
    const StrengthPoint* point =
        test(std::clamp(ratio, least_shear_ratio, largest_shear_ratio), material.rupture_delay, false);
    if (point == nullptr) return false;
    if (point->tensile.mean > 0.0)
      critical_normal_ = io::rounded(critical_normal_ * keys_.tensile_strength / point->tensile.mean);
    search_.points.clear();  // of other thresholds
    return true;
  }

  /// A point, where it is known; otherwise it is wanted, and nothing comes back.
  const StrengthPoint* test(double shear_ratio, double rupture_delay, bool of_chart) {
    shear_ratio = io::rounded(shear_ratio);
    for (StrengthPoint& point : search_.points)
      if (point.shear_ratio == shear_ratio && point.rupture_delay == rupture_delay) return &point;
    BondParameters p = search_.found;
    p.critical_normal_displacement = critical_normal_;
    p.critical_shear_displacement = shear_ratio * critical_normal_;
    p.rupture_delay = rupture_delay;
    const DesignFile design = design_with(calibration_, p);
    const std::string key = fmt::format("{:08x}", io::crc32(design.schema().to_toml(io::Names::first)));
    const std::optional<SampleStrengths> known = known_(key);
    if (!known) {
      search_.wanted.push_back(
          {key, std::make_shared<const Design>(material_sample(design).design()), shear_ratio, rupture_delay});
      return nullptr;
    }
    search_.points.push_back({shear_ratio, rupture_delay, results::statistic_of("tension", known->tension),
                              results::statistic_of("compression", known->compression), of_chart});
    return &search_.points.back();
  }

  /// The point whose ratio of strengths is the wanted one; the nearest where there is none. False: a point is not known
  /// yet.
  bool fit_strengths() {
    const solver::MaterialOptions& material = calibration_.start->design().solver.material;
    std::vector<double> delays = {material.rupture_delay};
    if (keys_.vary_rupture_delay && keys_.compressive_strength > 0.0) {
      for (const double delay : rupture_delays)
        if (delay != material.rupture_delay) delays.push_back(delay);
      std::stable_sort(delays.begin() + 1, delays.end(), [&](double a, double b) {
        return std::fabs(a - material.rupture_delay) < std::fabs(b - material.rupture_delay);
      });
    }
    if (!(keys_.compressive_strength > 0.0)) {
      const StrengthPoint* only = test(material.critical_shear_displacement / material.critical_normal_displacement,
                                       material.rupture_delay, false);
      if (only == nullptr) return false;
      if (only->tensile.count > 0) return take(*only);
      search_.status = results::RunStatus::failed;
      search_.reason = "no test gave a tensile strength";
      return true;
    }
    const double wanted = keys_.compressive_strength / keys_.tensile_strength;
    StrengthPoint nearest;
    double smallest = std::numeric_limits<double>::infinity(), least = smallest, largest = 0.0;
    for (const double delay : delays) {
      if (!search_ratio(wanted, delay)) return false;
      for (const StrengthPoint& point : search_.points) {
        if (point.of_chart || !std::isfinite(point.ratio())) continue;
        least = std::min(least, point.ratio());
        largest = std::max(largest, point.ratio());
        const double miss = std::fabs(std::log(point.ratio() / wanted));
        if (miss < smallest) {
          smallest = miss;
          nearest = point;
        }
      }
      if (smallest < keys_.tolerance) break;
    }
    if (smallest == std::numeric_limits<double>::infinity()) {
      search_.status = results::RunStatus::failed;
      search_.reason = "no test gave both strengths";
      return true;
    }
    if (wanted < least || wanted > largest)
      search_.not_met.push_back(fmt::format(
          "compressive_strength: a ratio of strengths of {:.3g} is out of reach; {:.3g} to {:.3g} were found for "
          "delta_t0/delta_n0 from {:.3g} to {:.3g} at zeta_max {}{}; another horizon, yield_exponent or noise shifts "
          "this range",
          wanted, least, largest, least_shear_ratio, largest_shear_ratio,
          delays.size() > 1 ? "1 to 3" : fmt::format("{:.3g}", delays.front()),
          keys_.vary_rupture_delay ? "" : " (vary_rupture_delay = true tries others)"));
    return take(nearest);
  }

  /// Secant with a bracket (Illinois) on log ratio over log delta_t0/delta_n0. Leaves its points in search_. False: a
  /// point is not known yet.
  bool search_ratio(double wanted, double delay) {
    double x[2] = {std::log(least_shear_ratio), std::log(largest_shear_ratio)}, f[2];
    for (int k = 0; k < 2; ++k) {
      // An end where a test has no peak is moved inwards.
      constexpr int most_moves = 3;
      for (int move = 0; move <= most_moves; ++move) {
        const StrengthPoint* point = test(std::exp(x[k]), delay, false);
        if (point == nullptr) return false;
        f[k] = std::log(point->ratio() / wanted);
        if (std::isfinite(f[k])) break;
        x[k] = 0.5 * (x[0] + x[1]);
      }
    }
    if (!(f[0] < 0.0 && f[1] > 0.0)) return true;  // no bracket: out of reach at this zeta_max
    int same_side = 0;
    for (int k = 2; k < keys_.maxeval; ++k) {
      double next = (x[0] * f[1] - x[1] * f[0]) / (f[1] - f[0]);
      constexpr double margin = 0.05;  // of the bracket: keeps a noisy secant away from its ends
      next = std::clamp(next, x[0] + margin * (x[1] - x[0]), x[1] - margin * (x[1] - x[0]));
      const StrengthPoint* point = test(std::exp(next), delay, false);
      if (point == nullptr) return false;
      const double miss = std::log(point->ratio() / wanted);
      if (!std::isfinite(miss) || std::fabs(miss) < 0.5 * keys_.tolerance) return true;
      const int side = miss < 0.0 ? 0 : 1;
      x[side] = next;
      f[side] = miss;
      same_side = side == 0 ? std::max(1, same_side + 1) : std::min(-1, same_side - 1);
      if (std::abs(same_side) >= 2) f[1 - side] *= 0.5;
    }
    return true;
  }

  /// delta_n0 by proportion: strengths grow with the thresholds as long as strains are small.
  bool take(const StrengthPoint& point) {
    search_.found.rupture_delay = point.rupture_delay;
    search_.found.critical_normal_displacement =
        io::rounded(critical_normal_ * keys_.tensile_strength / point.tensile.mean);
    search_.found.critical_shear_displacement =
        io::rounded(point.shear_ratio * search_.found.critical_normal_displacement);
    return true;
  }

  /// Its points do not hang on each other.
  void make_chart() {
    for (const double delay : chart_delays)
      for (const double ratio : chart_shear_ratios) test(ratio, delay, true);
  }

  const Calibration& calibration_;
  const CalibrationKeys& keys_;
  const CalibrationBasis& basis_;
  const KnownStrengths& known_;
  double critical_normal_ = 0.0;
  StrengthSearch search_;
};

}  // namespace

StrengthSearch search_strengths(const Calibration& calibration, const CalibrationBasis& basis,
                                const KnownStrengths& known) {
  return Search(calibration, basis, known).run();
}

DesignFile design_with(const Calibration& calibration, const BondParameters& parameters) {
  DesignFile design = calibration.start->clone();
  solver::MaterialOptions& material = design.design().solver.material;
  material.normal_stiffness = parameters.normal_stiffness;
  material.tangential_stiffness = parameters.tangential_stiffness;
  material.critical_normal_displacement = parameters.critical_normal_displacement;
  material.critical_shear_displacement = parameters.critical_shear_displacement;
  material.rupture_delay = parameters.rupture_delay;
  return design;
}

int most_points(const Calibration& calibration) {
  const CalibrationKeys& keys = calibration.keys;
  if (!(keys.compressive_strength > 0.0)) return 1 + chart_points(calibration);
  const int delays = keys.vary_rupture_delay ? 1 + static_cast<int>(std::size(rupture_delays)) : 1;
  return keys.maxeval * delays + chart_points(calibration);
}

int chart_points(const Calibration& calibration) {
  return calibration.keys.chart ? static_cast<int>(std::size(chart_delays) * std::size(chart_shear_ratios)) : 0;
}

}  // namespace perfora::optimize
