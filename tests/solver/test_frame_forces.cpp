// What is here: what frames of output.frame_data = "all" hold: stresses of discs add up to that of the block, which the
// kernels sum another way; forces agree with the laws; the run does not notice. What is not: files (tests/results).
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "io/hdf5.h"
#include "results/run_file.h"
#include "solver/frame.h"
#include "solver/run.h"
#include "tests/solver/sample_packings.h"

namespace perfora::solver {
namespace {

constexpr double pitch = 0.5e-3;

/// Bonds, breaks and contacts: a cluster driven together without damping, as in test_dynamics.cpp.
Simulation crushed_cluster(KernelChoice kernel, const geometry::Packing& packing) {
  SolverOptions options;
  options.dynamics.kernel = kernel;
  options.dynamics.cundall_damping = 0.0;
  Simulation s = test::make_simulation(packing, options, pitch, 0.0, 1);
  test::Uniform u(3);
  for (std::size_t d = 0; d < s.discs().vx.size(); ++d) {
    const auto [x, y] = s.position(static_cast<std::int32_t>(d));
    s.discs().vx[d] = u(-1.5, 1.5) - 400.0 * (x - 0.5 * s.cell().xx);
    s.discs().vy[d] = u(-1.5, 1.5) - 400.0 * (y - 0.5 * s.cell().yy);
    s.discs().omega[d] = u(-2000.0, 2000.0);
  }
  return s;
}

// Sum of pi r^2 times the stress of a disc over the area of the block = the stress of the block. The reference kernel
// sums in double precision; the vector kernels in single, with stretches a thousandth of a length: 1e-7 over 1e-3 of
// the largest forces so far.
TEST(FrameForces, StressesOfDiscsAddUpToThatOfTheBlock) {
  for (const auto& [kernel, within] :
       {std::pair(KernelChoice::reference, 1e-10), std::pair(KernelChoice::openmp, 1e-4)}) {
    const geometry::Packing packing = test::cluster_packing(10, pitch, 3);
    Simulation s = crushed_cluster(kernel, packing);
    SolverOptions options;
    options.output.frame_data = FrameData::all;
    int with_contacts = 0;
    double scale = 0.0;
    for (int k = 0; k < 2000; ++k) {
      s.step();
      if (k % 100 != 99) continue;
      results::Frame frame;
      add_forces(frame, s, options, pitch);
      with_contacts += frame.contact_pairs.empty() ? 0 : 1;
      double xx = 0.0, yy = 0.0, xy = 0.0, now = 0.0;
      for (std::size_t d = 0; d < s.discs().radius.size(); ++d) {
        const double area = std::numbers::pi * s.discs().radius[d] * s.discs().radius[d];
        xx += area * frame.stress[3 * d];
        yy += area * frame.stress[3 * d + 1];
        xy += area * frame.stress[3 * d + 2];
        now += area * (std::fabs(frame.stress[3 * d]) + std::fabs(frame.stress[3 * d + 1]));
      }
      scale = std::max(scale, now);
      const double block = s.block().xx * s.block().yy;
      const Virial stress = s.stress();
      EXPECT_NEAR(xx, block * stress.xx, within * scale);
      EXPECT_NEAR(yy, block * stress.yy, within * scale);
      EXPECT_NEAR(xy, block * 0.5 * (stress.xy + stress.yx), within * scale);
      EXPECT_EQ(frame.bond_normal_force.size(), static_cast<std::size_t>(s.intact_bonds()));
      EXPECT_EQ(2 * static_cast<std::size_t>(s.contacts()), frame.contact_pairs.size());
    }
    EXPECT_GT(with_contacts, 2);
    EXPECT_GT(s.events().size(), 20u);
  }
}

TEST(FrameForces, NothingIsAddedUnlessAsked) {
  const geometry::Packing packing = test::cluster_packing(6, pitch, 1);
  const Simulation s = crushed_cluster(KernelChoice::reference, packing);
  results::Frame frame;
  add_forces(frame, s, SolverOptions(), pitch);
  EXPECT_FALSE(frame.has_forces());
}

// With and without, a run has the same history to the last bit, and its file holds the columns; grade doubles forces.
TEST(FrameForces, TheRunDoesNotNotice) {
  const geometry::Packing packing = test::jittered_packing(10, pitch, 4);
  const geometry::PerforationLayout layout = test::no_holes(packing);
  results::Frame last[3];
  std::vector<double> stress[3];
  for (int k = 0; k < 3; ++k) {
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / ("frame-forces-" + std::to_string(::getpid()) + ".h5");
    RunRequest request;
    request.clipped = &packing;
    request.layout = &layout;
    request.options.loading.until = 0.004;
    request.options.loading.rate = 20.0;
    request.options.material.grade = k == 2 ? 2.0 : 1.0;
    if (k == 2) request.options.loading.rate *= std::sqrt(2.0);
    request.options.output.frames = FrameChoice::all;
    request.options.output.frame_data = k == 0 ? FrameData::few : FrameData::all;
    request.mean_diameter = pitch;
    request.run_file = file;
    ASSERT_EQ(run_compression(request).summary.status, results::RunStatus::completed);
    const results::RunResult run = results::read_run(file);
    stress[k] = run.history.stress_yy;
    last[k] = results::read_frame(run, run.frames.size() - 1);
    std::filesystem::remove(file);
  }
  EXPECT_EQ(stress[0], stress[1]);
  EXPECT_EQ(last[0].position, last[1].position);
  EXPECT_FALSE(last[0].has_forces());
  ASSERT_TRUE(last[1].has_forces());
  ASSERT_EQ(last[1].bond_normal_force.size(), last[2].bond_normal_force.size());
  for (std::size_t b = 0; b < last[1].bond_normal_force.size(); ++b)
    EXPECT_NEAR(last[2].bond_normal_force[b], 2.0 * last[1].bond_normal_force[b],
                1e-9 * std::fabs(last[2].bond_normal_force[b]));
  for (std::size_t d = 0; d < last[1].velocity.size(); ++d)
    EXPECT_NEAR(last[2].velocity[d], std::sqrt(2.0) * last[1].velocity[d], 1e-9 * std::fabs(last[2].velocity[d]));
}

}  // namespace
}  // namespace perfora::solver
