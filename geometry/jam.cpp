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
/// Each stage keeps this share of the distance to the extrapolated jamming scale; less loses contact, more costs
/// stages.
constexpr double stage_share = 0.2;
constexpr double largest_share = 0.9;
/// The last stage aims at this share of the overlap limit.
constexpr double aimed_share = 0.65;
/// Force balance on the way, and of the jammed state.
constexpr double early_residual = 1e-2;
constexpr double final_residual = 5e-3;
/// Largest overlap ratio at which contact counts as lost: the scale was lowered too far.
constexpr double negligible_overlap = 0.1 * overlap_limit;
/// The first slope of the pressure, over its affine upper bound.
constexpr double affine_share = 0.6;
constexpr int maximum_stages = 60;

double area_fraction(const SoftDiscs& discs) {
  double area = 0.0;
  for (double r : discs.radius) area += std::numbers::pi * r * r;
  return area / (discs.width * discs.height);
}

/// Minimises at `scale`, well balanced where the state may be the last one.
OverlapState settle(OverlapMinimiser& minimiser, double scale, JamResult& result) {
  StopRule rule;
  rule.residual = early_residual;
  rule.negligible_overlap = negligible_overlap;
  OverlapState state = minimiser.minimise(scale, rule);
  result.iterations += state.iterations;
  if (state.max_overlap_ratio > negligible_overlap && state.max_overlap_ratio < 1.2 * overlap_limit) {
    rule.residual = final_residual;
    state = minimiser.minimise(scale, rule);
    result.iterations += state.iterations;
  }
  return state;
}

}  // namespace

JamResult jam(OverlapMinimiser& minimiser, const std::function<void(double)>& progress) {
  JamResult result;
  double scale = std::sqrt(start_fraction / area_fraction(minimiser.discs()));
  double tight_scale = 0.0, tight_pressure = 0.0, slope = 0.0, wanted_pressure = 0.0;
  for (int stage = 0; stage < maximum_stages; ++stage) {
    const OverlapState state = settle(minimiser, scale, result);
    if (progress) progress(std::min(1.0, (stage + 1) / 5.0));
    result.scale = scale;
    result.max_overlap_ratio = state.max_overlap_ratio;
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
    if (tight_scale > scale && tight_pressure > state.pressure)
      slope = (tight_pressure - state.pressure) / (tight_scale - scale);
    else
      slope = affine_share * state.stiffness / scale;
    tight_scale = scale;
    tight_pressure = state.pressure;
    const double share = std::max(stage_share, aimed_share * overlap_limit / state.max_overlap_ratio);
    wanted_pressure = std::min(share, largest_share) * state.pressure;
    scale -= (state.pressure - wanted_pressure) / slope;
  }
  return result;
}

}  // namespace perfora::geometry
