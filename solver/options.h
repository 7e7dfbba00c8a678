// What is here: every option of the solver as plain structs (SI, metres of depth = 1) and their description to the
// table of keys. What is not: laws (laws.h), anything that is computed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/schema.h"

namespace perfora::solver {

enum class DamageForm { linear_damage, linear_force };
enum class DamageInCompression { none, full };
enum class ThresholdScaling { none, strength, toughness };
enum class NoiseKind { none, perlin, weibull };
/// From Perlin's p to the factor: 1 + Delta p/2, or exp(Delta p/2), which is never zero or less.
enum class NoiseMapping { linear, exponential };
enum class LoadingControl { adaptive, constant };
enum class MassScaling { uniform_step, physical };
/// What Cundall's damping acts on: forces and torques of all discs; forces only; forces and torques of discs that have
/// an intact bond, so that free grains are slowed by contacts only.
enum class CundallScope { all, translation, bonded };
enum class FrameChoice { none, few, all };
inline constexpr int few_frames_a_strain = 20, all_frames_a_strain = 100;  ///< every 5 %, every 1 %
enum class FrameData { few, all };
enum class KernelChoice { reference, openmp };
enum class SimdChoice { automatic, avx512, avx2, portable };
enum class TopBottom { periodic, platens };
enum class Sides { periodic, walls, free };

/// Largest engineering strain a run may have: the vacuum around a block between platens is made for it.
inline constexpr double largest_run_strain = 0.9;

/// [material]: bonds, contacts, density. Defaults are the paper's Table 1.
struct MaterialOptions {
  double horizon = 3.0;                            ///< r_H/<d>
  double normal_stiffness = 2.195e7;               ///< k_n, N/m
  double tangential_stiffness = 8.246e6;           ///< k_t, N/m
  double critical_normal_displacement = 1.529e-6;  ///< delta_n0, m
  double critical_shear_displacement = 7.7996e-6;  ///< delta_t0, m
  double yield_exponent = 4.0;                     ///< alpha
  double rupture_delay = 1.1;                      ///< zeta_max
  DamageForm damage_form = DamageForm::linear_damage;
  DamageInCompression damage_in_compression = DamageInCompression::none;
  double friction_coefficient = 0.4;  ///< mu
  double viscous_rate = 0.9;          ///< beta of contacts
  double density = 2200.0;            ///< kg/m3 of solid discs
  double grade = 1.0;                 ///< factor on both stiffnesses: a run is computed at grade 1 (grade.h)
  double strength = 1.0;              ///< factor on both critical displacements
  ThresholdScaling threshold_scaling = ThresholdScaling::strength;
  double reference_mean_diameter = 0.5044e-3;  ///< the <d> the critical stretches are stated for, m
  double characteristic_length = 0.0;  ///< E G/sigma_t^2 measured at that <d>, m; 0: estimated (estimate.h)
};

/// [noise]: spatial variation of both thresholds.
struct NoiseOptions {
  NoiseKind kind = NoiseKind::none;
  NoiseMapping mapping = NoiseMapping::linear;
  double length = 5.04e-3;  ///< l, m
  double amplitude = 1.8;   ///< Delta
  double deviation = 0.0;   ///< key `std`: when positive, the wanted standard deviation of the factor (of its logarithm
                            ///< in the exponential mapping) instead of `amplitude`
  double weibull_modulus = 4.0;
};

/// [loading]: oedometric compression: dH/dt controlled, or constant.
struct LoadingOptions {
  double until = 0.60;  ///< engineering strain
  LoadingControl control = LoadingControl::adaptive;
  double rate = 0.0;            ///< 1/s, constant; 0: from `transits`
  double transits = 25.0;       ///< wave transits of the block before the first peak
  double impact_ratio = 0.1;    ///< impact stress over the stress carried, behind the first peak
  double least_impact = 0.01;   ///< impact stress that is always allowed there, over the estimated first peak's stress
};

/// [dynamics]
struct DynamicsOptions {
  double cundall_damping = 0.7;
  CundallScope cundall_scope = CundallScope::all;
  MassScaling mass = MassScaling::uniform_step;
  double step_factor = 0.6;  ///< of the critical step
  KernelChoice kernel = KernelChoice::openmp;
  SimdChoice simd = SimdChoice::automatic;  ///< of the vector kernels
};

/// [boundary]: what stands at the edges of the block.
struct BoundaryOptions {
  TopBottom top_bottom = TopBottom::periodic;
  Sides sides = Sides::periodic;
  double platen_friction = 0.4;
  double wall_friction = 0.0;  ///< none: the walled block then differs from the periodic one by its edges only
  double crushed_bottom = 0.0, crushed_top = 0.0;  ///< heights of the ends that are rubble from the start, m
};

/// [output]
struct OutputOptions {
  FrameChoice frames = FrameChoice::few;
  FrameData frame_data = FrameData::few;
  std::vector<double> frame_strains;  ///< explicit list wins over `frames`
  std::filesystem::path curve;        ///< CSV of a measured curve that pictures show beside the run; empty: none
  double history_interval = 5.0e-4;   ///< strain between history rows
  double checkpoint_interval = 60.0;  ///< seconds of wall time between checkpoints
};

/// [test]: what `perfora test` and `perfora calibrate` do with the solid material.
struct TestOptions {
  double size = 0.025;  ///< side of the square periodic sample, m
  bool tension = true, compression = true, shear = true, oedometric = true;
  double past_peak = 1.5;  ///< a test ends at this many times the strain of its peak
};

struct SolverOptions {
  MaterialOptions material;
  NoiseOptions noise;
  LoadingOptions loading;
  DynamicsOptions dynamics;
  BoundaryOptions boundary;
  OutputOptions output;
  TestOptions test;
};

/// Adds [material], [noise], [loading], [dynamics], [boundary], [output], [test]. A noise amplitude that
/// makes a factor <= 0 is caught by validate().
void describe(io::Schema& schema, SolverOptions& options);

/// Checks that reach across keys; throws io::InputError with the origin known to `schema`.
void validate(const SolverOptions& options, const io::Schema& schema);

}  // namespace perfora::solver
