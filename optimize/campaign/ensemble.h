// What is here: N replicates of one design, their run files in one folder, and the statistics over them.
// What is not: one evaluation (evaluation.h), searches.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "optimize/evaluate/evaluation.h"
#include "results/judgement.h"
#include "results/statistic.h"

namespace perfora::optimize {

struct EnsembleOptions {
  /// Threads, packing_file (only for replicate 0's seed: refused when there are more), command line, progress,
  /// wall-time limit (of one replicate); run_file and resume are set here.
  EvaluateOptions evaluate;
  std::filesystem::path
      folder;           ///< made when missing; holds journal.jsonl, replicate-NNN.h5, ensemble.json, ensemble.csv
  int replicates = 0;   ///< replicates 0 .. replicates - 1
  bool resume = false;  ///< keep finished replicates of the same design; resume the one that was stopped
  bool force = false;   ///< throw away what an earlier ensemble left in the folder
  std::function<void()> results_written;  ///< called when those so far were, between replicates; may be empty
  /// Called when a replicate is finished or was found finished (`kept`). May be empty.
  std::function<void(const Evaluation&, const std::filesystem::path& run_file, bool kept)> finished;
};

struct Ensemble {
  results::RunStatus status =
      results::RunStatus::completed;  ///< stopped: a replicate was; failed: no replicate completed
  std::string reason;
  int wanted = 0;
  std::vector<Evaluation> replicates;           ///< finished ones (failed included), by number
  std::vector<results::Statistic> statistics;   ///< over the completed ones, NaN left out
  std::optional<results::Judgement> judgement;  ///< where the design wishes something and a replicate is finished
};

/// Evaluates the replicates one after another in this process (their runs take all threads). A killed ensemble goes on
/// where it was with `resume`.
/// Throws io::InputError for bad input, a folder that holds something else, or another design's ensemble.
Ensemble evaluate_ensemble(const DesignFile& design, const EnsembleOptions& options);

/// schema "perfora.ensemble/1".
nlohmann::json to_json(const Ensemble& ensemble);
/// One row a replicate, one column a result.
std::string ensemble_csv(const Ensemble& ensemble);

/// DIR/replicate-NNN.h5
std::filesystem::path replicate_run_file(const std::filesystem::path& folder, int replicate);

}  // namespace perfora::optimize
