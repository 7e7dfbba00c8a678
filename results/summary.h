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

/// What a number holds that was not reached (NaN; written as null).
inline constexpr double not_reached = std::numeric_limits<double>::quiet_NaN();

// What a run is warned of beyond (docs/user/theory.md, "Ledger").
inline constexpr double small_overlap = 0.05;        ///< of discs, over <d>: rubble is pressed more than discs can bear
inline constexpr double small_kinetic_ratio = 0.05;  ///< of the elastic energy at the first peak: quasi-static
inline constexpr double small_energy_residual = 0.01;  ///< of the work
/// Impact stress over the plateau, at most, of a plateau that the rate does not carry; a verdict says where it is more.
inline constexpr double honest_impact_ratio = 0.1;

/// What `perfora pack` reports, beside what evaluate reports.
struct PackSummary {
  std::int64_t discs = 0, perforations = 0;
  double mean_diameter = not_reached, solid_fraction = not_reached, porosity = not_reached,
         bonds_per_disc = not_reached;
  geometry::ThinnestWall thinnest_wall;
  double thinnest_wall_discretised = not_reached;
  double wall_ratio = not_reached;  ///< thinnest wall over the characteristic length of the material
  double max_overlap_ratio = not_reached, coordination_number = not_reached, rattler_fraction = not_reached;
};

/// A maximum of the 0.5 %-smoothed curve.
struct CurvePeak {
  double strain = 0.0;  ///< engineering
  double stress = 0.0;  ///< Pa
};

/// Scalar results of one run, SI, engineering strain; what each means stands in the table of measures
/// (measure_table.cpp).
struct Summary {
  RunStatus status = RunStatus::completed;
  std::string reason;  ///< "reached strain 0.6", "wall time", "signal", "unstable step", ...
  std::int64_t steps = 0;
  double time_step = not_reached;
  double rate = not_reached, smallest_rate = not_reached, largest_rate = not_reached;
  double final_strain = 0.0;
  double first_peak_stress = not_reached, first_peak_strain = not_reached;
  double stress_drop_ratio = not_reached;
  std::string measured;                           ///< what the curve was measured by: MeasuringFrame::text()
  double plateau_start = 0.0, plateau_end = 0.0;  ///< the window that the plateau is taken from
  double plateau_stress = not_reached, minimum_stress_in_window = not_reached, undulation = not_reached;
  double smallest_over_mean = not_reached, largest_over_mean = not_reached, slope = not_reached;
  double cap_ratio = not_reached, crush_force_efficiency = not_reached, trough_stress = not_reached;
  double target_distance = not_reached, stroke_at_cap = not_reached, stress_until = not_reached;
  double found_plateau_start = not_reached, found_plateau_end = not_reached, found_plateau_length = not_reached,
         found_plateau_stress = not_reached;
  double densification_strain = not_reached, efficiency_strain = not_reached, densification_onset = not_reached;
  double only_rising_strain = not_reached, recovery_strain = not_reached;
  double intermediate_peaks = not_reached;  ///< number of `peaks`
  /// Behind the first peak, at least 5 % of it above the valleys around them (topographic prominence).
  std::vector<CurvePeak> peaks;
  double energy_absorbed = not_reached, cundall_fraction = not_reached;
  double broken_in_window = not_reached;
  /// Work over the window and its strain, Pa: what went into each, together the plateau stress but for what is stored.
  double damage_stress = not_reached, friction_stress = not_reached, viscous_stress = not_reached,
         cundall_stress = not_reached;
  double impact_stress_per_rate = not_reached;  ///< bulk density x wave speed x height, Pa s
  double impact_stress = not_reached, impact_ratio = not_reached;
  std::int64_t broken_bonds = 0, broken_in_tension = 0, broken_in_shear = 0;
  std::int64_t fragments = 0;
  double largest_fragment_fraction = not_reached;
  double max_overlap_in_run = not_reached, energy_residual = not_reached, stress_asymmetry = not_reached;
  double transits_before_peak = not_reached, kinetic_ratio_at_peak = not_reached, step_margin = not_reached;
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
