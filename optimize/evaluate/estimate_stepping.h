// What is here: time step a run would take, and what its rate follows from, from a small patch of discs instead of the
// packing. What is not: counts (estimate.h).
#pragma once

#include <vector>

#include "geometry/perforation.h"
#include "solver/mass.h"
#include "solver/options.h"

namespace perfora::optimize {

/// What the patch is made of.
struct PatchDiscs {
  double density = 0.0;           ///< discs per area of the unclipped packing, 1/m2
  double mean_diameter = 0.0;     ///< <d> that the horizon is stated in, m
  double bonds_per_disc = 0.0;    ///< expected for the block, edges included
  std::vector<double> diameters;  ///< a sample of the sizes, m; not empty
};

struct SteppingEstimate {
  double time_step = 0.0;           ///< s, the longest the solver would take
  solver::LoadingEstimate loading;  ///< what the rate follows from
};

/// Asks the solver itself (estimate_run, estimate_loading) about a shaken triangular lattice of some hundred discs
/// without holes, and corrects for the bonds that the block's edges miss. Cost: some ten milliseconds at a horizon
/// of 3.
SteppingEstimate estimate_stepping(const solver::SolverOptions& options, const geometry::PerforationLayout& layout,
                                   const PatchDiscs& discs);

}  // namespace perfora::optimize
