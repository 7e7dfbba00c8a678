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
/// Impact stress of the block over the stress that the rubble carries.
constexpr double stress_ratio = 0.2;
/// Power that goes into motion, over that of loading at rest against the first peak's stress, at which the rate is
/// halved. Elastic loading makes 1e-4, collapsing rubble 1e-2, the avalanche of a first peak 1 to 10.
constexpr double motion_ratio = 0.1;
constexpr double slowest_ratio = 0.125;  // of the rate at rest: an avalanche need not be waited for to its last disc
constexpr double fastest_ratio = 16.0;   // times the rubble's: there, too, a wave crosses the block within a row or two
constexpr std::int64_t adaptive_segments = 8;  // a row: a power of two, so that rows sit at exact strains
constexpr double stress_memory = 5e-3;         // strain that the running mean of the stress looks back on

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
                       std::max(plan.rubble_rate, stress_ratio * measures.mean_stress / plan.stress_per_rate));
  const double loading_power = at_rest * plan.area * std::max(plan.peak_stress, measures.mean_stress);
  const double avalanche = std::max(0.0, measures.motion_power) / (motion_ratio * loading_power);
  return at_rest * std::max(slowest_ratio, 1.0 / (1.0 + avalanche));
}

void finish_segment(const LoadingPlan& plan, LoadingState& state) {
  const double weight = std::min(1.0, plan.segment_strain / stress_memory);
  state.mean_stress += weight * (state.stress_sum / state.steps - state.mean_stress);
  state.segment += 1.0;
  state.step = state.steps = state.stress_sum = 0.0;
}

SegmentMeasures measure_segment(const LoadingPlan& plan, double motion, bool peak_passed, LoadingState& state) {
  const double rate = state.rate > 0.0 ? state.rate : plan.start_rate;
  SegmentMeasures measures;
  measures.motion_power = (motion - state.motion) * rate / plan.segment_strain;
  measures.mean_stress = state.mean_stress;
  measures.peak_passed = peak_passed;
  state.motion = motion;
  return measures;
}

void begin_segment(const LoadingPlan& plan, const SegmentMeasures& measures, LoadingState& state) {
  double rate = allowed_rate(plan, measures);
  if (state.rate > 0.0) rate = std::clamp(rate, largest_slow_down * state.rate, largest_speed_up * state.rate);
  constexpr double rounding = 1e-9;  // a rate that fits a whole number of steps keeps it
  state.steps = std::max(1.0, std::ceil(plan.segment_strain / (rate * plan.time_step) - rounding));
  state.rate = plan.segment_strain / (state.steps * plan.time_step);
}

LoadingPlan constant_loading(double rate, double row_strain, double longest_step) {
  LoadingPlan plan;
  plan.segment_strain = row_strain;
  plan.start_rate = rate;
  plan.time_step = row_strain / (rate * std::max(1.0, std::ceil(row_strain / (rate * longest_step))));
  return plan;
}

namespace {

LoadingPlan adaptive_loading(const LoadingEstimate& estimate, const LoadingOptions& options, const LoadedBlock& block,
                             double row_strain, double longest_step) {
  LoadingPlan plan;
  plan.adaptive = true;
  plan.segments_per_row = adaptive_segments;
  plan.segment_strain = row_strain / static_cast<double>(adaptive_segments);
  plan.time_step = longest_step;
  plan.rubble_rate = estimate.rate;
  plan.fastest_rate = fastest_ratio * estimate.rate;
  plan.start_rate = peak_margin * estimate.rate;
  if (block.largest_hole > 0.0)
    plan.start_rate = std::min(plan.start_rate, estimate.peak_strain * estimate.wave_speed /
                                                    (hole_crossings * options.transits * block.largest_hole));
  plan.stress_per_rate = estimate.bulk_density * estimate.wave_speed * block.height;
  plan.peak_stress = estimate.modulus * estimate.peak_strain;
  plan.area = block.width * block.height;
  return plan;
}

}  // namespace

LoadingPlan plan_loading(const LoadingEstimate& estimate, const LoadingOptions& options, const LoadedBlock& block,
                         double row_strain, double longest_step) {
  if (options.rate > 0.0) return constant_loading(options.rate, row_strain, longest_step);
  if (options.control == LoadingControl::constant) return constant_loading(estimate.rate, row_strain, longest_step);
  return adaptive_loading(estimate, options, block, row_strain, longest_step);
}

std::int64_t expected_steps(const LoadingPlan& plan, const LoadingEstimate& estimate, double until,
                            double solid_fraction) {
  constexpr double rounding = 1e-9;
  const auto segments = static_cast<std::int64_t>(std::ceil(until / plan.segment_strain - rounding));
  LoadingState state;
  double steps = 0.0;
  for (std::int64_t k = 0; k < segments; ++k) {
    SegmentMeasures measures;
    const double strain = static_cast<double>(k) * plan.segment_strain;
    measures.peak_passed = strain > estimate.peak_strain;
    measures.mean_stress = plan.peak_stress * rubble_stress(solid_fraction / (1.0 - strain));
    begin_segment(plan, measures, state);
    steps += plan.adaptive && measures.peak_passed ? avalanche_factor * state.steps : state.steps;
  }
  return std::llround(steps);
}

}  // namespace perfora::solver
