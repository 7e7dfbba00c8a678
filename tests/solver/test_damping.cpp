// What is here: what Cundall's damping does in a collision, against closed forms, and on which discs. What is not:
// dashpots (tests/verification/test_restitution.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/solver/closed_ledger.h"
#include "tests/solver/sample_packings.h"
#include "tests/verification/few_discs.h"

namespace perfora::solver {
namespace {

constexpr double radius = 0.25e-3;  // m
constexpr double mass = 4.3e-4;     // kg/m
constexpr double coefficient = 0.7;
constexpr double phase = 0.002;  // omega dt

SolverOptions damped_contacts(CundallScope scope, double friction) {
  SolverOptions options = verification::contact_options(friction, 0.0);
  options.dynamics.cundall_damping = coefficient;
  options.dynamics.cundall_scope = scope;
  return options;
}

/// Two free discs meet with `normal` and `tangential` relative velocity; run until well after the contact.
Simulation collide(const SolverOptions& options, double normal, double tangential) {
  const double omega = std::sqrt(options.material.normal_stiffness / (0.5 * mass));
  const double gap = 0.25 * normal * phase / omega, middle = 2e-3;
  Simulation s = verification::few_discs(
      {{middle - radius - 0.5 * gap, middle, radius, mass, 0.0, 0.5 * normal, 0.0, 0.0},
       {middle + radius + 0.5 * gap, middle, radius, mass, 0.0, -0.5 * normal, tangential, 0.0}},
      verification::fixed_cell(4e-3, 4e-3), options, phase / omega);
  while (s.time() * omega < 10.0) s.step();
  return s;
}

// While the discs approach, damping adds c to the force, which takes their energy (1 + c) k d^2/2 in all; while they
// part it gives back (1 - c) k d^2/2: e = sqrt((1 - c)/(1 + c)). Error of first order in the step: some omega dt.
TEST(CundallDamping, RestitutionOfFreeDiscs) {
  const double speed = 0.01;
  const auto restitution = [&](CundallScope scope) {
    const Simulation s = collide(damped_contacts(scope, 0.0), speed, 0.0);
    return (s.discs().vx[1] - s.discs().vx[0]) / speed;
  };
  const double closed = std::sqrt((1.0 - coefficient) / (1.0 + coefficient));
  EXPECT_NEAR(restitution(CundallScope::all), closed, 4.0 * phase);
  EXPECT_NEAR(restitution(CundallScope::translation), closed, 4.0 * phase);
  EXPECT_NEAR(restitution(CundallScope::bonded), 1.0, 1e-6) << "no disc has a bond";
}

// An impact that slides throughout: the friction torque speeds both spins up, so damping leaves 1 - c of it. The normal
// force does not know of the spins, so the two runs differ in nothing else (branch turned: 1e-3, friction's own spring:
// less).
TEST(CundallDamping, TranslationLeavesTorquesAlone) {
  const auto spin = [&](CundallScope scope) {
    return collide(damped_contacts(scope, 0.4), 1e-7, 6e-5).discs().omega[0];
  };
  const double full = spin(CundallScope::translation);
  EXPECT_GT(std::fabs(full), 0.0);
  EXPECT_NEAR(spin(CundallScope::all) / full, 1.0 - coefficient, 0.01);
}

TEST(CundallDamping, ADiscIsFreeWithItsLastBond) {
  BondNetwork network;
  network.i = {0, 1, 0};
  network.j = {1, 2, 2};
  network.state = {BondState::intact, BondState::intact, BondState::broken};
  DynamicsOptions options;
  options.cundall_scope = CundallScope::bonded;
  CundallDamping damping(options, network, 4);
  const auto expect = [&](double a, double b, double c, double d) {
    EXPECT_EQ(damping.of_force(0), a);
    EXPECT_EQ(damping.of_force(1), b);
    EXPECT_EQ(damping.of_force(2), c);
    EXPECT_EQ(damping.of_force(3), d);
  };
  expect(0.7, 0.7, 0.7, 0.0);
  damping.bond_broke(0, 1);
  expect(0.0, 0.7, 0.7, 0.0);
  damping.bond_broke(1, 2);
  expect(0.0, 0.0, 0.0, 0.0);
  options.cundall_scope = CundallScope::all;
  damping = CundallDamping(options, network, 4);
  damping.bond_broke(1, 2);
  expect(0.7, 0.7, 0.7, 0.7);
}

// Property test: work is the sum of its parts in every scope, as it is in the default one (test_dynamics.cpp).
TEST(CundallDamping, LedgerClosesInEveryScope) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const geometry::Packing packing = test::jittered_packing(14, 0.5e-3, seed);
    for (const CundallScope scope : {CundallScope::all, CundallScope::translation, CundallScope::bonded}) {
      SolverOptions options;
      options.dynamics.cundall_scope = scope;
      Simulation s = test::make_simulation(packing, options, 0.5e-3, 60.0);
      ASSERT_NO_FATAL_FAILURE(test::compress_with_closed_ledger(s, 0.01));
      EXPECT_GT(s.events().size(), 100u);
      EXPECT_GT(s.ledger().cundall, 0.0);
    }
  }
}

}  // namespace
}  // namespace perfora::solver
