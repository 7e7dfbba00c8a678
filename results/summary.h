// What is here: the scalar results of a packing and of a run, as plain data. What is not: how they are computed
// (measures.h, solver/run.cpp), their names, units and JSON (measure_table.h, json.h).
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "geometry/perforation.h"
#include "results/status.h"

namespace perfora::results {

/// What `perfora pack` reports, beside what evaluate reports.
struct PackSummary {
  std::int64_t discs = 0, perforations = 0;
  double mean_diameter = 0.0, solid_fraction = 0.0, porosity = 0.0, bonds_per_disc = 0.0;
  geometry::ThinnestWall thinnest_wall;
  double thinnest_wall_discretised = 0.0;
  double max_overlap_ratio = 0.0, coordination_number = 0.0, rattler_fraction = 0.0;
};

/// A maximum of the 0.5 %-smoothed curve.
struct CurvePeak {
  double strain = 0.0;  ///< engineering
  double stress = 0.0;  ///< Pa
};

/// Scalar results of one run; NaN where a value was not reached (written as null).
struct Summary {
  RunStatus status = RunStatus::completed;
  std::string reason;  ///< "reached strain 0.6", "wall time", "signal", "unstable step", ...
  std::int64_t steps = 0;
  double time_step = 0.0;
  double rate = 0.0;                               ///< mean of the run, 1/s
  double smallest_rate = 0.0, largest_rate = 0.0;  ///< of all rows, 1/s
  double final_strain = 0.0;
  double first_peak_stress = 0.0, first_peak_strain = 0.0;
  double stress_drop_ratio =
      0.0;  ///< smallest row stress after the first peak (before twice its strain + 1 %) over the peak
  double plateau_stress = 0.0, plateau_start = 0.0, plateau_end = 0.0;
  double minimum_stress_in_window = 0.0, undulation = 0.0;
  double densification_strain = 0.0, efficiency_strain = 0.0;
  double only_rising_strain = 0.0;  ///< from here on the smoothed stress never falls by more than a tenth
  double recovery_strain = 0.0;     ///< where the smoothed stress, once below half the first peak, reaches that again
  double intermediate_peaks = 0.0;  ///< number of `peaks`; NaN without a first peak
  /// Behind the first peak, at least 5 % of it above the valleys around them (topographic prominence).
  std::vector<CurvePeak> peaks;
  double energy_absorbed = 0.0;  ///< external work per reference area up to the end of the plateau window, J/m3
  double cundall_share =
      0.0;  ///< of the external work up to the end of the plateau window, or of the run when it ends before
  std::int64_t broken_bonds = 0, broken_in_tension = 0, broken_in_shear = 0;
  std::int64_t fragments = 0;
  double largest_fragment_fraction = 0.0;  ///< of the solid area
  double max_overlap_in_run = 0.0;         ///< over <d>
  double energy_residual = 0.0;
  double stress_asymmetry = 0.0;  ///< max |sigma_xy - sigma_yx| over the run over the peak
  // Validity.
  double transits_before_peak = 0.0;
  double kinetic_ratio_at_peak = 0.0;  ///< kinetic over elastic energy
  double step_margin = 0.0;            ///< critical step over the step used
  double noise_mean = 1.0, noise_std = 0.0, noise_min = 1.0, noise_max = 1.0;
};

struct Performance {
  double seconds = 0.0;
  double steps_per_second = 0.0;
  double ns_per_bond_step = 0.0;
  int threads = 1;
  std::string simd;
  double peak_memory = 0.0;  ///< bytes
};

}  // namespace perfora::results
