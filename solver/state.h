// What is here: the state of all discs as structure of arrays, the compact record the force loops read, sums of one
// step. What is not: bonds (bond_network.h), near pairs (neighbour_list.h), the step (simulation.h).
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace perfora::solver {

/// What a neighbour needs of a disc in one 16-byte load: position in fixed point of the cell, or of a power-of-two part
/// of it (DiscState::position_shift), and cosine and sine of half its angle. The difference of two positions wraps by
/// itself and is exact; float positions could not hold the critical stretch.
struct alignas(16) DiscRecord {
  std::int32_t x, y;
  float c, s;
};

/// What a contact needs of a disc besides: fluctuating velocity (m/s), spin (rad/s), radius (m).
struct alignas(16) DiscMotion {
  float vx, vy, omega, radius;
};

/// All discs. Reduced positions are 64-bit fixed point of the cell: differences wrap by themselves (minimum image) and
/// sums do not round. Half angles are fixed point of the full turn in the same way. Velocities are fluctuations v' =
/// dx/dt - L x, held at half steps (leapfrog form of velocity Verlet).
struct DiscState {
  std::vector<std::uint64_t> sx, sy;      ///< reduced position at the end of the last drift
  std::vector<std::uint64_t> half_angle;  ///< half the angle, over the full turn
  std::vector<std::uint64_t> sx_before, sy_before, half_angle_before;  ///< the same at its start
  std::vector<double> vx, vy, omega;                                   ///< m/s, rad/s
  std::vector<double> fx, fy, torque;  ///< of bonds and contacts, N/m and N; Cundall damping is added by the kick
  std::vector<double> radius, mass, inertia;
  std::vector<DiscRecord> record;
  std::vector<DiscMotion> motion;  ///< after the last kick
  int position_shift =
      0;  ///< k: a record's positions are those in the cell's 2^-k part, which makes them 2^k times finer

  std::int32_t size() const { return static_cast<std::int32_t>(sx.size()); }
  void resize(std::size_t n);
  /// Angle in [-2 pi, 2 pi), rad. All laws are even under a full turn.
  double angle(std::size_t disc) const {
    return 4.0 * std::numbers::pi * 0x1p-64 * static_cast<double>(static_cast<std::int64_t>(half_angle[disc]));
  }
  void set_angle(std::size_t disc, double angle);
  /// Makes a disc's record from its position and angle, and its motion.
  void refresh_record(std::size_t disc);
};

/// Reduced coordinate in [-1/2, 1/2) of a fixed-point one.
inline double reduced(std::uint64_t s) {
  return static_cast<double>(static_cast<std::int64_t>(s)) * 0x1p-64;
}
/// Fixed-point coordinate of a reduced one in [-1/2, 1/2] or [0, 1).
inline std::uint64_t fixed_point(double s) {
  if (s >= 0.5) s -= 1.0;
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(s * 0x1p63) * 2);
}

struct CosineSine {
  double c = 1.0, s = 0.0;
};

/// Cosine and sine of 2 pi turn/2^64 by Taylor's series within an eighth of a turn: only IEEE basic operations, so that
/// bits do not depend on a maths library. Absolute error below 3e-16.
inline CosineSine cosine_sine(std::uint64_t half_angle) {
  const std::uint64_t quadrant = (half_angle + (std::uint64_t{1} << 61)) >> 62;
  const double a = static_cast<double>(static_cast<std::int64_t>(half_angle - (quadrant << 62))) *
                   (2.0 * std::numbers::pi * 0x1p-64);
  const double b = a * a;
  double s = -1.0 / 1307674368000.0, c = 1.0 / 20922789888000.0;  // 1/15!, 1/16!
  for (const double inverse :
       {1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0})
    s = s * b + inverse;
  for (const double inverse :
       {-1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5, 1.0})
    c = c * b + inverse;
  s *= a;
  switch (quadrant & 3) {
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    case 3:
      return {s, -c};
    default:
      return {c, s};
  }
}

/// Sum of F_j,a r_b over all interactions, J/m; over the area of the cell: the stress, compression positive.
struct Virial {
  double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;
};

/// What one force evaluation adds up.
struct StepSums {
  Virial virial;
  double damage = 0.0, friction = 0.0, viscous = 0.0;  ///< dissipated in this step, J/m
  double largest_overlap = 0.0;                        ///< m
  void add(const StepSums& other);
};

/// Discs a chunk: the unit of fixed-order reductions. A constant, so that sums do not depend on the number of threads.
inline constexpr std::int32_t chunk_discs = 128;

}  // namespace perfora::solver
