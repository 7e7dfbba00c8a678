// What is here: platens and walls in motion: friction, momentum, no pull, ledger, the same bits. Expected values are
// Coulomb's law, conservation laws and bit equality. What is not: moduli (test_bounded_elasticity.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/hdf5.h"
#include "solver/checkpoint.h"
#include "solver/run.h"
#include "tests/solver/bounded_block.h"
#include "tests/solver/closed_ledger.h"

namespace perfora::solver {
namespace {

constexpr double pitch = 0.5e-3;

/// One disc that just fits between two platens.
geometry::Packing one_disc(double radius) {
  geometry::Packing p;
  p.width = 20.0 * radius;
  p.height = 2.0 * radius;
  p.x = {0.5 * p.width};
  p.y = {radius};
  p.radius = {radius};
  return p;
}

/// The disc between platens that come nearer at 1 /s and then stay, with a sideways speed.
Simulation squeezed_disc(const geometry::Packing& packing, double friction, double speed, double damping = 0.0) {
  SolverOptions options = test::with_edges(TopBottom::platens, Sides::periodic);
  options.boundary.platen_friction = friction;
  options.dynamics.cundall_damping = damping;
  options.dynamics.step_factor = 0.05;
  Simulation s = test::make_bounded(packing, options, 2.0 * packing.radius[0], 1.0);
  s.discs().vx[0] = speed;
  return s;
}

// Sliding: each platen takes mu times its normal force, exactly (the clamp of the law), against the motion; the disc
// slows down by both, and as they turn it opposite ways it does not turn.
TEST(Platens, ASlidingDiscFeelsCoulombsFriction) {
  const double mu = 0.3;
  const geometry::Packing packing = one_disc(0.25e-3);
  Simulation s = squeezed_disc(packing, mu, 5.0);
  for (int k = 0; k < 3000; ++k) {
    const double speed = s.discs().vx[0];
    const double push = k > 0 ? s.walls().force(0)[0] + s.walls().force(1)[0] : 0.0;
    s.step();
    EXPECT_NEAR(s.discs().vx[0] - speed, push * s.time_step() / s.discs().mass[0], 1e-12);
    if (k < 10) continue;
    ASSERT_GT(s.discs().vx[0], 0.0);
    EXPECT_NEAR(s.walls().force(0)[0], -mu * s.walls().force(0)[1], 1e-12 * s.walls().force(0)[1]);
    EXPECT_NEAR(s.walls().force(1)[0], mu * s.walls().force(1)[1], -1e-12 * s.walls().force(1)[1]);
  }
  EXPECT_GT(s.walls().force(0)[1], 0.0);
  EXPECT_NEAR(s.discs().omega[0], 0.0, 1e-6 * 5.0 / packing.radius[0]);
  // Both platens came nearer by half of strain x height: k_n overlap, to the dashpot's share of it (5e-3: its force
  // over that of the spring, 2 beta sqrt(k_n m) v/(k_n overlap)).
  const double overlap = 0.5 * s.strain() * packing.height;
  EXPECT_NEAR(s.walls().force(0)[1], MaterialOptions{}.normal_stiffness * overlap, 0.05 * s.walls().force(0)[1]);
}

// Resting: a slow disc sticks; the force stays below mu N, and it swings about its first place and never slides off.
TEST(Platens, ASlowDiscSticks) {
  const double mu = 0.3;
  const geometry::Packing packing = one_disc(0.25e-3);
  Simulation s = squeezed_disc(packing, mu, 0.0, 0.7);
  for (int k = 0; k < 2000; ++k) s.step();
  s.discs().vx[0] = 1e-4;
  const double x = s.position(0).first;
  for (int k = 0; k < 4000; ++k) {
    s.step();
    ASSERT_LE(std::fabs(s.walls().force(0)[0]), mu * s.walls().force(0)[1]);
  }
  EXPECT_LT(std::fabs(s.position(0).first - x), 1e-4 * 1000.0 * s.time_step());
  EXPECT_LT(std::fabs(s.discs().vx[0]), 1e-5);
}

// Nothing is prestressed: in a cell at rest a cut block, whose faces cut through discs, feels no force at all.
TEST(Platens, FacesBeginWithoutForce) {
  const geometry::Packing packing = test::jittered_packing(14, pitch, 1);
  Simulation s = test::make_bounded(packing, test::with_edges(TopBottom::platens, Sides::walls), pitch, 0.0);
  for (int k = 0; k < 50; ++k) s.step();
  // Rounding of l0 against |r| in bonds near the face: 1e-10 m times k_n each, some ten of them at random.
  for (std::size_t w = 0; w < 4; ++w) EXPECT_NEAR(std::hypot(s.walls().force(w)[0], s.walls().force(w)[1]), 0.0, 2e-2);
}

// Platens and walls push, they do not pull: pulled apart, the block comes loose. Its own stress then dies away.
TEST(Platens, DoNotPull) {
  const geometry::Packing packing = test::jittered_packing(14, pitch, 2);
  SolverOptions options = test::with_edges(TopBottom::platens, Sides::walls);
  test::make_unbreakable(options.material);
  Simulation s = test::make_bounded(packing, options, pitch, -1.0);
  double largest = 0.0;
  while (s.strain() > -0.003) {
    s.step();
    EXPECT_GE(s.walls().force(0)[1], 0.0);
    EXPECT_LE(s.walls().force(1)[1], 0.0);
    EXPECT_GE(s.walls().force(2)[0], 0.0);
    EXPECT_LE(s.walls().force(3)[0], 0.0);
    largest = std::max(largest, std::fabs(s.stress().yy));
  }
  // Held at both ends, a modulus of 0.1 GPa at least would make 0.3 MPa of it.
  EXPECT_LT(largest, 1e4);
}

// Without Cundall damping the discs' momentum changes by the walls' forces and nothing else, through breaks, friction
// and rubble. Rounding of 1500 sums over 144 discs; in the vector kernels each of them in single precision
// (6e-8, and the root of 1500 of it where the errors are independent).
TEST(Walls, ForcesAreTheChangeOfMomentum) {
  for (const KernelChoice kernel : {KernelChoice::reference, KernelChoice::openmp}) {
    const geometry::Packing packing = test::jittered_packing(12, pitch, 3);
    SolverOptions options = test::with_edges(TopBottom::platens, Sides::walls);
    options.boundary.wall_friction = 0.2;
    options.dynamics.cundall_damping = 0.0;
    options.dynamics.kernel = kernel;
    Simulation s = test::make_bounded(packing, options, pitch, 200.0);
    const auto momentum = [&](bool magnitude) {
      std::array<double, 2> p = {};
      for (std::size_t d = 0; d < packing.x.size(); ++d) {
        p[0] += s.discs().mass[d] * (magnitude ? std::fabs(s.discs().vx[d]) : s.discs().vx[d]);
        p[1] += s.discs().mass[d] * (magnitude ? std::fabs(s.discs().vy[d]) : s.discs().vy[d]);
      }
      return p;
    };
    std::array<double, 2> impulse = {};
    for (int k = 0; k < 1500; ++k) {
      for (std::size_t w = 0; w < 4; ++w)
        for (std::size_t a = 0; a < 2; ++a) impulse[a] += s.time_step() * s.walls().force(w)[a];
      s.step();
    }
    EXPECT_GT(s.events().size(), 50u);
    const double scale = (kernel == KernelChoice::openmp ? 2.5e-6 : 1e-11) * momentum(true)[1];
    EXPECT_NEAR(momentum(false)[0], impulse[0], scale);
    EXPECT_NEAR(momentum(false)[1], impulse[1], scale);
  }
}

// The ledger with rubbing walls and damping, through breaks and contacts: what the cell works through the virial, walls
// included, is what the parts sum up to. The trapezoid's third order leaves well below the 0.5 % asked here.
TEST(Walls, LedgerCloses) {
  for (const Sides sides : {Sides::periodic, Sides::walls, Sides::free})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const geometry::Packing packing = test::jittered_packing(14, pitch, seed);
      SolverOptions options = test::with_edges(TopBottom::platens, sides);
      options.boundary.wall_friction = 0.4;
      Simulation s = test::make_bounded(packing, options, pitch, 60.0);
      ASSERT_NO_FATAL_FAILURE(test::compress_with_closed_ledger(s, 0.005));
      EXPECT_GT(s.events().size(), 50u);
      EXPECT_GT(s.ledger().friction, 0.0);
    }
}

template <class Note>
void same_state(const Simulation& a, const Simulation& b, const Note& note) {
  EXPECT_EQ(a.discs().sx, b.discs().sx) << note;
  EXPECT_EQ(a.discs().sy, b.discs().sy) << note;
  EXPECT_EQ(a.discs().vx, b.discs().vx) << note;
  EXPECT_EQ(a.discs().omega, b.discs().omega) << note;
  EXPECT_EQ(a.network().damage, b.network().damage) << note;
  EXPECT_EQ(a.ledger().sum(), b.ledger().sum()) << note;
  EXPECT_EQ(a.stress().yy, b.stress().yy) << note;
  for (std::size_t w = 0; w < a.walls().places().size(); ++w) {
    EXPECT_EQ(a.walls().force(w), b.walls().force(w)) << note;
    EXPECT_EQ(a.walls().row_pressure(w), b.walls().row_pressure(w)) << note;
  }
}

TEST(Walls, ThreadsDoNotChangeABit) {
  for (const Sides sides : {Sides::walls, Sides::free}) {
    const geometry::Packing packing = test::jittered_packing(14, pitch, 4);
    const SolverOptions options = test::with_edges(TopBottom::platens, sides);
    Simulation one = test::make_bounded(packing, options, pitch, 200.0, 1);
    Simulation three = test::make_bounded(packing, options, pitch, 200.0, 3);
    for (int k = 0; k < 1500; ++k) {
      one.step();
      three.step();
    }
    EXPECT_GT(one.events().size(), 50u);
    same_state(one, three, "3 threads");
  }
}

// A checkpoint read into a fresh simulation goes on with the same bits, in the middle of a row and with beds already
// lost.
TEST(Walls, CheckpointGoesOnWithTheSameBits) {
  const auto file = std::filesystem::temp_directory_path() / "perfora-test-walls-checkpoint.h5";
  for (const KernelChoice kernel : {KernelChoice::openmp, KernelChoice::reference})
    for (const Sides sides : {Sides::periodic, Sides::walls, Sides::free}) {
      const geometry::Packing packing = test::jittered_packing(12, pitch, 5);
      SolverOptions options = test::with_edges(TopBottom::platens, sides);
      options.boundary.wall_friction = 0.3;
      options.dynamics.kernel = kernel;
      Simulation straight = test::make_bounded(packing, options, pitch, 200.0);
      for (int k = 0; k < 700; ++k) {
        if (k == 650) straight.reset_row();
        straight.step();
      }
      write_checkpoint(file, {1, "", straight.snapshot(), {}});
      Simulation resumed = test::make_bounded(packing, options, pitch, 200.0);
      resumed.restore(read_checkpoint(file, resumed).simulation);
      for (int k = 0; k < 700; ++k) {
        straight.step();
        resumed.step();
      }
      EXPECT_GT(straight.events().size(), 50u);
      const auto has_face_stiffness = straight.walls().snapshot().has_face_stiffness;
      EXPECT_GT(std::count(has_face_stiffness.begin(), has_face_stiffness.end(), 1), 0);
      same_state(straight, resumed, "resumed");
    }
  std::filesystem::remove(file);
}

/// A whole run of a small block; its history.
results::History short_run(TopBottom top_bottom, Sides sides, const std::filesystem::path& file) {
  const geometry::Packing packing = test::jittered_packing(12, pitch, 6);
  const geometry::PerforationLayout layout = test::no_holes(packing);
  RunRequest request;
  request.clipped = &packing;
  request.layout = &layout;
  request.options = test::with_edges(top_bottom, sides);
  request.options.loading.until = 0.003;
  request.options.loading.rate = 20.0;
  request.mean_diameter = pitch;
  request.run_file = file;
  return run_compression(request).history;
}

// Columns of walls exist in histories and files where such walls are, and only there.
TEST(Walls, ColumnsOnlyWhereThereAreWalls) {
  const auto file = std::filesystem::temp_directory_path() / "perfora-test-walls-run.h5";
  for (const TopBottom top_bottom : {TopBottom::periodic, TopBottom::platens})
    for (const Sides sides : {Sides::periodic, Sides::walls, Sides::free}) {
      const results::History h = short_run(top_bottom, sides, file);
      ASSERT_EQ(h.rows(), 7u);
      const bool platens = top_bottom == TopBottom::platens, walls = sides == Sides::walls;
      EXPECT_EQ(h.platen_stress_bottom.size(), platens ? 7u : 0u);
      EXPECT_EQ(h.platen_stress_top.size(), platens ? 7u : 0u);
      EXPECT_EQ(h.wall_stress_left.size(), walls ? 7u : 0u);
      EXPECT_EQ(h.wall_stress_right.size(), walls ? 7u : 0u);
      const io::Hdf5Reader written(file);
      EXPECT_EQ(written.has("/history/platen_stress_top"), platens);
      EXPECT_EQ(written.has("/history/wall_stress_left"), walls);
      EXPECT_EQ(written.attribute_text("/", "top_bottom"), platens ? "platens" : "periodic");
    }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace perfora::solver
