// What is here: the periodic cell as an upper-triangular 2 x 2 matrix with a control per component: fixed, at a rate,
// or following a wanted stress. What is not: discs.
#pragma once

#include <array>
#include <cmath>

namespace perfora::solver {

/// H = [xx xy; 0 yy], metres: a point of reduced coordinates s sits at H s.
struct CellMatrix {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  double area() const { return xx * yy; }
};

/// Velocity gradient L = dH/dt H^-1 (upper triangular), 1/s.
struct VelocityGradient {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

/// How one component of H moves: it stays, changes at a constant rate dH/dt (m/s), or follows a wanted stress.
enum class CellControl { fixed, rate, stress };

/// The cell and its motion. Fixed and driven components of H are functions of time, not running sums, so that they do
/// not drift. A component under stress control is a massless servo: its strain rate is servo_mobility times the excess
/// of stress over the wanted one, so the excess decays at the rate servo_mobility x modulus and nothing can overshoot.
struct Cell {
  CellMatrix start;
  std::array<CellControl, 3> control = {CellControl::fixed, CellControl::fixed, CellControl::fixed};  ///< xx, xy, yy
  CellMatrix velocity;          ///< dH/dt where control = rate
  CellMatrix wanted_stress;     ///< Pa, compression positive, where control = stress
  double servo_mobility = 0.0;  ///< 1/(Pa s)

  /// H at `time`, one step of `dt` after it was `before` with `stress` (Pa, compression positive; components as in H).
  CellMatrix next(const CellMatrix& before, const CellMatrix& stress, double time, double dt) const {
    const auto moved = [&](std::size_t k, double CellMatrix::*part, double length) {
      switch (control[k]) {
        case CellControl::rate:
          return start.*part + velocity.*part * time;
        case CellControl::stress:
          return before.*part + length * servo_mobility * (stress.*part - wanted_stress.*part) * dt;
        case CellControl::fixed:
          break;
      }
      return start.*part;
    };
    return {moved(0, &CellMatrix::xx, before.xx), moved(1, &CellMatrix::xy, before.yy),
            moved(2, &CellMatrix::yy, before.yy)};
  }
};

/// (H1 - H0)/dt at the middle of a step times the inverse of H there.
inline VelocityGradient velocity_gradient(const CellMatrix& before, const CellMatrix& after, double dt) {
  const CellMatrix mid{0.5 * (before.xx + after.xx), 0.5 * (before.xy + after.xy), 0.5 * (before.yy + after.yy)};
  const CellMatrix rate{(after.xx - before.xx) / dt, (after.xy - before.xy) / dt, (after.yy - before.yy) / dt};
  return {rate.xx / mid.xx, (rate.xy - rate.xx * mid.xy / mid.xx) / mid.yy, rate.yy / mid.yy};
}

/// Engineering strain of the height, compression positive.
inline double engineering_strain(const CellMatrix& start, const CellMatrix& now) {
  return 1.0 - now.yy / start.yy;
}

}  // namespace perfora::solver
