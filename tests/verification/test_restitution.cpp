// What is here: two discs that collide: coefficient of restitution of the cut-off dashpot, and the friction impulse of
// a sliding impact. Closed forms are derived in docs/developer/verification.md.
#include <cmath>
#include <numbers>

#include "tests/verification/checks.h"
#include "tests/verification/few_discs.h"

namespace perfora::verification {
namespace {

constexpr double radius = 0.25e-3;  // m
constexpr double mass = 4.3e-4;     // kg/m, a disc of that size

/// e = exp(-2 beta acos(beta)/sqrt(1 - beta^2)): the damped oscillator up to where the force returns to zero.
double restitution(double beta) {
  return std::exp(-2.0 * beta * std::acos(beta) / std::sqrt(1.0 - beta * beta));
}

/// Head-on collision of two equal discs at `phase` = omega dt, with omega = sqrt(k_n/m_eff).
double measured_restitution(double beta, double phase) {
  const solver::SolverOptions options = contact_options(0.0, beta);
  const double omega = std::sqrt(options.material.normal_stiffness / (0.5 * mass));
  // The first touch falls a quarter into a step, at every step size: else its phase would scatter the error.
  const double speed = 0.01, gap = 0.25 * speed * phase / omega, middle = 2e-3;
  solver::Simulation s = few_discs({{middle - radius - 0.5 * gap, middle, radius, mass, 0.0, 0.5 * speed, 0.0, 0.0},
                                    {middle + radius + 0.5 * gap, middle, radius, mass, 0.0, -0.5 * speed, 0.0, 0.0}},
                                   fixed_cell(4e-3, 4e-3), options, phase / omega);
  while (s.time() * omega < 10.0) s.step();  // contact ends at omega t = 2 acos(beta)/sqrt(1 - beta^2) <= pi
  return (s.discs().vx[1] - s.discs().vx[0]) / speed;
}

// The dashpot uses the velocity of the last half step, so the error is of first order in the step: at omega dt = 0.002
// it is below 2 beta omega dt (the change of the damping force over half a step, over both halves of the contact).
TEST(Restitution, CutOffDashpot) {
  constexpr double finest = 0.002;
  std::vector<std::vector<double>> table;
  for (const double beta : {0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.95}) {
    const double e = measured_restitution(beta, finest);
    expect_close("e at beta = " + short_text(beta), e, restitution(beta), 2.0 * beta * finest);
    table.push_back({beta, e});
  }
  write_table("restitution", {"viscous_rate", "restitution"}, table);
  table.clear();
  for (int k = 0; k < 100; ++k) table.push_back({0.01 * k, restitution(0.01 * k)});
  write_table("restitution_closed", {"viscous_rate", "restitution"}, table);
}

TEST(Restitution, ErrorHalvesWithTheStep) {
  const double beta = 0.9, e = restitution(beta);
  EXPECT_NEAR(e, 0.155, 5e-4);
  double coarse = measured_restitution(beta, 0.04) - e;
  for (const double phase : {0.02, 0.01, 0.005}) {
    const double fine = measured_restitution(beta, phase) - e;
    // First order: 2, but for the next order, which is a few times omega dt of it.
    expect_close("error ratio on halving to omega dt = " + short_text(phase), coarse / fine, 2.0, 0.2);
    coarse = fine;
  }
}

// An oblique impact that slides throughout: tangential impulse = mu times normal impulse, whatever the law of the
// normal force. Disc 1 at rest, so with e from above: each disc's spin changes by mu m_eff (1+e) v_n R/I. Sliding
// throughout asks for v_t beyond mu (1+e) v_n (m_eff/m_t) with m_t = m_eff/3 (discs), here 0.4 x 2 x 3 = 2.4 v_n. v_t =
// 600 v_n, so that the tangential spring is loaded in mu 2 beta k_n/(600 k_t) = 0.3 % of 1/omega; with the step, 1 % is
// asked. So slow that the branch does not turn (v_t^2/(v_n omega R) = 1e-3).
TEST(Restitution, SlidingImpact) {
  constexpr double friction = 0.4, steps_per_radian = 500.0;
  for (const double beta : {0.0, 0.9}) {
    const solver::SolverOptions options = contact_options(friction, beta);
    const double omega = std::sqrt(options.material.normal_stiffness / (0.5 * mass));
    const double normal = 1e-7, tangential = 6e-5, gap = 1e-3 * normal / omega, middle = 2e-3;
    solver::Simulation s = few_discs({{middle - radius - 0.5 * gap, middle, radius, mass, 0.0, normal, 0.0, 0.0},
                                      {middle + radius + 0.5 * gap, middle, radius, mass, 0.0, 0.0, tangential, 0.0}},
                                     fixed_cell(4e-3, 4e-3), options, 1.0 / (steps_per_radian * omega));
    while (s.time() * omega < 10.0) s.step();
    const double e = beta > 0.0 ? restitution(beta) : 1.0;
    const double impulse = friction * 0.5 * mass * (1.0 + e) * normal;
    const double spin = impulse * radius / (0.5 * mass * radius * radius);
    const std::string at = " at beta = " + short_text(beta);
    expect_close("loss of tangential velocity over its closed form" + at,
                 (tangential - s.discs().vy[1]) / (impulse / mass), 1.0, 0.01);
    expect_close("spin over its closed form" + at, s.discs().omega[0] / spin, 1.0, 0.01);
    expect_close("spins of both, ratio" + at, s.discs().omega[1] / s.discs().omega[0], 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace perfora::verification
