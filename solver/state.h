// What is here: the state of all discs as structure of arrays, the compact record the force loops read, sums of one
// step. What is not: bonds (bond_network.h), near pairs (near_pairs.h), the step (simulation.h).
#pragma once

#include <cstdint>
#include <vector>

namespace perfora::solver {

/// What a neighbour needs of a disc, one cache-line half: reduced position in [-1/2, 1/2) and cosine and sine of half
/// its angle.
struct alignas(32) DiscRecord {
  double x, y, c, s;
};

/// All discs. Reduced positions are 64-bit fixed point of the cell: differences wrap by themselves (minimum image) and
/// sums do not round. Velocities are fluctuations v' = dx/dt - L x, held at half steps (leapfrog form of velocity
/// Verlet).
struct DiscState {
  std::vector<std::uint64_t> sx, sy;
  std::vector<double> vx, vy, omega;       ///< m/s, rad/s
  std::vector<double> angle;               ///< rad, for output only
  std::vector<double> half_cos, half_sin;  ///< of angle/2, advanced by small rotations
  std::vector<double> fx, fy, torque;      ///< of bonds and contacts, N/m and N; Cundall damping is added by the kick
  std::vector<double> radius, mass, inertia;
  std::vector<DiscRecord> record, record_before;  ///< at the end and at the start of the last drift

  std::int32_t size() const { return static_cast<std::int32_t>(sx.size()); }
  void resize(std::size_t n);
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
inline constexpr std::int32_t chunk_discs = 64;

}  // namespace perfora::solver
