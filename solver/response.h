// What is here: what a compression gives, as plain data: history rows, events, summary. What is not: how it is
// computed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace perfora::solver {

enum class RunStatus { completed, stopped, failed };
/// As files and JSON name it: "completed", "stopped", "failed".
const char* status_name(RunStatus status);

/// History of a run: equally long columns, one entry a row; stresses in Pa (compression positive), energies in J per
/// metre of depth. Stresses are means since the last row; all else is at the row.
struct History {
  std::vector<double> strain_yy;  ///< engineering, compression positive
  std::vector<double> strain_yy_log;
  std::vector<double> stress_yy, stress_xx, stress_xy, stress_asymmetry;
  std::vector<double> broken_bonds, fragments, contacts;
  std::vector<double> time;
  std::vector<double> rate;  ///< of the strain, mean since the last row, 1/s; 0 in the first
  std::vector<double> external_work, elastic_bonds, elastic_contacts, kinetic, damage, friction, viscous, cundall;
  /// Normal force over the block's nominal edge; empty without platens or side walls.
  std::vector<double> platen_stress_bottom, platen_stress_top, wall_stress_left, wall_stress_right;

  /// Columns with their names and SI units, in file order (docs/formats.md).
  struct Column {
    const char* name;
    const char* units;
    std::vector<double> History::*values;
    bool optional = false;  ///< left out of files where it is empty
  };
  static const std::vector<Column>& columns();
  std::size_t rows() const { return strain_yy.size(); }
};

enum class BreakMode : std::uint8_t { tension = 0, shear = 1 };

/// One broken bond.
struct BreakEvent {
  double time = 0.0;    ///< s
  double strain = 0.0;  ///< engineering
  std::int32_t bond = 0;
  std::int32_t i = 0, j = 0;
  double x = 0.0, y = 0.0;  ///< midpoint, m
  BreakMode mode = BreakMode::tension;
  double energy = 0.0;  ///< U0 at the break, J/m
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

}  // namespace perfora::solver
