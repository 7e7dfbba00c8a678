// What is here: what a sweep leaves behind: statistics a case, the JSON record, the tables. What is not: pictures
// (report/), the runs.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "optimize/campaign/ensemble.h"
#include "optimize/campaign/sweep_run.h"

namespace perfora::optimize {

/// What is known of one case.
struct CaseResult {
  int completed = 0, failed = 0;
  std::optional<results::Judgement> judgement;  ///< where the case's design wishes something and a replicate is known
  std::vector<results::Statistic> statistics;   ///< of sweep_measures(), in their order, over the completed replicates
  /// Statistics of (this - case 0) over the replicates that both have: same seeds, so that the scatter of packings
  /// falls out where the packing is the same. Empty without a case 0.
  std::vector<results::Statistic> changes;
};
CaseResult case_result(const SweepRun& run, const SweepCase& one);

/// schema "perfora.sweep/1". SI; null for what is not known.
nlohmann::json to_json(const SweepRun& run);

/// A row a case: number, label, keys, runs, then mean, standard deviation and half width of the 95 % interval of every
/// result; with a case 0 also the mean paired change and its half width.
std::string cases_csv(const SweepRun& run);
/// A row a run: case, label, keys, replicate, status, seeds, every result, wall time.
std::string runs_csv(const SweepRun& run);
/// A row a point of a curve: case, replicate, strain, stress (Pa), averaged over steps of 0.5 % strain above 3 %.
std::string curves_csv(const SweepRun& run);

/// Writes result.json and the three tables into the sweep's folder, each whole.
void write_results(const SweepRun& run);

}  // namespace perfora::optimize
