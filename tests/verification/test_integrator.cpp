// What is here: order and reversibility of the time stepping on smooth elastic motion. What is not: crushing
// (test_crushing.cpp).
#include <algorithm>
#include <cmath>

#include "tests/solver/sample_packings.h"
#include "tests/verification/checks.h"

namespace perfora::verification {
namespace {

constexpr double diameter = 0.5e-3;

/// Elastic motion of a small net: no damping, bonds that cannot yield.
solver::SolverOptions elastic_options(solver::KernelChoice kernel, double step_factor) {
  solver::SolverOptions options;
  options.dynamics.cundall_damping = 0.0;
  options.dynamics.kernel = kernel;
  options.dynamics.step_factor = step_factor;
  options.material.critical_normal_displacement = options.material.critical_shear_displacement = 1.0;
  return options;
}

/// Random velocities, from the unstrained state (no force at first: the first half step is of second order, too).
void throw_discs(solver::Simulation& s, std::uint64_t seed) {
  test::Uniform u(seed);
  for (std::size_t d = 0; d < s.discs().vx.size(); ++d) {
    s.discs().vx[d] = u(-5.0, 5.0);
    s.discs().vy[d] = u(-5.0, 5.0);
    s.discs().omega[d] = u(-2e4, 2e4);
  }
}

struct End {
  std::vector<double> x, y, angle;
};

End end_of(const solver::Simulation& s) {
  End e;
  for (std::int32_t d = 0; d < s.discs().size(); ++d) {
    const auto [x, y] = s.position(d);
    e.x.push_back(x);
    e.y.push_back(y);
    e.angle.push_back(s.discs().angle(static_cast<std::size_t>(d)));
  }
  return e;
}

double difference(const End& a, const End& b) {
  double sum = 0.0;
  for (std::size_t d = 0; d < a.x.size(); ++d) {
    const double dx = a.x[d] - b.x[d], dy = a.y[d] - b.y[d], half_angle = 0.5 * diameter * (a.angle[d] - b.angle[d]);
    sum += dx * dx + dy * dy + half_angle * half_angle;
  }
  return std::sqrt(sum / static_cast<double>(a.x.size()));
}

// Positions and angles at a fixed time against the finest step (1/64): the error falls with the square of the step. The
// finest run's own error shifts a slope of 2 between 1/16 and 1/8 by 0.05; 0.1 is asked. The motion (several periods of
// the fastest mode, turns of a tenth, strains of a hundredth) is not linear.
TEST(Integrator, SecondOrder) {
  const geometry::Packing packing = test::jittered_packing(10, diameter, 4);
  const auto run = [&](int refinement) {
    solver::Simulation s =
        test::make_simulation(packing, elastic_options(solver::KernelChoice::openmp, 0.2 / refinement), diameter);
    throw_discs(s, 4);
    for (int k = 0; k < 50 * refinement; ++k) s.step();
    return end_of(s);
  };
  const End finest = run(64);
  std::vector<std::vector<double>> table;
  double previous = 0.0;
  for (const int refinement : {1, 2, 4, 8}) {
    const double error = difference(run(refinement), finest);
    table.push_back({1.0 / refinement, error / diameter});
    if (previous > 0.0)
      expect_close("order from step 1/" + std::to_string(refinement / 2) + " to 1/" + std::to_string(refinement),
                   std::log2(previous / error), 2.0, 0.1);
    previous = error;
  }
  write_table("integrator", {"step", "error"}, table);
}

// Leapfrog is reversible: velocities reversed between a drift and the next kick (forces set to zero, so that the first
// kick is left out), the same number of steps leads back to the start. Rounding: positions are fixed-point, velocities
// sums of 2,000 kicks: 1e-16 x 2,000 at worst. 1e-12 <d>; both kernels.
TEST(Integrator, RunsBackToItsStart) {
  for (const auto kernel : {solver::KernelChoice::reference, solver::KernelChoice::openmp}) {
    const geometry::Packing packing = test::jittered_packing(10, diameter, 5);
    solver::Simulation s = test::make_simulation(packing, elastic_options(kernel, 0.5), diameter);
    throw_discs(s, 5);
    const End start = end_of(s);
    for (int k = 0; k < 1000; ++k) s.step();
    const double away = difference(end_of(s), start);
    for (auto* values : {&s.discs().vx, &s.discs().vy, &s.discs().omega})
      for (double& v : *values) v = -v;
    for (auto* values : {&s.discs().fx, &s.discs().fy, &s.discs().torque})
      std::fill(values->begin(), values->end(), 0.0);
    for (int k = 0; k < 1000; ++k) s.step();
    const std::string name = kernel == solver::KernelChoice::reference ? "reference" : "openmp";
    expect_at_most("way back after 1,000 steps, " + name + " kernel, over <d>", difference(end_of(s), start) / diameter,
                   1e-12);
    EXPECT_GT(away, 0.01 * diameter);
  }
}

}  // namespace
}  // namespace perfora::verification
