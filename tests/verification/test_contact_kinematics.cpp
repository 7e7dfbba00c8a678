// What is here: the tangential spring of a pair carried by the cell's affine motion, and the angular momentum of pairs
// that touch. Closed forms are derived in docs/developer/verification.md.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/solver/sample_packings.h"
#include "tests/verification/checks.h"
#include "tests/verification/few_discs.h"

namespace perfora::verification {
namespace {

constexpr double radius = 0.25e-3, heavy = 1e15;  // kg/m: discs stay where the cell carries them

/// A touching pair whose branch stands at `angle`, in a cell whose components move at `velocity` (in cell sizes a
/// second).
struct CarriedPair {
  double angle = 0.0;
  solver::CellMatrix velocity;
};

/// Tangential spring and its closed form's ends: branch angle and length before and after.
struct Carried {
  double shear = 0.0;
  double x0 = 0.0, y0 = 0.0, angle0 = 0.0, angle1 = 0.0;
};

Carried carry(const CarriedPair& pair) {
  // Overlap of a tenth: the pair touches throughout. Friction so high that nothing slips.
  const double size = 4e-3, apart = 1.8 * radius;
  solver::Cell cell = fixed_cell(size, size);
  cell.control = {solver::CellControl::rate, solver::CellControl::rate, solver::CellControl::rate};
  cell.velocity = {pair.velocity.xx * size, pair.velocity.xy * size, pair.velocity.yy * size};
  constexpr double friction = 1e6, dt = 1e-6, strain = 0.02;
  Carried c;
  c.x0 = apart * std::cos(pair.angle);
  c.y0 = apart * std::sin(pair.angle);
  c.angle0 = pair.angle;
  solver::Simulation s = few_discs(
      {{1e-3, 1e-3, radius, heavy, 0.0, 0.0, 0.0, 0.0}, {1e-3 + c.x0, 1e-3 + c.y0, radius, heavy, 0.0, 0.0, 0.0, 0.0}},
      cell, contact_options(friction, 0.0), dt);
  while (s.time() < strain) s.step();
  solver::NeighbourList pairs = s.neighbour_list();
  c.shear = pairs.find(0, 1)->history.shear;
  const solver::CellMatrix& h = s.cell();
  const double x = h.xx * c.x0 / size + h.xy * c.y0 / size, y = h.yy * c.y0 / size;
  c.angle1 = std::atan2(y, x);
  return c;
}

// xi = int |r| dphi. With the branch's x kept (uniaxial strain along y) |r| = x/cos(phi): xi = x [asinh(tan phi)]; with
// its y kept (simple shear, or uniaxial along x) |r| = y/sin(phi): xi = y [ln tan(phi/2)]. Midpoint rule over 20,000
// steps of 1e-6: 1e-9 of the branch and less; 1e-8 is asked. The heavy discs themselves move by 1e-12 of it.
TEST(AffineContact, SpringIsThatOfTheBranch) {
  const double length = 1.8 * radius, tolerance = 1e-8;
  for (const double degrees : {20.0, 45.0, 70.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const std::string at = " at " + short_text(degrees) + " degrees";
    const Carried up = carry({angle, {0.0, 0.0, -1.0}});
    expect_close("xi/|r|, compression along y," + at, up.shear / length,
                 up.x0 * (std::asinh(std::tan(up.angle1)) - std::asinh(std::tan(up.angle0))) / length, tolerance);
    const auto kept_height = [](const Carried& c) {
      return c.y0 * (std::log(std::tan(0.5 * c.angle1)) - std::log(std::tan(0.5 * c.angle0)));
    };
    const Carried across = carry({angle, {-1.0, 0.0, 0.0}});
    expect_close("xi/|r|, compression along x," + at, across.shear / length, kept_height(across) / length, tolerance);
    const Carried cell_shear = carry({angle, {0.0, 1.0, 0.0}});
    expect_close("xi/|r|, simple shear," + at, cell_shear.shear / length, kept_height(cell_shear) / length, tolerance);
  }
}

// A branch along x or y under strain along x or y, and any branch under equal strain of both, does not turn: no spring.
TEST(AffineContact, NoFalseFriction) {
  double worst = 0.0;
  for (const double degrees : {0.0, 90.0, 180.0, 270.0})
    for (const solver::CellMatrix velocity : {solver::CellMatrix{-1.0, 0.0, 0.0}, solver::CellMatrix{0.0, 0.0, -1.0}})
      worst = std::max(worst, std::fabs(carry({degrees * std::numbers::pi / 180.0, velocity}).shear));
  expect_at_most("xi/|r|, branch along the axes of strain", worst / (1.8 * radius), 1e-14);
  double isotropic = 0.0;
  for (const double degrees : {10.0, 37.0, 61.0, 140.0})
    isotropic = std::max(isotropic, std::fabs(carry({degrees * std::numbers::pi / 180.0, {-1.0, 0.0, -1.0}}).shear));
  expect_at_most("xi/|r|, equal strain of both axes", isotropic / (1.8 * radius), 1e-14);
}

/// Angular momentum about the middle of the cell at the half step the velocities belong to, and the sum of magnitudes.
std::pair<double, double> angular_momentum(const solver::Simulation& s) {
  double sum = 0.0, magnitude = 0.0;
  const solver::DiscState& d = s.discs();
  for (std::int32_t k = 0; k < d.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const auto [x1, y1] = s.position(k);
    const double x = x1 - 0.5 * s.time_step() * d.vx[at] - 0.5 * s.cell().xx,
                 y = y1 - 0.5 * s.time_step() * d.vy[at] - 0.5 * s.cell().yy;
    const double orbit = d.mass[at] * (x * d.vy[at] - y * d.vx[at]), spin = d.inertia[at] * d.omega[at];
    sum += orbit + spin;
    magnitude += std::fabs(orbit) + std::fabs(spin);
  }
  return {sum, magnitude};
}

// Pairs of any radii, overlap, spins and friction: contact forces with levers |r| R_i/(R_i + R_j) leave angular
// momentum as it is. 1e-11 of the sum of magnitudes: rounding of some thousand steps.
TEST(TouchingPair, KeepsItsAngularMomentum) {
  double worst = 0.0;
  constexpr int seeds = 200;
  int rubbed = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    test::Uniform u(static_cast<std::uint64_t>(seed));
    const double r1 = u(0.1e-3, 0.5e-3), r2 = u(0.1e-3, 0.5e-3), overlap = u(0.0, 0.2) * std::min(r1, r2);
    const double apart = r1 + r2 - overlap, angle = u(0.0, 2.0 * std::numbers::pi), size = 8e-3;
    const double density = solver::MaterialOptions{}.density * std::numbers::pi;
    const double m1 = density * r1 * r1, m2 = density * r2 * r2;
    const double speed = 5.0;  // m/s: comparable with what the overlap sets free
    const double x = 0.5 * size + 0.5e-3 * u(-1.0, 1.0), y = 0.5 * size + 0.5e-3 * u(-1.0, 1.0);
    solver::Simulation s =
        few_discs({{x, y, r1, m1, 0.0, speed * u(-1.0, 1.0), speed * u(-1.0, 1.0), speed / r1 * u(-1.0, 1.0)},
                   {x + apart * std::cos(angle), y + apart * std::sin(angle), r2, m2, 0.0, speed * u(-1.0, 1.0),
                    speed * u(-1.0, 1.0), speed / r2 * u(-1.0, 1.0)}},
                  fixed_cell(size, size), contact_options(u(0.1, 1.0), u(0.0, 0.9)), 2e-9);
    s.step();
    const auto [before, magnitude] = angular_momentum(s);
    const double spin = s.discs().omega[0];
    for (int k = 0; k < 3000; ++k) s.step();
    worst = std::max(worst, std::fabs(angular_momentum(s).first - before) / magnitude);
    if (std::fabs(s.discs().omega[0] / spin - 1.0) > 1e-6) ++rubbed;
  }
  expect_at_most("largest change of angular momentum over 200 pairs", worst, 1e-11);
  EXPECT_GT(rubbed, seeds / 2) << "friction acted in most pairs; some part at once";
}

// A pair that turns as one rigid body about its middle, in light contact, has no relative motion at its contact: the
// tangential spring stays empty. Turning makes the pair want to part: the centripetal force is what the overlap gives.
TEST(TouchingPair, RigidTurnMakesNoFriction) {
  const double mass = 4.3e-4, half_angle = 1e3, k = solver::MaterialOptions{}.normal_stiffness;
  const double dt = 1e-8, apart = 2.0 * radius, size = 4e-3, middle = 0.5 * size;
  // No bond: nothing pulls, so a rigid turn lasts for one step only; what matters is that spin and orbit cancel.
  solver::Simulation s = few_discs({{middle - 0.5 * apart * (1.0 - 1e-3), middle, radius, mass, 0.0, 0.0,
                                     -half_angle * 0.5 * apart * (1.0 - 1e-3), half_angle},
                                    {middle + 0.5 * apart * (1.0 - 1e-3), middle, radius, mass, 0.0, 0.0,
                                     half_angle * 0.5 * apart * (1.0 - 1e-3), half_angle}},
                                   fixed_cell(size, size), contact_options(1e6, 0.0), dt);
  s.step();
  solver::NeighbourList pairs = s.neighbour_list();
  expect_at_most("xi over the way of the contact point", pairs.find(0, 1)->history.shear / (half_angle * dt * radius),
                 1e-9);
  EXPECT_GT(k * 1e-3 * apart, mass * half_angle * half_angle * radius);
}

}  // namespace
}  // namespace perfora::verification
