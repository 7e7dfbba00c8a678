// What is here: Whole runs on small clusters: conservation, ledger, determinism, restart. Expected values are
// conservation laws and bit equality.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/fragments.h"
#include "tests/solver/sample_packings.h"

namespace perfora::solver {
namespace {

struct Momentum {
  double px = 0.0, py = 0.0, angular = 0.0;
  double scale_p = 0.0, scale_l = 0.0;  ///< sums of magnitudes, what rounding is measured against
};

/// Linear and angular momentum about the middle of the cell; velocities are at half steps, so positions are taken
/// there, too.
Momentum momentum(const Simulation& s) {
  Momentum m;
  const DiscState& d = s.discs();
  for (std::int32_t k = 0; k < d.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const auto [x1, y1] = s.position(k);
    const double x = x1 - 0.5 * s.cell().xx - 0.5 * s.time_step() * d.vx[at],
                 y = y1 - 0.5 * s.cell().yy - 0.5 * s.time_step() * d.vy[at];
    m.px += d.mass[at] * d.vx[at];
    m.py += d.mass[at] * d.vy[at];
    m.angular += d.mass[at] * (x * d.vy[at] - y * d.vx[at]) + d.inertia[at] * d.omega[at];
    m.scale_p += d.mass[at] * (std::fabs(d.vx[at]) + std::fabs(d.vy[at]));
    m.scale_l +=
        d.mass[at] * std::hypot(x, y) * std::hypot(d.vx[at], d.vy[at]) + d.inertia[at] * std::fabs(d.omega[at]);
  }
  return m;
}

SolverOptions undamped(KernelChoice kernel) {
  SolverOptions options;
  options.dynamics.cundall_damping = 0.0;
  options.dynamics.kernel = kernel;
  return options;
}

/// A cluster that flies apart: random velocities break bonds, then fragments collide with friction.
Simulation thrown_cluster(const geometry::Packing& packing, KernelChoice kernel, std::uint64_t seed, int threads = 1) {
  Simulation s = test::make_simulation(packing, undamped(kernel), 0.5e-3, 0.0, threads);
  test::Uniform u(seed);
  for (std::size_t d = 0; d < s.discs().vx.size(); ++d) {
    const double inward = -400.0;  // 1/s: the cluster is driven together so that contacts form
    const auto [x, y] = s.position(static_cast<std::int32_t>(d));
    s.discs().vx[d] = u(-1.5, 1.5) + inward * (x - 0.5 * s.cell().xx);
    s.discs().vy[d] = u(-1.5, 1.5) + inward * (y - 0.5 * s.cell().yy);
    s.discs().omega[d] = u(-2000.0, 2000.0);
  }
  return s;
}

// Cundall off: linear momentum to rounding over breaks and contacts; angular momentum too: every pair torque is
// balanced at the same positions, and the leapfrog's r(n) x F(n) dt is exactly the change of r x p between half steps.
// Rounding: 2,000 steps of sums over 100 discs, 1e-16 x sqrt(2e5) ~ 1e-13; in the vector kernels, whose sums of a disc
// are in single precision, 1e-7 x 25 forces each step: below 1e-6.
TEST(Conservation, MomentaWithContactsAndBreaks) {
  for (const KernelChoice kernel : {KernelChoice::reference, KernelChoice::openmp})
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const geometry::Packing packing = test::cluster_packing(10, 0.5e-3, seed);
      Simulation s = thrown_cluster(packing, kernel, seed);
      s.step();
      const Momentum before = momentum(s);
      std::int64_t contacts = 0;
      for (int k = 0; k < 2000; ++k) {
        s.step();
        if (k % 10 == 0) contacts = std::max(contacts, s.contacts());
      }
      const Momentum after = momentum(s);
      EXPECT_GT(s.events().size(), 20u);
      EXPECT_GE(contacts, 2);
      const double single = kernel == KernelChoice::openmp ? 1e-6 : 0.0;
      EXPECT_NEAR(after.px, before.px, (1e-12 + single) * before.scale_p);
      EXPECT_NEAR(after.py, before.py, (1e-12 + single) * before.scale_p);
      EXPECT_NEAR(after.angular, before.angular, (1e-11 + single) * before.scale_l) << "seed " << seed;
    }
}

// Energy: nothing is fed in (fixed cell), so kinetic + elastic + dissipated stays what was put in. The leapfrog's
// energy is exact to (omega dt)^2/8 of the highest modes and the kinks of contacts; 2 % at the default step in this
// violent case, falling with the step.
TEST(Conservation, EnergyOfAThrownCluster) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const geometry::Packing packing = test::cluster_packing(10, 0.5e-3, seed);
    double previous = 1.0;
    for (const double factor : {0.4, 0.1}) {
      SolverOptions options = undamped(KernelChoice::openmp);
      options.dynamics.step_factor = factor;
      Simulation s = test::make_simulation(packing, options, 0.5e-3);
      test::Uniform u(seed);
      for (std::size_t d = 0; d < s.discs().vx.size(); ++d)
        s.discs().vx[d] = u(-1.5, 1.5), s.discs().vy[d] = u(-1.5, 1.5);
      const double start = s.ledger().sum();
      double worst = 0.0;
      for (int k = 0; k < static_cast<int>(800 / factor); ++k) {
        s.step();
        if (k % 50 == 0) worst = std::max(worst, std::fabs(s.ledger().sum() - start) / start);
      }
      EXPECT_GT(s.events().size(), 20u);
      EXPECT_LT(worst, factor == 0.4 ? 0.03 : 0.005) << "seed " << seed;
      EXPECT_LT(worst, previous);
      previous = worst;
    }
  }
}

