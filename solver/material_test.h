// What is here: one test of the solid material on a periodic sample: tension, compression, simple shear, oedometric,
// with stress-free sides where the test has them. What is not: which samples and how many
// (optimize/evaluate/material_tests.h), files.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "geometry/packing.h"
#include "io/cancellation.h"
#include "results/break_event.h"
#include "results/material_file.h"
#include "results/status.h"
#include "solver/frame.h"
#include "solver/options.h"

namespace perfora::solver {

/// tension, compression: height at a constant rate, width follows zero lateral stress. shear: the upper side moves
/// sideways, height and width follow zero normal stress. oedometric: compression with the width held.
enum class MaterialTestKind { tension, compression, shear, oedometric };
/// As files and JSON name it.
const char* material_test_name(MaterialTestKind kind);

struct MaterialTestRequest {
  const geometry::Packing* sample = nullptr;  ///< periodic, solid
  SolverOptions options;
  MaterialTestKind kind = MaterialTestKind::tension;
  std::uint64_t noise_seed = 1;
  double mean_diameter = 0.0;     ///< <d>, m: r_H = horizon x this
  io::Cancellation cancellation;  ///< requested: the test stops with status `stopped` and reason "signal"
  /// Called now and then with the fraction of the longest possible test that is done. May be empty.
  std::function<void(double)> progress;
};

/// Result of a test; NaN where a value was not reached.
struct MaterialTestResult {
  MaterialTestKind kind = MaterialTestKind::tension;
  results::RunStatus status = results::RunStatus::completed;
  std::string reason;
  double strength = 0.0;         ///< largest stress, Pa
  double peak_strain = 0.0;      ///< where it was reached
  double modulus = 0.0;          ///< slope between 10 % and 40 % of the strength, Pa: E, E, G, C11
  double lateral_ratio = 0.0;    ///< tension, compression: Poisson's ratio; oedometric: lateral over axial stress
  double fracture_energy = 0.0;  ///< tension: damage dissipation per crack length, J/m2
  double crack_length = 0.0;     ///< tension: m, across the loading
  double energy_residual = 0.0;  ///< largest |external work - all parts| of all rows over the largest work
  std::int64_t steps = 0, broken_bonds = 0, broken_in_tension = 0;
  double rate = 0.0, time_step = 0.0;
  results::MaterialCurve curve;
  results::Frame frame;  ///< the sample at the end
  std::vector<results::BreakEvent> events;
};

/// A test without a peak (up to forty times the estimated yield strain, at most 0.3) has failed, but for the oedometric
/// one, which need not have one. Runs one test: tension and shear until the stress has fallen to a twentieth of the
/// strength (at most to four times the strain of the peak), the others to options.test.past_peak times the strain of
/// the peak. Sequential; several may run side by side in threads. Numerical trouble and a test without a peak are a
/// status. Throws io::InputError when nothing is bonded.
MaterialTestResult run_material_test(const MaterialTestRequest& request);

/// Strain at which a bond of the mean length first yields in its worst direction while the sample deforms affinely,
/// with Voigt's Poisson ratio where the sides are free: what rate and length of a test rest on. Closed form but for the
/// root of the yield function (laws.h).
double estimated_yield_strain(MaterialTestKind kind, const SolverOptions& options, double mean_diameter,
                              double mean_bond_length);

}  // namespace perfora::solver
