// What is here: a disc pressed between heavy discs: sliding slows it by mu, and friction spins it up to rolling. Closed
// forms are derived in docs/developer/verification.md.
#include <cmath>

#include "tests/verification/checks.h"
#include "tests/verification/few_discs.h"

namespace perfora::verification {
namespace {

constexpr double friction = 0.4, radius = 0.25e-3, mass = 4.3e-4, heavy = 1e12 * mass;
// Overlap over radius: so small that the slid way (4,000 overlaps) does not change the normal force: y^2/4R over the
// overlap is 4e-4.
constexpr double squeeze = 1e-10;

/// The disc between two heavy ones, left and right, each pressing with k_n squeeze radius. `idle_inertia`: of the right
/// disc, in units of the middle one's; 0: heavy, too.
solver::Simulation pressed(double idle_inertia, double speed, double time_step) {
  const double overlap = squeeze * radius, apart = 2.0 * radius - overlap, middle = 4e-3;
  const double inertia = 0.5 * mass * radius * radius;
  return few_discs(
      {{middle, middle, radius, mass, 0.0, 0.0, speed, 0.0},
       {middle - apart, middle, radius, heavy, heavy, 0.0, 0.0, 0.0},
       {middle + apart, middle, radius, heavy, idle_inertia > 0.0 ? idle_inertia * inertia : heavy, 0.0, 0.0, 0.0}},
      fixed_cell(8e-3, 8e-3), contact_options(friction, 0.0), time_step);
}

struct Scales {
  double omega = 0.0, force = 0.0, speed = 0.0;
};

/// A hundred times the speed that the tangential spring alone could take up.
Scales scales() {
  const double k = solver::MaterialOptions{}.normal_stiffness;
  Scales s;
  s.omega = std::sqrt(k / mass);
  s.force = k * squeeze * radius;
  s.speed = 100.0 * friction * s.force / (mass * s.omega);
  return s;
}

// Between two heavy discs that do not turn, both frictions oppose the motion and their torques cancel: deceleration
// 2 mu N/m. Loading the two springs takes 1 % of the way; the mean deceleration between a quarter and three quarters of
// the stopping time leaves it out, so 0.1 % is asked (normal force as the disc leaves the middle: 0.04 %).
TEST(Sliding, DeceleratesByTheFrictionCoefficient) {
  const Scales z = scales();
  const double stop = z.speed * mass / (2.0 * friction * z.force), dt = 0.02 / z.omega;
  solver::Simulation s = pressed(0.0, z.speed, dt);
  while (s.time() < 0.25 * stop) s.step();
  const double v1 = s.discs().vy[0], t1 = s.time();
  while (s.time() < 0.75 * stop) s.step();
  const double deceleration = (v1 - s.discs().vy[0]) / (s.time() - t1);
  expect_close("deceleration over 2 mu N/m", deceleration * mass / (2.0 * friction * z.force), 1.0, 1e-3);
  // Torques cancel but for the rounding of positions (1e-16 of the cell) in overlaps of 1e-10 R: 3e-5 of the force.
  expect_at_most("spin R/v (torques cancel)", s.discs().omega[0] * radius / z.speed, 3e-5);
}

// One heavy plane-like disc (left, held) and an idle roller on the other side (right: heavy, but of little inertia, so
// that it carries the normal force and no friction): the disc slides, spins up and rolls. With I = m R^2/2 it rolls at
// 2/3 of its first speed: a third is lost. The roller's inertia eps I enters exactly: v = v0/(1 + 1/2 + 2 eps).
TEST(Sliding, SpinsUpToRolling) {
  const Scales z = scales();
  constexpr double eps = 1e-3;
  const double rolling = 1.0 / (1.5 + 2.0 * eps);
  const double slip = z.speed * mass / (3.0 * friction * z.force);  // slip v - omega R falls at 3 mu N/m
  const double dt = 0.05 * std::sqrt(eps) / z.omega;
  solver::Simulation s = pressed(eps, z.speed, dt);
  std::vector<std::vector<double>> table;
  while (s.time() < 1.5 * slip) {
    s.step();
    if (s.steps() % 200 == 0)
      table.push_back({s.time() / slip, s.discs().vy[0] / z.speed, s.discs().omega[0] * radius / z.speed});
  }
  // What is left is the swing of the tangential spring, about mu N/sqrt(k_t m) = 1.6 % of v0 at most, in spin twice
  // that: means over the last tenth.
  double v = 0.0, w = 0.0, count = 0.0;
  while (s.time() < 2.0 * slip) {
    s.step();
    v += s.discs().vy[0];
    w += s.discs().omega[0] * radius;
    count += 1.0;
  }
  expect_close("speed when rolling over the first speed", v / count / z.speed, rolling, 0.003);
  expect_close("spin R when rolling over the first speed", w / count / z.speed, rolling, 0.005);
  write_table("rolling", {"time", "velocity", "spin"}, table);
}

}  // namespace
}  // namespace perfora::verification