// The ledger where the cell works: damped compression through breaks and contacts, in a cell that is sheared as well.
// Every part is summed from its own force, so the sum meets the external work to the trapezoid's third order: 1 % is
// asked of real runs, these fast ones hold it, too. What Cundall damping takes only grows.
TEST(Conservation, LedgerOfADampedCompression) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const double cell_shear : {0.0, 0.5}) {
      const geometry::Packing packing = test::jittered_packing(14, 0.5e-3, seed);
      SolverOptions options;
      SimulationInput input;
      input.clipped = &packing;
      input.network = make_bond_network(packing, test::no_holes(packing), options.material, options.noise, 1, 0.5e-3);
      input.masses = make_masses(packing, input.network, options.material, options.dynamics);
      input.time_step = options.dynamics.step_factor * input.masses.critical_step;
      input.cell.start = {packing.width, 0.0, packing.height};
      input.cell.control = {CellControl::fixed, CellControl::rate, CellControl::rate};
      input.cell.velocity = {0.0, cell_shear * 60.0 * packing.height, -60.0 * packing.height};
      input.mean_diameter = 0.5e-3;
      Simulation s(std::move(input));
      double cundall = 0.0, work = 0.0;
      std::int64_t contacts = 0;
      while (s.strain() < 0.06) {
        s.step();
        if (s.steps() % 50 != 0 || s.strain() < 0.002) continue;
        const Ledger l = s.ledger();
        work = std::max(work, l.external_work);
        ASSERT_NEAR(l.external_work, l.sum(), 0.01 * work) << "strain " << s.strain();
        EXPECT_GE(l.cundall, cundall - 1e-3 * work);
        cundall = l.cundall;
        contacts = std::max(contacts, s.contacts());
      }
      EXPECT_GT(s.events().size(), 100u);
      EXPECT_GT(contacts, 10);
      EXPECT_GT(cundall, 0.01 * work);
    }
}

template <class Compare>
void same_state(const Simulation& a, const Simulation& b, const Compare& note) {
  EXPECT_EQ(a.discs().sx, b.discs().sx) << note;
  EXPECT_EQ(a.discs().sy, b.discs().sy) << note;
  EXPECT_EQ(a.discs().vx, b.discs().vx) << note;
  EXPECT_EQ(a.discs().vy, b.discs().vy) << note;
  EXPECT_EQ(a.discs().half_angle, b.discs().half_angle) << note;
  EXPECT_EQ(a.discs().fx, b.discs().fx) << note;
  EXPECT_EQ(a.discs().torque, b.discs().torque) << note;
  EXPECT_EQ(a.discs().omega, b.discs().omega) << note;
  EXPECT_EQ(a.network().damage, b.network().damage) << note;
  EXPECT_EQ(a.ledger().sum(), b.ledger().sum()) << note;
  EXPECT_EQ(a.ledger().external_work, b.ledger().external_work) << note;
  EXPECT_EQ(a.stress().yy, b.stress().yy) << note;
  EXPECT_EQ(a.events().size(), b.events().size()) << note;
}

