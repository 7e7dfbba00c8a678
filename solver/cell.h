// What is here: the periodic cell as an upper-triangular 2 x 2 matrix with a control per component. What is not: discs.
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

/// How one component of H moves: it stays, or changes at a constant rate dH/dt (m/s).
enum class CellControl { fixed, rate };

/// The cell and its motion. H is a function of the number of steps, not a running sum, so that it does not drift.
struct Cell {
  CellMatrix start;
  std::array<CellControl, 3> control = {CellControl::fixed, CellControl::fixed, CellControl::fixed};  ///< xx, xy, yy
  CellMatrix velocity;  ///< dH/dt where control = rate

  CellMatrix at(double time) const {
    const auto moved = [&](int k, double h, double v) {
      return control[static_cast<std::size_t>(k)] == CellControl::rate ? h + v * time : h;
    };
    return {moved(0, start.xx, velocity.xx), moved(1, start.xy, velocity.xy), moved(2, start.yy, velocity.yy)};
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
