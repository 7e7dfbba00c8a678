// What is here: the choice of threads beside a busy neighbour, and the guard over the energies. What is not: the speed
// that is gained (docs/developer/performance.md). Expected values: the times and energies that are made up here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_packings.h"
#include "solver/energy_watch.h"
#include "solver/run.h"
#include "solver/thread_choice.h"

namespace perfora::solver {
namespace {

/// A machine on which a step takes `cost(threads)` seconds.
struct Machine {
  ThreadChoice choice;
  double now = 0.0, steps = 0.0;
  template <class Cost>
  void run(double seconds, const Cost& cost) {
    for (const double end = now + seconds; now < end; ++steps) {
      now += cost(choice.threads());
      choice.after_step(now);
    }
  }
};

TEST(ThreadChoice, AnIdleMachineLosesLessThanAPercent) {
  Machine machine{ThreadChoice(2)};
  const auto cost = [](int threads) { return threads == 2 ? 5e-4 : 9e-4; };
  machine.run(60.0, cost);
  EXPECT_EQ(machine.choice.threads(), 2);
  EXPECT_GT(machine.steps, 0.995 * 60.0 / 5e-4);
}

TEST(ThreadChoice, ABusyNeighbourLeavesOneThreadAndItsEndBringsBackAll) {
  Machine machine{ThreadChoice(2)};
  const auto idle = [](int threads) { return threads == 2 ? 5e-4 : 9e-4; };
  const auto busy = [](int threads) { return threads == 2 ? 4e-3 : 9e-4; };
  machine.run(30.0, idle);
  const double before = machine.steps;
  machine.run(10.0, busy);
  EXPECT_EQ(machine.choice.threads(), 1);
  EXPECT_GT(machine.steps - before, 0.95 * 10.0 / 9e-4) << "as fast as one thread, but for the trials";
  machine.run(21.0, idle);
  EXPECT_EQ(machine.choice.threads(), 2);
}

TEST(ThreadChoice, FindsANumberBetween) {
  Machine machine{ThreadChoice(16)};
  machine.run(60.0, [](int threads) { return threads > 8 ? 8e-3 : 1e-3 * (1.0 + 8.0 / threads); });
  EXPECT_EQ(machine.choice.threads(), 8);
}

TEST(ThreadChoice, OneThreadIsNeverAsked) {
  Machine machine{ThreadChoice(1)};
  machine.run(2.0, [](int) { return 1e-3; });
  EXPECT_EQ(machine.choice.threads(), 1);
}

TEST(ThreadChoice, AnotherNumberInTheMiddleOfARunChangesNoBit) {
  constexpr double pitch = 0.5e-3;
  const geometry::Packing packing = test::jittered_packing(16, pitch, 4);
  Simulation one = test::make_simulation(packing, {}, pitch, 600.0, 1);
  Simulation changing = test::make_simulation(packing, {}, pitch, 600.0, 3);
  for (int k = 0; k < 500; ++k) {
    if (k % 17 == 0) changing.set_threads(1 + k / 17 % 3);
    one.step();
    changing.step();
  }
  EXPECT_GT(one.events().size(), 50u);
  EXPECT_EQ(one.discs().sx, changing.discs().sx);
  EXPECT_EQ(one.discs().vy, changing.discs().vy);
  EXPECT_EQ(one.network().damage, changing.network().damage);
  EXPECT_EQ(one.ledger().sum(), changing.ledger().sum());
  EXPECT_EQ(one.stress().yy, changing.stress().yy);
}

results::History energies(const std::vector<double>& work, const std::vector<double>& sum) {
  results::History h;
  for (std::size_t k = 0; k < work.size(); ++k) h.strain_yy.push_back(0.01 * static_cast<double>(k));
  h.external_work = work;
  h.damage = sum;
  for (auto* column : {&h.elastic_bonds, &h.elastic_contacts, &h.kinetic, &h.friction, &h.viscous, &h.cundall})
    column->assign(work.size(), 0.0);
  return h;
}

TEST(EnergyWatch, LooksAtEachSampleOnceOverTheLargestWork) {
  EnergyWatch watch;
  EXPECT_EQ(watch.residual(energies({0.0}, {0.0})), 0.0);
  EXPECT_DOUBLE_EQ(watch.residual(energies({0.0, 2.0}, {0.0, 1.5})), 0.25);
  EXPECT_EQ(watch.residual(energies({0.0, 2.0}, {0.0, 1.5})), 0.0) << "no new sample";
  EXPECT_DOUBLE_EQ(watch.residual(energies({0.0, 2.0, 1.0}, {0.0, 1.5, 2.0})), 0.5);
}

// Rates beyond any sense: the run ends with its reason instead of a result.
TEST(EnergyWatch, ARunWhoseEnergiesDoNotAddUpFails) {
  constexpr double pitch = 0.5e-3;
  const geometry::Packing packing = test::jittered_packing(12, pitch, 6);
  const geometry::PerforationLayout layout = test::no_holes(packing);
  RunRequest request;
  request.clipped = &packing;
  request.layout = &layout;
  request.options.loading.until = 0.3;
  request.mean_diameter = pitch;
  request.options.loading.rate = 1e4;
  EXPECT_EQ(run_compression(request).summary.status, results::RunStatus::completed);
  request.options.loading.rate = 1e7;
  const Response response = run_compression(request);
  EXPECT_EQ(response.summary.status, results::RunStatus::failed);
  EXPECT_THAT(response.summary.reason,
              testing::AllOf(testing::HasSubstr("energy residual"), testing::HasSubstr("loading.rate")));
}

}  // namespace
}  // namespace perfora::solver
