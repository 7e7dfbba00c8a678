// What is here: the mode of a single bond that costs nothing, and that a triangulated net has no such mode. What is
// not: the bond law point by point (tests/solver/test_laws.cpp).
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tests/solver/sample_packings.h"
#include "tests/verification/checks.h"

namespace perfora::verification {
namespace {

constexpr double diameter = 0.5e-3;

void half_angle(solver::Simulation& s, std::size_t disc, double angle) {
  s.discs().set_angle(disc, angle);
}

/// Sum over the bonds of disc `disc`, but for the one to `other`, of k_t l^2 phi^2/8: each bond sees half its turn.
double energy_of_turn(const solver::Simulation& s, int disc, int other, double angle) {
  double sum = 0.0;
  const solver::BondNetwork& net = s.network();
  for (std::size_t b = 0; b < net.i.size(); ++b) {
    const bool mine = net.i[b] == disc || net.j[b] == disc, pair = net.i[b] == other || net.j[b] == other;
    if (mine && !pair) sum += net.reference_length[b] * net.reference_length[b];
  }
  return solver::MaterialOptions{}.tangential_stiffness * sum * angle * angle / 8.0;
}

solver::SolverOptions undamped() {
  solver::SolverOptions options;
  options.dynamics.cundall_damping = 0.0;
  return options;
}

// One bond, ends turned by +phi and -phi: theta = 0, so no energy at any angle. Turned alike: delta_t = l sin(phi).
TEST(BondModes, OppositeTurnsOfOneBondAreFree) {
  geometry::Packing p;
  p.width = p.height = 20.0 * diameter;
  p.x = {9.0 * diameter, 10.5 * diameter};
  p.y = {9.0 * diameter, 9.7 * diameter};
  p.radius = {0.4 * diameter, 0.5 * diameter};
  solver::Simulation s = test::make_simulation(p, undamped(), diameter);
  ASSERT_EQ(s.network().size(), 1);
  const double l = s.network().reference_length[0], kt = solver::MaterialOptions{}.tangential_stiffness;
  for (const double angle : {1e-3, 0.5, 3.0}) {
    half_angle(s, 0, angle);
    half_angle(s, 1, -angle);
    s.refresh_records();
    expect_at_most("opposite turns by " + short_text(angle) + ": U/(k_t l^2)", s.ledger().elastic_bonds / (kt * l * l),
                   1e-28);
    half_angle(s, 1, angle);
    s.refresh_records();
    const double shear = l * std::sin(angle);
    expect_close("equal turns by " + short_text(angle) + ": U/(k_t l^2 sin^2/2)",
                 s.ledger().elastic_bonds / (0.5 * kt * shear * shear), 1.0, 1e-9);
  }
}

// The same two turns in a net: every other bond of both discs is sheared by l phi/2 (small angle: phi^2/12 = 1e-7 of
// it).
TEST(BondModes, OppositeTurnsInANetCost) {
  double worst = 0.0, least = 1e300;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const geometry::Packing p = test::jittered_packing(8, diameter, seed);
    for (std::size_t bond = 0; bond < 40; ++bond) {
      solver::Simulation s = test::make_simulation(p, undamped(), diameter);
      const int i = s.network().i[bond], j = s.network().j[bond];
      constexpr double angle = 1e-3;
      half_angle(s, static_cast<std::size_t>(i), angle);
      half_angle(s, static_cast<std::size_t>(j), -angle);
      s.refresh_records();
      const double expected = energy_of_turn(s, i, j, angle) + energy_of_turn(s, j, i, angle);
      worst = std::max(worst, std::fabs(s.ledger().elastic_bonds / expected - 1.0));
      least = std::min(least, s.ledger().elastic_bonds);
    }
  }
  expect_at_most("energy of opposite turns of neighbours over its closed form, less 1", worst, 1e-6);
  EXPECT_GT(least, 0.0);
}

/// Stiffness of the linearised net, 3 unknowns a disc (x, y, turn times <d>), from the bond law's quadratic energy.
Eigen::MatrixXd stiffness(const solver::BondNetwork& net, int discs) {
  const solver::MaterialOptions material;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(3 * discs, 3 * discs);
  for (std::size_t b = 0; b < net.i.size(); ++b) {
    const double nx = net.direction_x[b], ny = net.direction_y[b], half = 0.5 * net.reference_length[b] / diameter;
    Eigen::VectorXd normal(6), shear(6);
    normal << -nx, -ny, 0.0, nx, ny, 0.0;
    shear << ny, -nx, -half, -ny, nx, -half;
    const Eigen::MatrixXd local = material.normal_stiffness * normal * normal.transpose() +
                                  material.tangential_stiffness * shear * shear.transpose();
    const int at[2] = {3 * net.i[b], 3 * net.j[b]};
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c) k.block(at[r], at[c], 3, 3) += local.block(3 * r, 3 * c, 3, 3);
  }
  return k;
}

// All eigenvalues of small periodic nets at H = 1.5 (7 bonds a disc), 2 and 3: the two translations are the only free
// motions; everything else, turns included, costs energy.
TEST(BondModes, ANetHasNoOtherFreeMotion) {
  for (const double horizon : {1.5, 2.0, 3.0}) {
    double zero = 0.0, least = 1e300;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const geometry::Packing p = test::jittered_packing(8, diameter, seed);
      solver::SolverOptions options = undamped();
      options.material.horizon = horizon;
      const solver::Simulation s = test::make_simulation(p, options, diameter);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solve(stiffness(s.network(), p.size()),
                                                                 Eigen::EigenvaluesOnly);
      zero = std::max(zero, std::fabs(solve.eigenvalues()[1]) / options.material.normal_stiffness);
      least = std::min(least, solve.eigenvalues()[2] / options.material.normal_stiffness);
    }
    expect_at_most("second eigenvalue over k_n, H = " + short_text(horizon), zero, 1e-12);
    expect_between("third eigenvalue over k_n, H = " + short_text(horizon), least, 1e-3, 1e3);
  }
}

}  // namespace
}  // namespace perfora::verification
