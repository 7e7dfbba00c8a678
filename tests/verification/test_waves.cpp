// What is here: standing waves in a long periodic bar against the speed that its measured stiffness gives. What is not:
// that stiffness itself (test_elastic_constants.cpp).
#include <cmath>
#include <numbers>

#include "tests/verification/blocks.h"
#include "tests/verification/checks.h"

namespace perfora::verification {
namespace {

constexpr double length = 100.0 * table1_diameter;  // one wave length

solver::Simulation bar(const Block& block) {
  solver::SolverOptions options;
  options.material.critical_normal_displacement = options.material.critical_shear_displacement = 1.0;
  options.dynamics.cundall_damping = 0.0;
  options.dynamics.mass = solver::MassScaling::physical;
  solver::SimulationInput input;
  input.clipped = &block.clipped;
  input.network = bonds(block, options.material);
  input.masses = solver::make_masses(block.clipped, input.network, options.material, options.dynamics);
  input.time_step = options.dynamics.step_factor * input.masses.critical_step;
  input.cell.start = {block.layout.width, 0.0, block.layout.height};
  input.options = options;
  input.mean_diameter = block.mean_diameter;
  return solver::Simulation(std::move(input));
}

/// Period of the standing wave v = v0 sin(2 pi x/length + phase) along x (longitudinal) or y (shear): from the first
/// and the fifth passage through zero of the velocity's share in that mode, two periods apart; s.
double measured_period(const Block& block, bool shear, double phase, std::vector<std::vector<double>>* table) {
  solver::Simulation s = bar(block);
  constexpr double speed = 1e-4;  // m/s: strains of 1e-7
  std::vector<double> shape;
  double norm = 0.0;
  for (std::int32_t d = 0; d < s.discs().size(); ++d) {
    const auto at = static_cast<std::size_t>(d);
    shape.push_back(std::sin(2.0 * std::numbers::pi * s.position(d).first / length + phase));
    (shear ? s.discs().vy : s.discs().vx)[at] = speed * shape.back();
    norm += s.discs().mass[at] * shape.back() * shape.back();
  }
  std::vector<double> zeros;
  double before = 1.0;
  while (zeros.size() < 5) {
    s.step();
    double fraction = 0.0;
    const auto& v = shear ? s.discs().vy : s.discs().vx;
    for (std::size_t d = 0; d < v.size(); ++d) fraction += s.discs().mass[d] * v[d] * shape[d] / (norm * speed);
    // Velocities belong to the half step; a shift of all passages alike does not matter.
    if (before * fraction <= 0.0) zeros.push_back(s.time() - s.time_step() * fraction / (fraction - before));
    before = fraction;
    if (table != nullptr && s.steps() % 20 == 0) table->push_back({s.time(), fraction});
  }
  return 0.5 * (zeros[4] - zeros[0]);
}

/// Mean of the squared speeds of the sine and the cosine wave, rooted, m/s.
double measured_speed(const Block& block, bool shear, std::vector<std::vector<double>>* table) {
  double squares = 0.0;
  for (const double phase : {0.0, 0.5 * std::numbers::pi}) {
    const double speed = length / measured_period(block, shear, phase, phase == 0.0 ? table : nullptr);
    squares += 0.5 * speed * speed;
  }
  return std::sqrt(squares);
}

// c = sqrt(C/rho), with the stiffness of this very bar from its linear solution and its bulk density.
// Dispersion: a bond of length l along the wave answers to sin(k l/2)/(k l/2), so the speed falls by k^2 l^2/24, with
// k = 2 pi/(100 <d>) and bonds up to 3 <d> 0.1 % at most. Disorder: a standing wave of one wave length weighs the local
// stiffness by cos^2 and the local density by sin^2, so one bar's sine and cosine waves differ by its Fourier component
// at 2 k, some per cent; the mean of both squares has no such term. What stays is its square: 1 % is asked.
TEST(Waves, SpeedOfTheMeasuredStiffness) {
  for (const int seed : {1, 2}) {
    const Block block = make_block(plain(length, 20.0 * table1_diameter), static_cast<std::uint64_t>(seed));
    const solver::PlaneStiffness c = elastic(block).stiffness;
    const solver::Simulation s = bar(block);
    double mass = 0.0;
    for (const double m : s.discs().mass) mass += m;
    const double density = mass / (block.layout.width * block.layout.height);
    std::vector<std::vector<double>> table;
    const std::string at = ", seed " + std::to_string(seed);
    expect_close("longitudinal speed over sqrt(C11/rho)" + at,
                 measured_speed(block, false, &table) / std::sqrt(c[0][0] / density), 1.0, 0.01);
    if (seed == 1) write_table("longitudinal_wave", {"time", "share"}, table);
    expect_close("shear speed over sqrt(C66/rho)" + at,
                 measured_speed(block, true, nullptr) / std::sqrt(c[2][2] / density), 1.0, 0.01);
    record("sqrt(C11/rho), m/s" + at, std::sqrt(c[0][0] / density), "for information", true);
  }
}

}  // namespace
}  // namespace perfora::verification
