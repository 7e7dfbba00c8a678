// What is here: the loop over the bond ends of a chunk, one disc a lane, in single precision; included once for each
// instruction set. What is not: decisions on damage, which are taken in double precision off this path (laws.h).
//
// Lengths are in units of one step of the record's x: the branch then needs no scaling in x. Stretches are a thousandth
// of a length and must not lose to rounding: |r|^2 comes straight from the fixed-point differences d by the metric H^T
// H; with g a guess of 1/|r|, |r| = g r^2 + g/2 (r^2 - (g r^2)^2) to second order, and l0 is taken off the first term,
// what a float cannot hold of l0 off the second. Seen from its other end a bond gives exactly the opposite force.
#pragma once

#include "solver/kernels/simd.h"
#include "solver/kernels/vector_kernels.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace perfora::solver {
namespace {

struct Group {
  float e0x[lanes], e0y[lanes], l0[lanes];
  std::int32_t neighbour[lanes];
};

/// How many groups ahead the rows are fetched: they stream from the outer caches (docs/developer/performance.md).
constexpr int prefetched_groups = 8;

PERFORA_INLINE Floats half_integer_power_of(Floats base, int twice_exponent) {
  Floats result = (twice_exponent & 1) ? root(base) : splat(1.0f);
  for (int rest = twice_exponent >> 1; rest > 0; rest >>= 1) {
    if (rest & 1) result *= base;
    base *= base;
  }
  return result;
}

template <bool quartic, bool weak>
PERFORA_INLINE void run(BondTask& task) {
  const char* const base = reinterpret_cast<const char*>(task.record);
  const Group* const groups = reinterpret_cast<const Group*>(task.groups);
  const float k_n = task.normal_stiffness, k_t = task.tangential_stiffness, cell_shear = task.cell_shear,
              height = task.height, stretch = task.reference_scale, fraction = task.length_residual_unit,
              twice_g_xy = task.twice_g_xy, g_yy = task.g_yy, g_yy_residual = task.g_yy_residual;
  const float normal_scale = task.normal_scale, shear_scale = task.shear_scale;
  const float half_unit = static_cast<float>(0.5 * task.unit);
  const std::uint16_t* const thresholds = task.threshold;
  const std::int8_t* const length_residuals = task.length_residual;
  const std::uint8_t* const damaged = task.damaged;
  // Keeps 1/|r| of an empty lane, whose neighbour is its own disc, finite; far below the rounding of a real |r|^2.
  const Floats tiny = splat(1e-3f);
  const Floats zero = splat(0.0f);
  Floats virial_xx = zero, virial_xy = zero, virial_yy = zero, twice_torques = zero;
  for (std::int32_t slice = task.slice_begin; slice < task.slice_end; ++slice) {
    const std::int32_t* const disc = task.slice_disc + slice * lanes;
    std::int32_t own_offset[lanes];
    for (int k = 0; k < lanes; ++k)
      own_offset[k] = static_cast<std::int32_t>(sizeof(DiscRecord)) * (disc[k] >= 0 ? disc[k] : disc[0]);
    const Fields own = load_records(base, own_offset);
    Floats force_x = zero, force_y = zero, twice_torque = zero;
    Floats v_xx = zero, v_xy = zero, v_yy = zero;
    for (std::int32_t g = task.slice_first[slice], end = task.slice_first[slice + 1]; g < end; ++g) {
      const Group& group = groups[g];
      const char* const ahead = reinterpret_cast<const char*>(&group + prefetched_groups);
      for (unsigned line = 0; line < sizeof(Group); line += 64) __builtin_prefetch(ahead + line);
      const std::int64_t slot = static_cast<std::int64_t>(g) * lanes;
      __builtin_prefetch(thresholds + slot + prefetched_groups * lanes);
      const Fields other = load_records(base, group.neighbour);
      const Floats dx = __builtin_convertvector(Ints(Unsigned(other.x) - Unsigned(own.x)), Floats),
                   dy = __builtin_convertvector(Ints(Unsigned(other.y) - Unsigned(own.y)), Floats);
      const Floats rx = dx + cell_shear * dy, ry = height * dy;
      const Floats e0x = load(group.e0x), e0y = load(group.e0y), l0 = load(group.l0) * stretch;
      const Floats cosine = own.c * other.c - own.s * other.s;
      const Floats sine = rounded(own.s * other.c) + rounded(own.c * other.s);  // fused, it would depend on the end
      const Floats ex = cosine * e0x - sine * e0y, ey = sine * e0x + cosine * e0y;
      const Floats square = dy * (g_yy * dy + (twice_g_xy * dx + g_yy_residual * dy)) + (dx * dx + tiny);
      const Floats guess = inverse_root(square);
      const Floats length = rounded(guess * square);  // the correction is that of the rounded one
      const Floats correction = 0.5f * guess * (square - length * length);
      const Floats delta_n = (length - l0) + (correction - fraction * load(length_residuals + slot));
      const Floats inverse = guess + guess * (guess * correction);
      const Floats delta_t = ex * ry - ey * rx, along = ex * rx + ey * ry;

      const Floats threshold = load(thresholds + slot);
      const Floats scaled_t = delta_t * (threshold * shear_scale);
      Floats power;
      if constexpr (quartic) {
        const Floats s = scaled_t * scaled_t;
        power = s * s;
      } else {
        power = half_integer_power_of(magnitude(scaled_t), task.twice_alpha);
      }
      const Floats reached = delta_n * (threshold * normal_scale) + power;
      Floats per_length = k_n * delta_n * inverse, shear = k_t * delta_t;
      std::uint32_t off_path = above(reached, yield_watch);
      if (damaged[g] != 0) {
        const Floats damage = load(task.damage + slot), left = 1.0f - damage;
        per_length *= weak ? left : (delta_n > 0.0f ? left : splat(1.0f));
        shear *= left;
        if constexpr (weak) off_path |= above(damage, 0.0f);
      }
      if (__builtin_expect(off_path != 0, 0)) {
        float normals[lanes], shears[lanes], inverses[lanes];  // not the vectors themselves: those stay in registers
        store(normals, per_length);
        store(shears, shear);
        store(inverses, inverse);
        for (; off_path != 0; off_path &= off_path - 1) {
          const int lane = __builtin_ctz(off_path);
          if (disc[lane] < 0 || group.neighbour[lane] == own_offset[lane]) continue;
          const BondEndForce f = task.bond_end(task.context, disc[lane], slot + lane);
          normals[lane] = static_cast<float>(f.normal) * inverses[lane];
          shears[lane] = static_cast<float>(f.shear);
        }
        per_length = load(normals);
        shear = load(shears);
      }
      const Floats gx = per_length * rx - shear * ey, gy = per_length * ry + shear * ex;  // f_n n + f_t t: on i
      force_x += gx;
      force_y += gy;
      twice_torque += shear * along;
      v_xx += gx * rx;
      v_xy += gx * ry;
      v_yy += gy * ry;
    }
    virial_xx += v_xx;
    virial_xy += v_xy;
    virial_yy += v_yy;
    twice_torques += twice_torque;
    float fx[lanes], fy[lanes], torque[lanes];
    store(fx, force_x);
    store(fy, force_y);
    store(torque, twice_torque * half_unit);
    for (int k = 0; k < lanes; ++k) {
      if (disc[k] < 0) break;
      task.fx[disc[k]] = static_cast<double>(fx[k]);
      task.fy[disc[k]] = static_cast<double>(fy[k]);
      task.torque[disc[k]] = static_cast<double>(torque[k]);
    }
  }
  // What tells yx from xy is the moment of the pairs, r x F = f_t (e . r).
  const double xy = static_cast<double>(sum(virial_xy));
  task.virial = {task.unit * static_cast<double>(sum(virial_xx)), task.unit * xy,
                 task.unit * (xy + static_cast<double>(sum(twice_torques))),
                 task.unit * static_cast<double>(sum(virial_yy))};
}

void quartic(BondTask& task) {
  run<true, false>(task);
}
void general(BondTask& task) {
  run<false, false>(task);
}
void quartic_weak(BondTask& task) {
  run<true, true>(task);
}
void general_weak(BondTask& task) {
  run<false, true>(task);
}

}  // namespace
}  // namespace perfora::solver
