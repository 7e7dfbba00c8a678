// What is here: the loop over the contact ends of a chunk, one disc a lane, in single precision; included once for each
// instruction set. What is not: which pairs are near (neighbour_list.h), the law in double precision (laws.h), which
// this loop follows line by line.
#pragma once

#include "solver/kernels/simd.h"
#include "solver/kernels/vector_kernels.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace perfora::solver {
namespace {

PERFORA_INLINE Floats larger(Floats a, Floats b) {
  return a > b ? a : b;
}

/// An open pair is one whose forces are all zero: what its springs held is then counted as lost by the same lines.
void contacts(ContactTask& task) {
  const char* const places = reinterpret_cast<const char*>(task.record);
  const char* const motions = reinterpret_cast<const char*>(task.motion);
  const float k_n = task.normal_stiffness, k_t = task.tangential_stiffness, mu = task.friction_coefficient,
              dt = task.dt;
  const float per_k_t = k_t > 0.0f ? 1.0f / k_t : 0.0f;
  const Floats zero = splat(0.0f);
  const Floats tiny = splat(1e-20f);  // m^2: keeps 1/|r| of an empty lane finite
  Floats virial_xx = zero, virial_xy = zero, virial_yx = zero, virial_yy = zero;
  Floats friction = zero, viscous = zero, deepest = zero;
  for (std::int32_t slice = task.slice_begin; slice < task.slice_end; ++slice) {
    if (task.slice_active[slice] == 0) continue;
    const std::int32_t* const disc = task.slice_disc + slice * lanes;
    std::int32_t own_offset[lanes];
    for (int k = 0; k < lanes; ++k)
      own_offset[k] = static_cast<std::int32_t>(sizeof(DiscRecord)) * (disc[k] >= 0 ? disc[k] : disc[0]);
    const Fields own = load_records(places, own_offset);
    const Fields own_motion = load_records(motions, own_offset);
    const Floats own_vx = Floats(own_motion.x), own_vy = Floats(own_motion.y), own_omega = own_motion.c,
                 own_radius = own_motion.s;
    Floats force_x = zero, force_y = zero, torque = zero;
    for (std::int32_t g = task.slice_first[slice], end = task.slice_first[slice + 1]; g < end; ++g) {
      if (task.active[g] == 0) continue;
      const std::int64_t slot = static_cast<std::int64_t>(g) * lanes;
      const std::int32_t* const neighbour = task.neighbour + slot;
      const Fields other = load_records(places, neighbour);
      const Fields motion = load_records(motions, neighbour);
      const Floats dx = __builtin_convertvector(Ints(Unsigned(other.x) - Unsigned(own.x)), Floats),
                   dy = __builtin_convertvector(Ints(Unsigned(other.y) - Unsigned(own.y)), Floats);
      const Floats rx = task.step_xx * dx + task.step_xy * dy, ry = task.step_yy * dy;
      const Floats square = rx * rx + (ry * ry + tiny);
      const Floats length = root(square), inverse = 1.0f / length;
      const Floats nx = rx * inverse, ny = ry * inverse;
      const Floats ux = (Floats(motion.x) - own_vx) + (task.gradient_xx * rx + task.gradient_xy * ry),
                   uy = (Floats(motion.y) - own_vy) + task.gradient_yy * ry;
      const Floats v_n = ux * nx + uy * ny;
      const Floats sum_radii = own_radius + motion.s;
      const Floats lever_i = length * (own_radius / sum_radii), lever_j = length - lever_i;
      const Floats v_t = (uy * nx - ux * ny) - (lever_i * own_omega + lever_j * motion.c);

      Floats contact_distance = load(task.contact_distance + slot);
      // After a break a pair touches at l0 until it has once separated; an empty place (touch 0) stays empty.
      contact_distance = (length > sum_radii) & (contact_distance > 0.0f) ? sum_radii : contact_distance;
      store(task.contact_distance + slot, contact_distance);
      const Floats overlap = larger(contact_distance - length, zero);
      const Floats elastic = k_n * overlap;
      const Floats pressed = larger(elastic - load(task.damping + slot) * v_n, zero);
      const Floats normal = overlap > 0.0f ? pressed : zero;
      const Floats viscous_force = normal - elastic;
      const Floats old_viscous = load(task.viscous_force + slot);
      viscous -= (0.5f * dt) * ((old_viscous + viscous_force) * v_n);
      store(task.viscous_force + slot, viscous_force);

      const Floats old_shear = load(task.shear + slot);
      const Floats active = contact_distance > 0.0f ? splat(1.0f) : zero;
      const Floats trial = active * (old_shear + v_t * dt);
      const Floats limit = mu * normal * per_k_t;  // on the spring: one that sticks keeps its length to the last bit
      const Floats new_shear = trial > limit ? limit : (trial < -limit ? -limit : trial);
      const Floats shear = k_t * new_shear;
      friction += 0.5f * ((k_t * old_shear + shear) * (trial - new_shear));
      store(task.shear + slot, new_shear);

      const Floats px = normal * nx + shear * ny, py = normal * ny - shear * nx;  // on j
      force_x -= px;
      force_y -= py;
      torque += lever_i * shear;
      virial_xx += px * rx;
      virial_xy += px * ry;
      virial_yx += py * rx;
      virial_yy += py * ry;
      deepest = larger(overlap, deepest);
    }
    float fx[lanes], fy[lanes], moment[lanes];  // not the vectors themselves: those stay in registers
    store(fx, force_x);
    store(fy, force_y);
    store(moment, torque);
    for (int k = 0; k < lanes; ++k) {
      if (disc[k] < 0) break;
      task.fx[disc[k]] += static_cast<double>(fx[k]);
      task.fy[disc[k]] += static_cast<double>(fy[k]);
      task.torque[disc[k]] += static_cast<double>(moment[k]);
    }
  }
  task.virial = {static_cast<double>(sum(virial_xx)), static_cast<double>(sum(virial_xy)),
                 static_cast<double>(sum(virial_yx)), static_cast<double>(sum(virial_yy))};
  task.friction = static_cast<double>(sum(friction));
  task.viscous = static_cast<double>(sum(viscous));
  float largest = 0.0f;
  for (int k = 0; k < lanes; ++k)
    if (deepest[k] > largest) largest = deepest[k];
  task.largest_overlap = static_cast<double>(largest);
}

}  // namespace
}  // namespace perfora::solver
