// What is here: what a design would take, from counts and closed forms alone: discs, bonds, steps, memory, disk, time.
// What is not: any packing or run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "optimize/evaluate/design.h"

namespace perfora::optimize {

/// Expected numbers of one evaluation. Discs and bonds are good to a few per cent, steps to some twenty per cent,
/// seconds to a factor of two.
struct DesignEstimate {
  std::int64_t perforations = 0;
  std::int64_t discs = 0;  ///< left by the perforations
  double bonds_per_disc = 0.0;
  std::int64_t bonds = 0;
  std::int64_t steps = 0;
  double time_step = 0.0;  ///< s
  double rate = 0.0;       ///< 1/s
  double memory_bytes = 0.0, disk_bytes = 0.0, seconds = 0.0;
  double porosity = 0.0;               ///< fraction of the perforations
  double horizon_radius = 0.0;         ///< r_H, m
  double characteristic_length = 0.0;  ///< E G/sigma_t^2 of the material, m
  geometry::ThinnestWall thinnest_wall;
};

/// `design` must be valid (DesignFile::validate). `threads` >= 1. Cost: milliseconds (an imported packing is read).
DesignEstimate estimate_design(const DesignFile& file, int threads);

/// What a user should know before a run of this cost is started, a sentence each: more than a year of time.
std::vector<std::string> cost_warnings(const DesignEstimate& estimate);

/// What is wrong with a run that would take more than `allowed` bytes of memory, with the diameter of discs that would
/// fit; empty: nothing is.
std::string memory_problem(const DesignFile& file, const DesignEstimate& estimate, double allowed);
/// The same of a design that is not estimated yet.
std::string memory_problem(const DesignFile& file, double allowed);

/// What a run of this design costs, looked at before it starts: cost_warnings(); throws io::InputError where it would
/// take more than `memory` bytes. `design` must be valid.
std::vector<std::string> check_cost(const DesignFile& design, int threads, double memory);

/// E G/sigma_t^2 of the solid material with discs of this mean diameter, m: as measured
/// (material.characteristic_length, which grows with the discs), or estimated as 13 <d> (horizon/3)^1.4, which tension
/// tests of solid samples without noise gave within a third (docs/user/theory.md, "Grade, strength, scale"). Neither
/// grade nor strength changes it.
double characteristic_length(const solver::MaterialOptions& material, double mean_diameter);

/// Mean bonds per disc of a packing with `density` discs per area (1/m2), bond radius `radius`, outside the
/// perforations of `layout` (walls no thinner than `radius`). Pairs of a random-looking packing at distance up to r, in
/// closed form: density x the mean over distances h <= r of the area shared by the solid and the solid moved by h (set
/// covariance; lens area of each hole), minus the disc itself.
double expected_bonds_per_disc(const geometry::PerforationLayout& layout, double density, double radius);

/// Bonds that edges with no periodic image cut: of random pairs at distances up to r, (2/3) density^2 r^3 cross a line
/// of unit length, here the parts of the edges that lie in the solid.
double bonds_cut_by_edges(const geometry::PerforationLayout& layout, const solver::BoundaryOptions& boundary,
                          double density, double radius);

}  // namespace perfora::optimize
