// What is here: decompression from above with the pressure extrapolated to zero (harmonic discs: pressure is nearly
// linear in the scale). What is not: forces and lists (overlap_minimiser.cpp).
#include "geometry/jam.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace perfora::geometry {

namespace {

/// Area of the discs over area of the cell at the start: enough above jamming (0.84 to 0.86) that the memory of the
/// start is lost.
constexpr double start_fraction = 0.90;
/// Each stage keeps this fraction of the distance to the extrapolated jamming scale; less loses contact, more costs
/// stages.
constexpr double stage_fraction = 0.2;
constexpr double largest_fraction = 0.9;
/// The last stage aims at this fraction of the overlap limit.
constexpr double aimed_fraction = 0.65;
/// Force balance on the way: with 0.03 the pressure of discs still on their way spoils the extrapolation, contact is
/// lost again and again, and more iterations are spent in the end.
constexpr double early_residual = 2e-2;
/// Force balance of the jammed state: the net force on a disc is a hundredth of a contact force.
constexpr double final_residual = 1e-2;
/// Largest overlap ratio at which contact counts as lost: the scale was lowered too far.
constexpr double negligible_overlap = 0.1 * overlap_limit;
/// The first slope of the pressure, over its affine upper bound.
constexpr double affine_fraction = 0.6;
constexpr int maximum_stages = 60;
/// Where the discs will be shrunk, overlaps up to this fraction of what the shrinking opens between two of them do no
/// harm, and the balance that matters is only that of the densest state.
constexpr double harmless_fraction = 0.25;
constexpr double rough_residual = 5e-2;

double area_fraction(const SoftDiscs& discs) {
  double area = 0.0;
  for (double r : discs.radius) area += std::numbers::pi * r * r;
  return area / (discs.width * discs.height);
}

/// Largest overlap ratio that does no harm in a state at `scale` that will be shrunk to `shrunk`; 0: the usual limits.
double harmless_overlap(double scale, double shrunk) {
  const double harmless = shrunk > 0.0 ? harmless_fraction * (1.0 - shrunk / scale) : 0.0;
  return harmless > overlap_limit ? harmless : 0.0;
}

/// Minimises at `scale`, well balanced where the state may be the last one.
OverlapState settle(OverlapMinimiser& minimiser, double scale, double harmless, JamResult& result) {
  StopRule rule;
  rule.residual = harmless > 0.0 ? rough_residual : early_residual;
  rule.negligible_overlap = std::max(negligible_overlap, harmless);
  OverlapState state = minimiser.minimise(scale, rule);
  result.iterations += state.iterations;
  if (harmless == 0.0 && state.max_overlap_ratio > negligible_overlap &&
      state.max_overlap_ratio < 1.2 * overlap_limit) {
    rule.residual = final_residual;
    state = minimiser.minimise(scale, rule);
    result.iterations += state.iterations;
  }
  return state;
}

/// Rise of the pressure with the scale: the chord to the tighter state before, or a guess.
double slope_of(const OverlapState& state, double scale, double tight_pressure, double tight_scale) {
  if (tight_scale > scale && tight_pressure > state.pressure)
    return (tight_pressure - state.pressure) / (tight_scale - scale);
  return affine_fraction * state.stiffness / scale;
}

}  // namespace

JamResult jam(OverlapMinimiser& minimiser, double shrunk, const std::function<void(double)>& progress) {
  JamResult result;
  double scale = std::sqrt(start_fraction / area_fraction(minimiser.discs()));
  double tight_scale = 0.0, tight_pressure = 0.0, slope = 0.0, wanted_pressure = 0.0;
  for (int stage = 0; stage < maximum_stages; ++stage) {
    const double harmless = harmless_overlap(scale, shrunk);
    const OverlapState state = settle(minimiser, scale, harmless, result);
    if (progress) progress(std::min(1.0, (stage + 1) / 5.0));
    result.scale = scale;
    result.max_overlap_ratio = state.max_overlap_ratio;
    if (harmless > 0.0 && state.max_overlap_ratio <= harmless) {
      // What is left of the pressure says how far away jamming is.
      if (state.pressure > 0.0) result.scale -= state.pressure / slope_of(state, scale, tight_pressure, tight_scale);
      result.reached = true;
      return result;
    }
    if (state.max_overlap_ratio <= negligible_overlap) {
      // Back up by what the wanted pressure needs, from here.
      scale += slope > 0.0 ? wanted_pressure / slope : overlap_limit * scale;
      tight_scale = 0.0;
      continue;
    }
    if (state.max_overlap_ratio <= overlap_limit) {
      result.reached = state.converged;
      return result;
    }
    slope = slope_of(state, scale, tight_pressure, tight_scale);
    tight_scale = scale;
    tight_pressure = state.pressure;
    const double fraction = std::max(stage_fraction, aimed_fraction * overlap_limit / state.max_overlap_ratio);
    wanted_pressure = std::min(fraction, largest_fraction) * state.pressure;
    scale -= (state.pressure - wanted_pressure) / slope;
  }
  return result;
}

}  // namespace perfora::geometry