class EverySimd : public ::testing::TestWithParam<SimdChoice> {};

INSTANTIATE_TEST_SUITE_P(, EverySimd, ::testing::ValuesIn(usable_simd()));

// The same bits for 1, 2 and 3 threads through elastic loading, breaks, contacts, rebuilds and compactions, on every
// instruction set. 400 discs make four chunks.
TEST_P(EverySimd, ThreadsDoNotChangeABit) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const geometry::Packing packing = test::jittered_packing(20, 0.5e-3, seed);
    SolverOptions options;
    options.dynamics.simd = GetParam();
    options.noise.kind = NoiseKind::perlin;
    options.noise.length = 2e-3;
    std::vector<Simulation> runs;
    for (const int threads : {1, 2, 3})
      runs.push_back(test::make_simulation(packing, options, 0.5e-3, 200.0, threads, seed));
    for (int k = 0; k < 1500; ++k)
      for (Simulation& s : runs) s.step();
    EXPECT_GT(runs[0].events().size(), 100u);
    EXPECT_GT(runs[0].neighbour_list().rebuilds(), 1);
    EXPECT_GT(runs[0].contacts(), 0);
    EXPECT_GT(std::count(runs[0].network().state.begin(), runs[0].network().state.end(), BondState::compacted), 0);
    same_state(runs[0], runs[1], "2 threads");
    same_state(runs[0], runs[2], "3 threads");
  }
}

// A snapshot restored into a fresh simulation goes on with the same bits, and taking it changes nothing; at random
// moments, both kernels, with free grains damped (odd seeds) and not.
TEST_P(EverySimd, SnapshotGoesOnWithTheSameBits) {
  for (const KernelChoice kernel : {KernelChoice::openmp, KernelChoice::reference})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      if (kernel == KernelChoice::reference && GetParam() != SimdChoice::portable) continue;  // once is enough
      const geometry::Packing packing = test::jittered_packing(12, 0.5e-3, seed);
      SolverOptions options;
      options.dynamics.kernel = kernel;
      options.dynamics.simd = GetParam();
      if (seed % 2 == 0) options.dynamics.cundall_scope = CundallScope::bonded;
      Simulation straight = test::make_simulation(packing, options, 0.5e-3, 200.0);
      Simulation copied = test::make_simulation(packing, options, 0.5e-3, 200.0);
      test::Uniform u(seed);
      const int cut = static_cast<int>(u(300, 1200));
      for (int k = 0; k < cut; ++k) {
        straight.step();
        copied.step();
        if (k % 97 == 0) (void)copied.snapshot();
      }
      Simulation resumed = test::make_simulation(packing, options, 0.5e-3, 200.0);
      resumed.restore(copied.snapshot());
      for (int k = cut; k < 1500; ++k) {
        straight.step();
        resumed.step();
      }
      EXPECT_GT(straight.events().size(), 50u);
      same_state(straight, resumed, "cut at " + std::to_string(cut));
    }
}

// The same where the width follows a wanted stress: then H is state, not a function of time. The servo also holds the
// wanted stress: to 5 % of the axial one in this fast run.
TEST(Restart, ServoGoesOnWithTheSameBits) {
  const geometry::Packing packing = test::jittered_packing(14, 0.5e-3, 4);
  SolverOptions options;
  const auto make = [&] {
    SimulationInput input;
    input.clipped = &packing;
    input.network = make_bond_network(packing, test::no_holes(packing), options.material, options.noise, 1, 0.5e-3);
    input.masses = make_masses(packing, input.network, options.material, options.dynamics);
    input.options = options;
    input.time_step = options.dynamics.step_factor * input.masses.critical_step;
    input.cell.start = {packing.width, 0.0, packing.height};
    input.cell.control = {CellControl::stress, CellControl::fixed, CellControl::rate};
    input.cell.velocity = {0.0, 0.0, -5.0 * packing.height};
    input.cell.wanted_stress.xx = 1e4;
    input.cell.servo_mobility = 1e-4 / input.time_step / 1e6;
    input.mean_diameter = 0.5e-3;
    return Simulation(std::move(input));
  };
  Simulation straight = make(), copied = make(), resumed = make();
  constexpr int steps = 3000, cut = 1700;
  for (int k = 0; k < steps; ++k) {
    straight.step();
    if (k < cut) copied.step();
  }
  resumed.restore(copied.snapshot());
  for (int k = cut; k < steps; ++k) resumed.step();
  same_state(straight, resumed, "servo");
  EXPECT_EQ(straight.cell().xx, resumed.cell().xx);
  EXPECT_GT(straight.cell().xx, packing.width);
  EXPECT_NEAR(straight.stress().xx, 1e4, 0.05 * straight.stress().yy);
  EXPECT_NEAR(straight.ledger().external_work, straight.ledger().sum(), 0.01 * straight.ledger().external_work);
}

