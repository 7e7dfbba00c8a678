// What is here: the kick and the drift, eight discs a vector (GCC vector extensions), compiled for several instruction
// sets. What is not: the order of a step (simulation.cpp).
#include "solver/integrator.h"

#include <cstring>
#include <numbers>

#define PERFORA_INLINE __attribute__((always_inline)) inline
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define PERFORA_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define PERFORA_CLONES
#endif

namespace perfora::solver {
namespace {

constexpr int width = 8;
using Reals = double __attribute__((vector_size(width * 8)));
using Longs = std::int64_t __attribute__((vector_size(width * 8)));
using Fixed = std::uint64_t __attribute__((vector_size(width * 8)));
using Floats = float __attribute__((vector_size(width * 4)));
using Ints = std::int32_t __attribute__((vector_size(width * 4)));
using Unsigned = std::uint32_t __attribute__((vector_size(width * 4)));

template <class Vector, class Scalar>
PERFORA_INLINE Vector load(const Scalar* from, int count) {
  Vector v{};
  std::memcpy(&v, from, static_cast<std::size_t>(count) * sizeof *from);
  return v;
}
template <class Vector, class Scalar>
PERFORA_INLINE void store(Scalar* to, const Vector& v, int count) {
  std::memcpy(to, &v, static_cast<std::size_t>(count) * sizeof *to);
}

PERFORA_INLINE Reals damped_all(Reals force, Reals velocity, Reals c) {
  const Reals power = force * velocity, part = c * force;
  return power > 0.0 ? force - part : (power < 0.0 ? force + part : force);
}

/// Nearest integer of |v| < 2^51 by the addition that pushes the fraction out: every instruction set has that, few have
/// a conversion to 64 bits.
PERFORA_INLINE Longs nearest(Reals v, Reals& rounded) {
  const double magic = 6755399441055744.0;  // 1.5 x 2^52
  const Reals pushed = v + magic;
  rounded = pushed - magic;
  return Longs(pushed) - Longs(Reals{} + magic);
}

/// A fraction of the period as 64-bit fixed point, in two halves.
PERFORA_INLINE Fixed fixed_fraction(Reals fraction) {
  const Reals coarse = fraction * 0x1p32;
  Reals whole, ignored;
  const Longs high = nearest(coarse, whole);
  const Longs low = nearest((coarse - whole) * 0x1p32, ignored);
  return (Fixed(high) << 32) + Fixed(low);
}

/// Cosine and sine of 2 pi turn/2^64 to single precision: Taylor's series within an eighth of a turn, then the
/// quadrant.
PERFORA_INLINE void float_cosine_sine(Fixed half_angle, Floats& c, Floats& s) {
  const Unsigned t = __builtin_convertvector(half_angle >> 32, Unsigned);
  const Unsigned quadrant = (t + (1u << 29)) >> 30;
  constexpr auto radians = static_cast<float>(2.0 * std::numbers::pi * 0x1p-32);
  const Floats a = __builtin_convertvector(Ints(t - (quadrant << 30)), Floats) * radians;
  const Floats b = a * a;
  const Floats sine = a * (1.0f + b * (-1.0f / 6.0f + b * (1.0f / 120.0f + b * (-1.0f / 5040.0f + b / 362880.0f))));
  const Floats cosine =
      1.0f + b * (-0.5f + b * (1.0f / 24.0f + b * (-1.0f / 720.0f + b * (1.0f / 40320.0f - b * (1.0f / 3628800.0f)))));
  const Ints odd = Ints(quadrant << 31) >> 31;
  const Ints of_c = (Ints(sine) & odd) | (Ints(cosine) & ~odd), of_s = (Ints(cosine) & odd) | (Ints(sine) & ~odd);
  c = Floats(of_c ^ Ints(((quadrant + 1) & 2) << 30));
  s = Floats(of_s ^ Ints((quadrant & 2) << 30));
}

/// Records of four 32-bit fields each from vectors of the fields.
template <class Record>
PERFORA_INLINE void store_records(Record* to, Ints x, Ints y, Ints ci, Ints si, int count) {
  static_assert(sizeof(Record) == 16);
  if (count < width) {
    for (int k = 0; k < count; ++k) {
      const std::int32_t fields[4] = {x[k], y[k], ci[k], si[k]};
      std::memcpy(static_cast<void*>(to + k), fields, sizeof fields);
    }
    return;
  }
  const Ints xy_low = __builtin_shufflevector(x, y, 0, 8, 1, 9, 4, 12, 5, 13),
             xy_high = __builtin_shufflevector(x, y, 2, 10, 3, 11, 6, 14, 7, 15),
             cs_low = __builtin_shufflevector(ci, si, 0, 8, 1, 9, 4, 12, 5, 13),
             cs_high = __builtin_shufflevector(ci, si, 2, 10, 3, 11, 6, 14, 7, 15);
  const Ints r[4] = {__builtin_shufflevector(xy_low, cs_low, 0, 1, 8, 9, 4, 5, 12, 13),
                     __builtin_shufflevector(xy_low, cs_low, 2, 3, 10, 11, 6, 7, 14, 15),
                     __builtin_shufflevector(xy_high, cs_high, 0, 1, 8, 9, 4, 5, 12, 13),
                     __builtin_shufflevector(xy_high, cs_high, 2, 3, 10, 11, 6, 7, 14, 15)};
  for (int k = 0; k < 4; ++k) {
    std::memcpy(static_cast<void*>(to + k), &r[k], sizeof(Record));
    std::memcpy(static_cast<void*>(to + k + 4), reinterpret_cast<const char*>(&r[k]) + sizeof(Record), sizeof(Record));
  }
}

/// Where everything lies: plain pointers, because functions compiled for one instruction set do not inline those of
/// std::vector.
struct Arrays {
  double *vx, *vy, *omega;
  const double *fx, *fy, *torque, *inverse_mass, *inverse_inertia;
  std::uint64_t *sx, *sy, *half_angle;
  const std::uint64_t *sx_before, *sy_before, *half_angle_before;
  DiscRecord* record;
  DiscMotion* motion;
  const double* radius;
  int position_shift;
  double dt;
  const double* damping;
  double rotation_ratio;
  CellMatrix mid;
};

struct Lanes {
  Reals cundall{}, speed_squared{};
};

PERFORA_INLINE void move_eight(const Arrays& task, std::int32_t d, int count, Lanes& sums) {
  const double dt = task.dt;
  // All loads before all stores: the arrays lie a multiple of 4096 bytes apart, and a load behind a store of the same
  // low address bits would wait for it.
  const Reals vx = load<Reals>(task.vx + d, count), vy = load<Reals>(task.vy + d, count),
              w = load<Reals>(task.omega + d, count);
  const Reals fx = load<Reals>(task.fx + d, count), fy = load<Reals>(task.fy + d, count),
              torque = load<Reals>(task.torque + d, count);
  const Reals per_mass = load<Reals>(task.inverse_mass + d, count),
              per_inertia = load<Reals>(task.inverse_inertia + d, count), c = load<Reals>(task.damping + d, count);
  const Fixed old_x = load<Fixed>(task.sx_before + d, count), old_y = load<Fixed>(task.sy_before + d, count),
              old_half_angle = load<Fixed>(task.half_angle_before + d, count);

  const Reals gx = damped_all(fx, vx, c), gy = damped_all(fy, vy, c),
              gw = damped_all(torque, w, task.rotation_ratio * c);
  const Reals nvx = vx + dt * gx * per_mass, nvy = vy + dt * gy * per_mass, nw = w + dt * gw * per_inertia;
  sums.cundall -= 0.5 * dt * ((gx - fx) * (vx + nvx) + (gy - fy) * (vy + nvy) + (gw - torque) * (w + nw));
  const Reals square = nvx * nvx + nvy * nvy;
  sums.speed_squared = square > sums.speed_squared ? square : sums.speed_squared;

  const Reals step_y = nvy * (dt / task.mid.yy);
  const Reals step_x = (nvx * dt - task.mid.xy * step_y) * (1.0 / task.mid.xx);
  const Fixed x = old_x + fixed_fraction(step_x), y = old_y + fixed_fraction(step_y),
              half_angle = old_half_angle + fixed_fraction(nw * (0.5 * dt / (2.0 * std::numbers::pi)));
  store(task.vx + d, nvx, count);
  store(task.vy + d, nvy, count);
  store(task.omega + d, nw, count);
  store(task.sx + d, x, count);
  store(task.sy + d, y, count);
  store(task.half_angle + d, half_angle, count);

  Floats cosine, sine;
  float_cosine_sine(half_angle, cosine, sine);
  const int shift = 32 - task.position_shift;
  store_records(task.record + d, __builtin_convertvector(x >> shift, Ints), __builtin_convertvector(y >> shift, Ints),
                Ints(cosine), Ints(sine), count);
  const Floats mx = __builtin_convertvector(nvx, Floats), my = __builtin_convertvector(nvy, Floats),
               mw = __builtin_convertvector(nw, Floats),
               radius = __builtin_convertvector(load<Reals>(task.radius + d, count), Floats);
  store_records(task.motion + d, Ints(mx), Ints(my), Ints(mw), Ints(radius), count);
}

PERFORA_CLONES KickSums move_discs(const Arrays& task, std::int32_t begin, std::int32_t end) {
  Lanes lanes;
  std::int32_t d = begin;
  for (; d + width <= end; d += width) move_eight(task, d, width, lanes);
  if (d < end) move_eight(task, d, end - d, lanes);
  KickSums sums;
  for (int k = 0; k < width; ++k) {
    sums.cundall += lanes.cundall[k];
    if (lanes.speed_squared[k] > sums.speed_squared) sums.speed_squared = lanes.speed_squared[k];
  }
  return sums;
}

}  // namespace

KickSums kick_and_drift(const KickAndDrift& task, std::int32_t begin, std::int32_t end) {
  DiscState& d = task.discs;
  const Arrays arrays{d.vx.data(),
                      d.vy.data(),
                      d.omega.data(),
                      d.fx.data(),
                      d.fy.data(),
                      d.torque.data(),
                      task.inverse_mass,
                      task.inverse_inertia,
                      d.sx.data(),
                      d.sy.data(),
                      d.half_angle.data(),
                      d.sx_before.data(),
                      d.sy_before.data(),
                      d.half_angle_before.data(),
                      d.record.data(),
                      d.motion.data(),
                      d.radius.data(),
                      d.position_shift,
                      task.dt,
                      task.damping,
                      task.rotation_ratio,
                      task.mid};
  return move_discs(arrays, begin, end);
}

void DiscState::refresh_record(std::size_t disc) {
  Floats c, s;
  Fixed t{};
  t[0] = half_angle[disc];
  float_cosine_sine(t, c, s);
  const int shift = 32 - position_shift;
  record[disc] = {static_cast<std::int32_t>(static_cast<std::uint32_t>(sx[disc] >> shift)),
                  static_cast<std::int32_t>(static_cast<std::uint32_t>(sy[disc] >> shift)), c[0], s[0]};
  motion[disc] = {static_cast<float>(vx[disc]), static_cast<float>(vy[disc]), static_cast<float>(omega[disc]),
                  static_cast<float>(radius[disc])};
}

}  // namespace perfora::solver
