// What is here: many evaluations in a folder: studies, sweeps, calibrations, ensembles, run and read back. What is not:
// one evaluation (evaluate.h), tables of results read alone (results.h).
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "perfora/design.h"
#include "perfora/evaluate.h"
#include "perfora/results.h"

namespace perfora {

/// How a campaign is carried out.
struct CampaignOptions {
  std::filesystem::path folder;        ///< for its journal and results; made when missing. Must be given
  std::vector<std::string> overrides;  ///< "section.key=value" of the file or of the design that it names
  int workers = 0;                     ///< evaluations at once; 0: as the file says, or one a processor
  int threads = 0;                     ///< of all workers together; 0: one a processor
  bool resume = false;                 ///< go on with what the folder has; nothing finished is evaluated again
  bool force = false;                  ///< remove an earlier one of the same kind first
  /// The program perfora, whose worker processes then evaluate: a crash or lack of memory costs one evaluation. Empty:
  /// threads of this process evaluate.
  std::filesystem::path program;
  bool best_run_file = true;   ///< of a study: evaluate the best design once more, with its frames, into best.h5
  ProgressCallback progress;   ///< may be empty
  std::shared_ptr<Stop> stop;  ///< may be null; is requested where the callback says false, too
};

/// What is in the folder of a campaign.
struct Campaign {
  std::string kind;                   ///< "study", "sweep", "ensemble" or "calibration"
  std::filesystem::path folder;       ///< where it lies
  Status status = Status::completed;  ///< stopped also while it is under way
  std::string reason;                 ///< in words
  /// A row a candidate of a study (evaluations.csv), a case of a sweep (cases.csv), a replicate of an ensemble
  /// (ensemble.csv), a point of a calibration (reachable.csv); docs/user/formats.md names the columns. Empty before
  /// there is one.
  Table rows;
  /// The best design of a study, the design with the parameters that a calibration found; nothing of other kinds and
  /// before there is one.
  std::optional<Design> best;
  Verdict verdict;     ///< of a study (on fresh seeds) or an ensemble; a sweep has one a case, in `rows` and `record`
  std::string record;  ///< the JSON record of the result; empty before there is one
};

/// Runs the study, sweep or calibration of a file, what `perfora optimize`, `sweep` and `calibrate` do, but for
/// pictures and what stands beside run files. A stop keeps what is finished; the same call with `resume` goes on.
/// Throws Error for a file that is none of these and a folder that holds other work, or the same without `resume` or
/// `force`.
Campaign run_campaign(const std::filesystem::path& file, const CampaignOptions& options);

/// Evaluates replicates 0 to `replicates` - 1 of a design one after another, each with its run file in the folder, what
/// `perfora evaluate --replicates` does. Of the options `overrides`, `workers` and `program` do not count. Throws
/// Error.
Campaign run_ensemble(const Design& design, int replicates, const CampaignOptions& options);

/// Reads the folder of a campaign, finished or not. Throws Error for a folder of none.
Campaign read_campaign(const std::filesystem::path& folder);

}  // namespace perfora
