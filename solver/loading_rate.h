// What is here: the loading rate as a controlled quantity: the strain path in segments, and the rate of the next
// segment from what the last one measured (docs/user/theory.md, "Loading rate"). What is not: the measuring
// (simulation.cpp), the estimate that a plan rests on (mass.h).
#pragma once

#include <cstdint>

namespace perfora::solver {

struct LoadingEstimate;  // mass.h
struct LoadingOptions;   // options.h

/// What the rates of a run follow from; nothing of it changes while the run goes on. Rates in 1/s.
struct LoadingPlan {
  double segment_strain = 0.0;  ///< engineering; 0: no plan, the cell moves by itself (cell.h)
  double end_strain = 0.0;      ///< where the path ends, the last segment shorter than the others; 0: nowhere
  double time_step = 0.0;       ///< s
  bool adaptive = false;
  double start_rate = 0.0;       ///< constant: the rate; adaptive: at most this before the first peak has passed
  double impact_ratio = 0.0;     ///< adaptive: after the first peak, impact stress over the stress carried, at most
  double least_impact = 0.0;     ///< adaptive: impact stress that is always allowed, so that the run goes on, Pa
  double fastest_rate = 0.0;     ///< adaptive: never more
  double stress_per_rate = 0.0;  ///< impact stress of the block over the rate: bulk density x wave speed x height, Pa s
  double peak_stress = 0.0;      ///< estimated, of the first peak, Pa
  double area = 0.0;             ///< of the block at the start, m2
};

/// Where on its path a run is. Doubles throughout, so that a checkpoint is one dataset; whole numbers in them are
/// exact.
struct LoadingState {
  double segment = 0.0;         ///< segments finished
  double last_begin = 0.0;      ///< engineering strain at which the last one began,
  double begin = 0.0;           ///< the present one begins,
  double end = 0.0;             ///< and ends
  double step = 0.0;            ///< steps done in it
  double steps = 0.0;           ///< its steps; 0: it has yet to begin
  double rate = 0.0;            ///< its rate, 1/s
  double stress_sum = 0.0;      ///< of its steps so far, Pa
  double segment_stress = 0.0;  ///< mean of the last finished segment, Pa
  double mean_stress = 0.0;     ///< running mean of the stress over the last strain, Pa
  double motion = 0.0;          ///< energy that had gone into motion when the segment began, J per metre of depth
};

/// What the controller looks at when a segment is over.
struct SegmentMeasures {
  double motion_power = 0.0;  ///< energy that went into motion over the time it took, W per metre of depth
  double mean_stress = 0.0;   ///< along the loading, running mean, Pa
  bool peak_passed = false;
};

/// Engineering strain of the path: a closed function of segment and step.
inline double path_strain(const LoadingState& state) {
  if (state.steps == 0.0) return state.begin;
  return state.step == state.steps ? state.end : state.begin + state.step / state.steps * (state.end - state.begin);
}
/// Whether the path is at its end.
inline bool at_end(const LoadingPlan& plan, const LoadingState& state) {
  return plan.end_strain > 0.0 && state.begin >= plan.end_strain;
}

/// Rate that the measures allow (docs/user/theory.md, "Loading rate"), without regard to the rate before.
double allowed_rate(const LoadingPlan& plan, const SegmentMeasures& measures);

/// Ends the present segment: its mean stress goes into the running mean.
void finish_segment(const LoadingPlan& plan, LoadingState& state);

/// What the last segment measured. `motion`: all energy that has gone into motion so far, J per metre of depth: the
/// kinetic (the drift of all discs together left out) and what damping and dashpots have taken from it.
SegmentMeasures measure_segment(const LoadingPlan& plan, double motion, bool peak_passed, LoadingState& state);

/// Begins a segment, to the next multiple of plan.segment_strain or to the end of the path: the allowed rate, no more
/// than `largest_speed_up` and no less than `largest_slow_down` times the last one, rounded down to a whole number of
/// steps.
void begin_segment(const LoadingPlan& plan, const SegmentMeasures& measures, LoadingState& state);
inline constexpr double largest_speed_up = 1.25;
inline constexpr double largest_slow_down = 0.5;

/// Strain of a segment. What is written, and how finely, changes nothing of the path.
inline constexpr double path_segment = 6.25e-5;

/// The plan of a constant rate (1/s): the step is shortened from `longest_step` (s) so that a whole number of them
/// makes a segment; where one step makes more than `path_segment`, segments are the multiple of it that holds one.
LoadingPlan constant_loading(double rate, double longest_step);

/// The plan that the options ask for, of a block without its edges' surroundings: width and height in m, holes up to
/// `largest_hole` wide (m; 0: none).
struct LoadedBlock {
  double width = 0.0, height = 0.0, largest_hole = 0.0;
};
LoadingPlan plan_loading(const LoadingEstimate& estimate, const LoadingOptions& options, const LoadedBlock& block,
                         double longest_step);

/// Steps to the end of the plan: counted for a constant rate; for an adaptive one those of a block whose
/// stress takes the common course of perforated blocks, with the bulk's `solid_fraction`. Good to some twenty per cent;
/// never more than most_counted_steps.
inline constexpr double most_counted_steps = 9e15;  ///< whole numbers below are exact in a double
std::int64_t expected_steps(const LoadingPlan& plan, const LoadingEstimate& estimate, double solid_fraction);

}  // namespace perfora::solver
