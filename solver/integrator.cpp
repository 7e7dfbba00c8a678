// What is here: the kick and the drift, eight discs a vector (GCC vector extensions), compiled for several instruction
// sets. What is not: the order of a step (simulation.cpp).
#include "solver/integrator.h"

#include <cstring>
#include <numbers>

#define PERFORA_INLINE __attribute__((always_inline)) inline
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define PERFORA_CLONES __attribute__((target_clones("arch=skylake-avx512", "avx2", "default")))
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

PERFORA_INLINE Reals damped_all(Reals force, Reals velocity, double c) {
  const Reals power = force * velocity, part = c * force;
  return power > 0.0 ? force - part : (power < 0.0 ? force + part : force);
}

/// Cosine and sine of 2 pi turn/2^64 to single precision: Taylor's series within an eighth of a turn, then the quadrant.
PERFORA_INLINE void float_cosine_sine(Fixed turn, Floats& c, Floats& s) {
  const Unsigned t = __builtin_convertvector(turn >> 32, Unsigned);
  const Unsigned quadrant = (t + (1u << 29)) >> 30;
  constexpr auto radians = static_cast<float>(2.0 * std::numbers::pi * 0x1p-32);
  const Floats a = __builtin_convertvector(Ints(t - (quadrant << 30)), Floats) * radians;
  const Floats b = a * a;
  const Floats sine = a * (1.0f + b * (-1.0f / 6.0f + b * (1.0f / 120.0f + b * (-1.0f / 5040.0f + b / 362880.0f))));
  const Floats cosine =
      1.0f +
      b * (-0.5f + b * (1.0f / 24.0f + b * (-1.0f / 720.0f + b * (1.0f / 40320.0f - b * (1.0f / 3628800.0f)))));
  const Ints odd = Ints(quadrant << 31) >> 31;
  const Ints of_c = (Ints(sine) & odd) | (Ints(cosine) & ~odd), of_s = (Ints(cosine) & odd) | (Ints(sine) & ~odd);
  c = Floats(of_c ^ Ints(((quadrant + 1) & 2) << 30));
  s = Floats(of_s ^ Ints((quadrant & 2) << 30));
}

PERFORA_INLINE void store_records(DiscRecord* to, Ints x, Ints y, Floats c, Floats s, int count) {
  const Ints ci = Ints(c), si = Ints(s);
  if (count < width) {
    for (int k = 0; k < count; ++k) to[k] = {x[k], y[k], c[k], s[k]};
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
    std::memcpy(to + k, &r[k], sizeof(DiscRecord));
    std::memcpy(to + k + 4, reinterpret_cast<const char*>(&r[k]) + sizeof(DiscRecord), sizeof(DiscRecord));
  }
}

struct Lanes {
  Reals cundall{}, speed_squared{};
};

PERFORA_INLINE void move_eight(const KickAndDrift& task, std::int32_t d, int count, Lanes& sums) {
  DiscState& discs = task.discs;
  const double dt = task.dt, c = task.cundall_damping;
  const Reals vx = load<Reals>(&discs.vx[0] + d, count), vy = load<Reals>(&discs.vy[0] + d, count),
              w = load<Reals>(&discs.omega[0] + d, count);
  const Reals fx = load<Reals>(&discs.fx[0] + d, count), fy = load<Reals>(&discs.fy[0] + d, count),
              torque = load<Reals>(&discs.torque[0] + d, count);
  const Reals gx = damped_all(fx, vx, c), gy = damped_all(fy, vy, c), gw = damped_all(torque, w, c);
  const Reals per_mass = load<Reals>(task.inverse_mass + d, count),
              per_inertia = load<Reals>(task.inverse_inertia + d, count);
  const Reals nvx = vx + dt * gx * per_mass, nvy = vy + dt * gy * per_mass, nw = w + dt * gw * per_inertia;
  sums.cundall -= 0.5 * dt * ((gx - fx) * (vx + nvx) + (gy - fy) * (vy + nvy) + (gw - torque) * (w + nw));
  const Reals square = nvx * nvx + nvy * nvy;
  sums.speed_squared = square > sums.speed_squared ? square : sums.speed_squared;
  store(&discs.vx[0] + d, nvx, count);
  store(&discs.vy[0] + d, nvy, count);
  store(&discs.omega[0] + d, nw, count);

  const Reals step_y = nvy * (dt / task.mid.yy);
  const Reals step_x = (nvx * dt - task.mid.xy * step_y) * (1.0 / task.mid.xx);
  const Fixed x = load<Fixed>(&discs.sx_before[0] + d, count) + Fixed(__builtin_convertvector(step_x * 0x1p64, Longs)),
              y = load<Fixed>(&discs.sy_before[0] + d, count) + Fixed(__builtin_convertvector(step_y * 0x1p64, Longs));
  const double half_turn = 0.5 * dt / (2.0 * std::numbers::pi) * 0x1p64;
  const Fixed turn =
      load<Fixed>(&discs.turn_before[0] + d, count) + Fixed(__builtin_convertvector(nw * half_turn, Longs));
  store(&discs.sx[0] + d, x, count);
  store(&discs.sy[0] + d, y, count);
  store(&discs.turn[0] + d, turn, count);

  Floats cosine, sine;
  float_cosine_sine(turn, cosine, sine);
  const int shift = 32 - discs.position_shift;
  store_records(&discs.record[0] + d, __builtin_convertvector(x >> shift, Ints),
                __builtin_convertvector(y >> shift, Ints), cosine, sine, count);
}

PERFORA_CLONES KickSums move_discs(const KickAndDrift& task, std::int32_t begin, std::int32_t end) {
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
  return move_discs(task, begin, end);
}

void DiscState::refresh_record(std::size_t disc) {
  Floats c, s;
  Fixed t{};
  t[0] = turn[disc];
  float_cosine_sine(t, c, s);
  const int shift = 32 - position_shift;
  record[disc] = {static_cast<std::int32_t>(static_cast<std::uint32_t>(sx[disc] >> shift)),
                  static_cast<std::int32_t>(static_cast<std::uint32_t>(sy[disc] >> shift)), c[0], s[0]};
}

}  // namespace perfora::solver