// Both kernels over a small run: close to rounding while nothing is damaged (the damping switches with the sign of tiny
// velocities). Damage amplifies differences by 1/(zeta_max - 1), so from then to the first break 1e-4 is asked, and the
// same bond breaks first.
TEST(Backends, SameElasticRunAndFirstBreak) {
  const geometry::Packing packing = test::jittered_packing(12, 0.5e-3, 3);
  SolverOptions options;
  Simulation a = test::make_simulation(packing, options, 0.5e-3, 100.0);
  options.dynamics.kernel = KernelChoice::reference;
  Simulation b = test::make_simulation(packing, options, 0.5e-3, 100.0);
  while (a.events().empty() && b.events().empty() && a.steps() < 20000) {
    a.step();
    b.step();
    // Edges of the cell in single precision: 3e-8 of strain, some Pa at moduli of 150 MPa, and as much from the bonds.
    ASSERT_NEAR(a.stress().yy, b.stress().yy, 1e-4 * std::fabs(b.stress().yy) + 10.0) << a.steps();
  }
  ASSERT_FALSE(a.events().empty());
  ASSERT_FALSE(b.events().empty());
  EXPECT_EQ(a.events()[0].bond, b.events()[0].bond);
}

// Uniaxial affine strain before relaxation: the first step's stress rate is Voigt's C11 = S (3 k_n + k_t)/8 for an
// isotropic network. The jittered lattice is not quite isotropic, so the sum over its own bonds is taken: C_yyyy =
// (1/A) sum l^2 (k_n n_y^4 + k_t n_x^2 n_y^2), exact for any network.
TEST(Stress, AffineModulusMatchesTheBondSum) {
  const geometry::Packing packing = test::jittered_packing(12, 0.5e-3, 8);
  SolverOptions options;
  options.dynamics.cundall_damping = 0.0;
  options.dynamics.kernel = KernelChoice::reference;  // a strain of 1e-9
  Simulation s = test::make_simulation(packing, options, 0.5e-3, 1e-3);
  const BondNetwork& net = s.network();
  double modulus = 0.0;
  for (std::size_t b = 0; b < net.i.size(); ++b) {
    const double l = net.reference_length[b], nx = net.direction_x[b], ny = net.direction_y[b];
    modulus += l * l *
               (options.material.normal_stiffness * ny * ny * ny * ny +
                options.material.tangential_stiffness * nx * nx * ny * ny);
  }
  modulus /= packing.width * packing.height;
  s.step();  // one step: discs have not yet moved against the affine field
  EXPECT_NEAR(s.stress().yy / s.strain(), modulus, 1e-4 * modulus);
}

// Fragments: hand-made network of 7 discs, bonds 0-1-2 and 4-5, with areas.
TEST(Fragments, LabelsByArea) {
  BondNetwork net;
  const auto add = [&](int i, int j, BondState state) {
    net.i.push_back(i);
    net.j.push_back(j);
    net.state.push_back(state);
  };
  add(0, 1, BondState::intact);
  add(1, 2, BondState::intact);
  add(2, 3, BondState::broken);
  add(4, 5, BondState::intact);
  add(5, 6, BondState::compacted);
  const Fragments f = find_fragments(net, {1.0, 1.0, 1.0, 1.0, 3.0, 1.0, 0.5});
  EXPECT_EQ(f.count, 4);
  EXPECT_EQ(f.label, (std::vector<std::int32_t>{1, 1, 1, 2, 0, 0, 3}));
  EXPECT_NEAR(f.largest_fraction, 10.0 / (3.0 + 1.0 + 10.0 + 0.25), 1e-15);
}

}  // namespace
}  // namespace perfora::solver
