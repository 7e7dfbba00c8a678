// What is here: the rate of the next segment of the strain path from the stress, power and rate of the last one.
#include "solver/loading_rate.h"

#include <algorithm>
#include <cmath>

#include "solver/mass.h"
#include "solver/options.h"

namespace perfora::solver {
namespace {

/// The peak comes up to a quarter earlier than estimated where many holes give the weakest wall more chances (Table 1:
/// 0.58 % for 0.77 %).
constexpr double peak_margin = 0.7;
/// Before the first peak a wave crosses the widest hole this many times for each transit of the block that is asked
/// for: a crack takes its time through a wall however high the block is.
constexpr double hole_crossings = 4.0;
/// Power that goes into motion, over that of loading at rest against the first peak's stress, at which the rate is
/// halved. Elastic loading makes 1e-4, collapsing rubble 1e-2, the avalanche of a first peak 1 to 10.
constexpr double motion_ratio = 0.1;
constexpr double slowest_ratio = 0.125;  // of the rate at rest: an avalanche need not be waited for to its last disc
/// Times the rate of `transits` transits before the first peak: there, too, a wave crosses the block within 0.1 %.
constexpr double fastest_ratio = 16.0;
constexpr double stress_memory = 5e-3;     // strain that the running mean of the stress looks back on
constexpr double segment_rounding = 1e-9;  // of a segment: a strain that is a multiple of it counts as one

/// What the avalanches after the first peak add to the steps that the rubble's stress alone would ask for: whole runs
/// to 60 % took 1.24 (quick.toml), 1.29 to 1.36 (2 x 2 holes at full resolution) and 1.33 times (Table 1) as many.
constexpr double avalanche_factor = 1.3;

/// Stress of rubble over the first peak at this fraction of the cell filled with discs: an exponential through what 2 x
/// 2 cells carry at 45 to 60 % strain.
double rubble_stress(double filled) {
  constexpr double steepness = 18.0, filled_at_peak = 0.77;
  return std::exp(steepness * (filled - filled_at_peak));
}

}  // namespace

double allowed_rate(const LoadingPlan& plan, const SegmentMeasures& measures) {
  if (!plan.adaptive) return plan.start_rate;
  double at_rest = plan.start_rate;
  if (measures.peak_passed)
    at_rest = std::min(plan.fastest_rate,
                       std::max(plan.least_impact, plan.impact_ratio * measures.mean_stress) / plan.stress_per_rate);
  const double loading_power = at_rest * plan.area * std::max(plan.peak_stress, measures.mean_stress);
  const double avalanche = std::max(0.0, measures.motion_power) / (motion_ratio * loading_power);
  return at_rest * std::max(slowest_ratio, 1.0 / (1.0 + avalanche));
}

void finish_segment(const LoadingPlan& plan, LoadingState& state) {
  const double weight = std::min(1.0, plan.segment_strain / stress_memory);
  state.segment_stress = state.stress_sum / state.steps;
  state.mean_stress += weight * (state.segment_stress - state.mean_stress);
  state.segment += 1.0;
  state.begin = state.end;
  state.step = state.steps = state.stress_sum = 0.0;
}

SegmentMeasures measure_segment(const LoadingPlan& plan, double motion, bool peak_passed, LoadingState& state) {
  const double rate = state.rate > 0.0 ? state.rate : plan.start_rate;
  SegmentMeasures measures;
  const double strain = state.begin > state.last_begin ? state.begin - state.last_begin : plan.segment_strain;
  measures.motion_power = (motion - state.motion) * rate / strain;
  measures.mean_stress = state.mean_stress;
  measures.peak_passed = peak_passed;
  state.motion = motion;
  return measures;
}

void begin_segment(const LoadingPlan& plan, const SegmentMeasures& measures, LoadingState& state) {
  double rate = allowed_rate(plan, measures);
  if (state.rate > 0.0) rate = std::clamp(rate, largest_slow_down * state.rate, largest_speed_up * state.rate);
  state.last_begin = state.begin;
  // A whole number of segments from the start, so that sums do not drift; a path that began between them joins in.
  state.end = (std::floor(state.begin / plan.segment_strain + segment_rounding) + 1.0) * plan.segment_strain;
  if (plan.end_strain > 0.0 && state.end > plan.end_strain - segment_rounding * plan.segment_strain)
    state.end = plan.end_strain;
  const double strain = state.end - state.begin;
  // A rate that fits a whole number of steps keeps it.
  state.steps = std::max(1.0, std::ceil(strain / (rate * plan.time_step) - segment_rounding));
  state.rate = strain / (state.steps * plan.time_step);
}

LoadingPlan constant_loading(double rate, double longest_step) {
  LoadingPlan plan;
  plan.segment_strain = path_segment * std::max(1.0, std::ceil(rate * longest_step / path_segment - segment_rounding));
  plan.start_rate = rate;
  plan.time_step =
      plan.segment_strain / (rate * std::ceil(plan.segment_strain / (rate * longest_step) - segment_rounding));
  return plan;
}

namespace {

LoadingPlan adaptive_loading(const LoadingEstimate& estimate, const LoadingOptions& options, const LoadedBlock& block,
                             double longest_step) {
  LoadingPlan plan;
  plan.adaptive = true;
  plan.segment_strain = path_segment;
  plan.time_step = longest_step;
  plan.fastest_rate = fastest_ratio * estimate.rate;
  plan.start_rate = peak_margin * estimate.rate;
  if (block.largest_hole > 0.0)
    plan.start_rate = std::min(plan.start_rate, estimate.peak_strain * estimate.wave_speed /
                                                    (hole_crossings * options.transits * block.largest_hole));
  plan.peak_stress = estimate.modulus * estimate.peak_strain;
  plan.impact_ratio = options.impact_ratio;
  plan.least_impact = options.least_impact * plan.peak_stress;
  plan.area = block.width * block.height;
  return plan;
}

}  // namespace

LoadingPlan plan_loading(const LoadingEstimate& estimate, const LoadingOptions& options, const LoadedBlock& block,
                         double longest_step) {
  const bool constant = options.rate > 0.0 || options.control == LoadingControl::constant;
  LoadingPlan plan = constant ? constant_loading(options.rate > 0.0 ? options.rate : estimate.rate, longest_step)
                              : adaptive_loading(estimate, options, block, longest_step);
  plan.stress_per_rate = estimate.bulk_density * estimate.wave_speed * block.height;
  plan.end_strain = options.until;
  return plan;
}

std::int64_t expected_steps(const LoadingPlan& plan, const LoadingEstimate& estimate, double solid_fraction) {
  LoadingState state;
  double steps = 0.0;
  while (!at_end(plan, state)) {
    SegmentMeasures measures;
    measures.peak_passed = state.begin > estimate.peak_strain;
    measures.mean_stress = plan.peak_stress * rubble_stress(solid_fraction / (1.0 - state.begin));
    begin_segment(plan, measures, state);
    steps += plan.adaptive && measures.peak_passed ? avalanche_factor * state.steps : state.steps;
    finish_segment(plan, state);
  }
  return std::llround(std::min(steps, most_counted_steps));
}

}  // namespace perfora::solver
