// What is here: the controlled loading rate: bounds and directions of the controller, exact strains of segments and of
// the end, the same bits for threads and restarts. Expected values: closed forms and properties of docs/user/theory.md,
// "Loading rate".
#include "solver/loading_rate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/solver/sample_packings.h"

namespace perfora::solver {
namespace {

constexpr double longest_step = 1e-6;  // s

/// A block of 2 x 2 holes of 20 mm in 50 x 50 mm, in round numbers.
LoadingEstimate round_estimate(double transits = 25.0) {
  LoadingEstimate e;
  e.modulus = 1e8;
  e.bulk_density = 1000.0;
  e.wave_speed = std::sqrt(e.modulus / e.bulk_density);
  e.peak_strain = 8e-3;
  e.rate = e.peak_strain * e.wave_speed / (transits * 50e-3);
  return e;
}

LoadingPlan adaptive(double transits = 25.0) {
  LoadingOptions options;
  options.transits = transits;
  return plan_loading(round_estimate(transits), options, {50e-3, 50e-3, 20e-3}, longest_step);
}

TEST(LoadingPlan, GivenRateAndConstantControlAreOneRate) {
  LoadingOptions options;
  options.control = LoadingControl::constant;
  options.until = 0.1;
  for (const double given : {0.0, 3.0}) {
    options.rate = given;
    const LoadingPlan plan = plan_loading(round_estimate(), options, {50e-3, 50e-3, 20e-3}, longest_step);
    const double wanted = given > 0.0 ? given : round_estimate().rate;
    EXPECT_LE(plan.time_step, longest_step);
    LoadingState state;
    const SegmentMeasures violent{1e6, 1e9, true};
    for (int k = 0; k < 5; ++k) {
      begin_segment(plan, violent, state);
      EXPECT_NEAR(state.rate, wanted, 1e-12 * wanted);  // rounding of a few products
      state.step = state.steps;
      finish_segment(plan, state);
    }
    EXPECT_EQ(path_strain(state), 5 * path_segment);
    // n segments of ceil(segment/(rate longest step)) steps.
    EXPECT_EQ(expected_steps(plan, round_estimate(), 0.36),
              1600 * static_cast<std::int64_t>(std::ceil(path_segment / (wanted * longest_step))));
  }
}

// A rate at which one step makes many segments' strain: it is kept, and so is the end.
TEST(LoadingPlan, AFastRateIsKept) {
  LoadingOptions options;
  options.rate = 1e4;
  options.until = 0.0123;
  const LoadingPlan plan = plan_loading(round_estimate(), options, {50e-3, 50e-3, 20e-3}, longest_step);
  EXPECT_LE(plan.time_step, longest_step);
  EXPECT_NEAR(plan.segment_strain, options.rate * plan.time_step, 1e-12);  // 1e-2: one step
  LoadingState state;
  begin_segment(plan, {}, state);
  EXPECT_NEAR(state.rate, options.rate, 1e-9 * options.rate);
  state.step = state.steps;
  finish_segment(plan, state);
  EXPECT_FALSE(at_end(plan, state));
  begin_segment(plan, {}, state);
  state.step = state.steps;
  EXPECT_EQ(path_strain(state), options.until);
  finish_segment(plan, state);
  EXPECT_TRUE(at_end(plan, state));
}

// The path ends at the very strain that was asked for, wherever it lies between two segments; up to the last segment it
// is that of a longer run.
TEST(LoadingPlan, EndsAtTheStrainAskedFor) {
  for (const double until : {1e-5, 6.25e-5, 0.0123, 0.05, 0.1, 1.0 / 3.0}) {
    LoadingPlan plan = adaptive(), longer = plan;
    plan.end_strain = until;
    longer.end_strain = 0.6;
    LoadingState state, other;
    int segments = 0;
    for (; !at_end(plan, state); ++segments) {
      begin_segment(plan, {}, state);
      begin_segment(longer, {}, other);
      EXPECT_LE(state.end, until);
      if (state.end < until) {
        EXPECT_EQ(state.end, (segments + 1) * path_segment);
        EXPECT_EQ(state.steps, other.steps);
      }
      state.step = state.steps;
      finish_segment(plan, state);
      other.step = other.steps;
      finish_segment(longer, other);
    }
    EXPECT_EQ(path_strain(state), until);
    EXPECT_EQ(segments, static_cast<int>(std::ceil(until / path_segment - 1e-9)));
  }
}

// Before the first peak: 25 transits of the block even where it comes at 0.7 of the estimated strain, and 100 crossings
// of the widest hole.
TEST(LoadingPlan, TransitsBeforeTheFirstPeak) {
  const LoadingEstimate e = round_estimate();
  const double rate = allowed_rate(adaptive(), {});
  EXPECT_GE(0.7 * e.peak_strain / rate * e.wave_speed / 50e-3, 25.0 * (1.0 - 1e-12));
  EXPECT_GE(e.peak_strain / rate * e.wave_speed / 20e-3, 100.0 * (1.0 - 1e-12));
  // rho c h of a block of 50 mm, 1000 kg/m3 and 316 m/s: the impact stress of all verdicts is this times the rate.
  EXPECT_NEAR(adaptive().stress_per_rate, 1000.0 * std::sqrt(1e8 / 1000.0) * 50e-3, 1e-9 * 1e4);
  EXPECT_NEAR(allowed_rate(adaptive(50.0), {}), 0.5 * rate, 1e-12 * rate);  // twice the transits, half of every rate
  const SegmentMeasures rubble{0.0, 5e4, true};  // what rubble bears does not hang on the peak
  EXPECT_NEAR(allowed_rate(adaptive(50.0), rubble), allowed_rate(adaptive(), rubble), 1e-12 * rate);
}

TEST(LoadingController, SlowsWithMotionAndSpeedsUpWithTheStressOfTheRubble) {
  const LoadingPlan plan = adaptive();
  for (const bool passed : {false, true})
    for (const double stress : {0.0, 1e4, 1e6}) {
      double last = allowed_rate(plan, {0.0, stress, passed});
      const double at_rest = last;
      for (double power = 1e-3; power < 1e9; power *= 2.0) {
        const double rate = allowed_rate(plan, {power, stress, passed});
        EXPECT_LE(rate, last);
        last = rate;
      }
      EXPECT_LT(last, 0.5 * at_rest);
      EXPECT_GT(last, 0.0);
    }
  double last = 0.0;
  for (double stress = 0.0; stress < 1e8; stress = 2.0 * stress + 1e3) {
    const double rate = allowed_rate(plan, {0.0, stress, true});
    EXPECT_GE(rate, last);
    EXPECT_LE(rate, plan.fastest_rate);
    last = rate;
  }
  EXPECT_EQ(last, plan.fastest_rate);
  // The stress before the first peak is no reason to hurry.
  EXPECT_EQ(allowed_rate(plan, {0.0, 1e6, false}), allowed_rate(plan, {}));
  // Behind it the impact stress is the stated part of what is carried, at least 1 % of the estimated peak.
  EXPECT_NEAR(allowed_rate(plan, {0.0, 2e5, true}) * plan.stress_per_rate, 0.1 * 2e5, 1e-9 * 2e5);
  EXPECT_NEAR(allowed_rate(plan, {0.0, 0.0, true}) * plan.stress_per_rate,
              0.01 * round_estimate().modulus * round_estimate().peak_strain, 1e-9 * 1e6);
}

// Whatever is measured: the rate changes by at most the stated factors (one step more or less of a segment aside), the
// segments' strains add up exactly, and H goes down in every step.
TEST(LoadingController, RandomMeasures) {
  const LoadingPlan plan = adaptive();
  test::Uniform u(7);
  LoadingState state;
  double last_strain = 0.0;
  for (int k = 1; k <= 800; ++k) {
    const double before = state.rate;
    begin_segment(plan, {std::exp(u(-5.0, 20.0)), 1e5 + state.mean_stress, k > 200}, state);
    EXPECT_EQ(state.steps, std::floor(state.steps));
    EXPECT_NEAR(state.rate * state.steps * plan.time_step, plan.segment_strain, 1e-12 * plan.segment_strain);
    if (before > 0.0) {
      EXPECT_LE(state.rate, largest_speed_up * before * (1.0 + 1e-8));
      EXPECT_GE(plan.segment_strain / ((state.steps - 1.0) * plan.time_step),
                largest_slow_down * before * (1.0 - 1e-8));
    }
    for (int n = static_cast<int>(state.steps); n > 0; --n) {
      state.step += 1.0;
      state.stress_sum += u(0.0, 1e6);
      EXPECT_GT(path_strain(state), last_strain);
      last_strain = path_strain(state);
    }
    finish_segment(plan, state);
    EXPECT_EQ(path_strain(state), last_strain);
    EXPECT_EQ(last_strain, k * path_segment);
  }
}

// From the slowest rate back to rest: log(8)/log(1.25) = 9.3 segments.
TEST(LoadingController, ComesBackWithinTenSegments) {
  const LoadingPlan plan = adaptive();
  LoadingState state;
  for (int k = 0; k < 8; ++k) begin_segment(plan, {1e9, 2e5, true}, state);
  const double slow = state.rate;
  for (int k = 0; k < 10; ++k) begin_segment(plan, {0.0, 2e5, true}, state);
  EXPECT_GT(state.rate, 7.0 * slow);
  const double rest = 0.1 * 2e5 / plan.stress_per_rate;
  EXPECT_NEAR(state.rate, rest, 0.05 * rest);  // whole steps: some twenty a segment
}

/// A small solid block on an adaptive path, fast enough to break within a thousand steps.
Simulation driven(const geometry::Packing& packing, int threads) {
  SolverOptions options;
  SimulationInput input;
  input.clipped = &packing;
  input.network = make_bond_network(packing, test::no_holes(packing), options.material, options.noise, 1, 0.5e-3);
  input.masses = make_masses(packing, input.network, options.material, options.dynamics);
  const double step = options.dynamics.step_factor * input.masses.critical_step;
  LoadingEstimate estimate =
      estimate_loading(input.network, input.masses, options, packing.width, packing.height, 0.0, 0.5e-3);
  options.loading.transits = 4.0;
  estimate.rate = estimate.peak_strain * estimate.wave_speed / (options.loading.transits * packing.height);
  input.loading = plan_loading(estimate, options.loading, {packing.width, packing.height, 0.0}, step);
  input.time_step = input.loading.time_step;
  input.cell.start = {packing.width, 0.0, packing.height};
  input.options = options;
  input.mean_diameter = 0.5e-3;
  input.threads = threads;
  return Simulation(std::move(input));
}

void steps(Simulation& s, std::int64_t until) {
  while (s.steps() < until) {
    s.step();
    if (s.strain() > 0.02 && !s.peak_frozen()) s.freeze_peak();
  }
}

TEST(DrivenSimulation, SameBitsForThreadsAndARestartInTheMiddleOfASegment) {
  const geometry::Packing packing = test::jittered_packing(14, 0.5e-3, 3);
  constexpr std::int64_t cut = 1000, end = 2500;
  Simulation one = driven(packing, 1), two = driven(packing, 2), copied = driven(packing, 1);
  steps(copied, cut);
  while (copied.loading().step < 1.0) copied.step();
  EXPECT_LT(copied.loading().step, copied.loading().steps);
  Simulation resumed = driven(packing, 2);
  resumed.restore(copied.snapshot());
  for (Simulation* s : {&one, &two, &resumed}) steps(*s, end);
  EXPECT_GT(one.events().size(), 100u);
  EXPECT_GT(one.loading().segment, 50.0);
  for (const Simulation* s : {&two, &resumed}) {
    EXPECT_EQ(s->discs().sx, one.discs().sx);
    EXPECT_EQ(s->discs().vy, one.discs().vy);
    EXPECT_EQ(s->strain(), one.strain());
    EXPECT_EQ(s->loading().rate, one.loading().rate);
    EXPECT_EQ(s->loading().mean_stress, one.loading().mean_stress);
    EXPECT_EQ(s->ledger().external_work, one.ledger().external_work);
  }
  // Work is summed over the very path: the ledger closes as at a constant rate (test_dynamics.cpp).
  EXPECT_NEAR(one.ledger().external_work, one.ledger().sum(), 0.01 * one.ledger().external_work);
}

// Energy thrown in slows the next segment; the same block left alone keeps its rate. A drift of all discs is no reason.
TEST(DrivenSimulation, ThrownDiscsSlowTheNextSegment) {
  const geometry::Packing packing = test::jittered_packing(14, 0.5e-3, 3);
  Simulation still = driven(packing, 1), thrown = driven(packing, 1), drifting = driven(packing, 1);
  test::Uniform u(5);
  for (std::size_t d = 0; d < thrown.discs().vx.size(); ++d) {
    thrown.discs().vx[d] = u(-1.0, 1.0);
    drifting.discs().vx[d] = 1.0;
  }
  EXPECT_LT(drifting.kinetic_energy_at_half_step(), 1e-12 * thrown.kinetic_energy_at_half_step());
  for (Simulation* s : {&still, &thrown, &drifting}) s->step();
  EXPECT_LT(thrown.loading().rate, 0.6 * still.loading().rate);
  EXPECT_EQ(drifting.loading().rate, still.loading().rate);
}

}  // namespace
}  // namespace perfora::solver
