// What is here: what the vector loops over the bonds and the contacts of a chunk read and write, and the loops compiled
// for each instruction set. What is not: the loops (bond_kernel.h, contact_kernel.h), the layouts' making (bond_rows.h,
// contact_rows.h). Plain data only: files compiled for one instruction set must not make inline library code that
// others might get to run.
#pragma once

#include <cstdint>

#include "solver/state.h"

namespace perfora::solver {

/// One bond end off the vector path: exact decision, damage and forces (N/m) of bond `slot` of disc i.
struct BondEndForce {
  double normal = 0.0, shear = 0.0;
};

/// The bonds of a run of discs in rows (BondRows) and everything the loop needs. `lanes` discs make a slice; a group is
/// the k-th bond end of each of them: float e0x[lanes], e0y[lanes], l0[lanes] (in units at the start), then
/// int32 neighbour[lanes] (in bytes of `record`).
struct BondTask {
  const DiscRecord* record;
  const char* groups;
  const std::uint16_t* threshold;      ///< per bond end, 1/(strength zeta(D)) in units of 1/threshold_scale
  const std::int8_t* length_residual;  ///< per bond end, what the float l0 leaves of it
  const float* damage;                 ///< per bond end, read where damaged is set
  const std::uint8_t* damaged;         ///< per group: some end of it has 0 < D < 1
  const std::int32_t* slice_first;     ///< per slice: its first group; one more at the end
  const std::int32_t* slice_disc;      ///< per slice and lane: disc, -1: none
  std::int32_t slice_begin, slice_end;
  double* fx;  ///< per disc, written
  double* fy;
  double* torque;
  double unit;                            ///< of the lengths below: one step of the record's x, m
  float cell_shear, height;               ///< H_xy/H_xx, H_yy/H_xx
  float twice_g_xy, g_yy, g_yy_residual;  ///< H^T H over H_xx^2; what the float g_yy leaves of it
  float length_residual_unit;             ///< of length_residual, times reference_scale
  float reference_scale;  ///< unit at which the rows were laid out over the unit now: 1 while the width is held
  float normal_stiffness, tangential_stiffness;  ///< N/m times unit
  float normal_scale;                            ///< threshold unit times unit over delta_n^0
  float shear_scale;                             ///< threshold unit times unit over delta_t^0
  int twice_alpha;
  Virial virial;  ///< out: sum of the force on i times r over all bond ends here, J/m
  void* context;  ///< for bond_end
  BondEndForce (*bond_end)(void* context, std::int32_t disc, std::int64_t slot);
};

/// A bond that comes this near its yield surface leaves the vector path. The float error of the yield function is
/// below a thousandth unless a strength is below a tenth of the mean; thresholds are rounded to the safe side.
inline constexpr float yield_watch = 0.996f;

/// The near pairs of a run of discs in rows (ContactRows), one disc a lane.
struct ContactTask {
  const DiscRecord* record;
  const DiscMotion* motion;
  const std::int32_t* neighbour;  ///< per end, in bytes of `record`; empty places hold the disc itself
  float* contact_distance;        ///< m; 0: empty
  const float* damping;           ///< c = 2 beta sqrt(k_n m_eff), N s/m2
  float* shear;                   ///< m
  float* viscous_force;           ///< N/m
  const std::uint8_t* active;     ///< per group: some place of it is filled
  const std::int32_t* slice_first;
  const std::int32_t* slice_active;
  const std::int32_t* slice_disc;
  std::int32_t slice_begin, slice_end;
  double* fx;  ///< per disc, added to
  double* fy;
  double* torque;
  float step_xx, step_xy, step_yy;              ///< H over one step of the record, m
  float gradient_xx, gradient_xy, gradient_yy;  ///< L, 1/s
  float normal_stiffness, tangential_stiffness, friction_coefficient, dt;
  Virial virial;  ///< out: sum F_j r over all ends, each pair twice
  double friction, viscous, largest_overlap;
};

/// One instruction set's loops over bonds and contacts. `weak`: damage weakens compression, too (damage_in_compression
/// = full).
struct VectorKernels {
  int lanes;
  const char* name;
  void (*quartic)(BondTask&);  ///< alpha = 4, the paper's
  void (*general)(BondTask&);
  void (*quartic_weak)(BondTask&);
  void (*general_weak)(BondTask&);
  void (*contacts)(ContactTask&);
};
#if defined(PERFORA_X86_KERNELS)
extern const VectorKernels vector_kernels_avx512, vector_kernels_avx2;
#endif
extern const VectorKernels vector_kernels_portable;

}  // namespace perfora::solver
