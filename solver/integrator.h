// What is here: the kick and the drift of a run of discs. What is not: forces, the cell's motion, the order of a step
// (simulation.cpp).
#pragma once

#include <cstdint>

#include "solver/cell.h"
#include "solver/state.h"

namespace perfora::solver {

/// Cundall's local damping: F (1 - c sign(F v)), per component (paper, Table 1; docs/user/theory.md for the sign of the
/// fluctuating velocity).
inline double damped(double force, double velocity, double coefficient) {
  const double power = force * velocity;
  return power > 0.0 ? force - coefficient * force : (power < 0.0 ? force + coefficient * force : force);
}

/// One kick and drift of discs [begin, end).
struct KickAndDrift {
  DiscState& discs;
  const double* inverse_mass;
  const double* inverse_inertia;
  double dt;              ///< s
  const double* damping;  ///< c of forces, by disc
  double rotation_ratio;  ///< c of torques over c of forces
  CellMatrix mid;         ///< H in the middle of the drift
};

struct KickSums {
  double cundall = 0.0;        ///< dissipated by the damping in this kick, J/m: force times mean velocity, exact
  double speed_squared = 0.0;  ///< the largest v'^2 after the kick, m2/s2
};

/// v' and omega to the next half step with the forces held, then positions and angles by dt; records are brought up to
/// date and the old places kept as sx_before and so on. Eight discs at a time, with IEEE operations only: the same bits
/// on every instruction set.
KickSums kick_and_drift(const KickAndDrift& task, std::int32_t begin, std::int32_t end);

}  // namespace perfora::solver
