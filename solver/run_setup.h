// What is here: what follows from a request before the first step: bonds, masses, rate, step, rows. What is not: the
// run.
#pragma once

#include <cstdint>

#include "solver/bond_network.h"
#include "solver/loading_rate.h"
#include "solver/mass.h"
#include "solver/run_request.h"
#include "solver/specimen.h"

namespace perfora::solver {

/// Everything that follows from the request before the first step.
struct RunSetup {
  Specimen specimen;
  BondNetwork network;
  MassProperties masses;
  LoadingEstimate loading;
  LoadingPlan plan;
  double critical_step = 0.0;
};

LoadedBlock loaded_block(const geometry::PerforationLayout& layout);

/// Bonds the request's packing and chooses rate and step (docs/user/theory.md, "Motion"). Throws io::InputError when
/// nothing is bonded.
RunSetup set_up_run(const RunRequest& request);

/// Counts, step and mean rate of a run, without running (expected_steps of loading_rate.h); what they cost is estimated
/// in optimize/evaluate/estimate.h.
struct RunEstimate {
  std::int64_t discs = 0, bonds = 0, steps = 0;
  double time_step = 0.0, rate = 0.0;
};
RunEstimate estimate_run(const RunRequest& request);

}  // namespace perfora::solver
