// What is here: one evaluation of a design and the function that walks the whole way to it. What is not: its record
// and JSON form (results/evaluation.h, results/json.h), requests (request.h), processes
// (optimize/campaign/executor.h).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "geometry/packing.h"
#include "geometry/perforation.h"
#include "io/cancellation.h"
#include "optimize/evaluate/design.h"
#include "results/evaluation.h"
#include "results/json.h"
#include "results/progress.h"
#include "results/provenance.h"
#include "solver/run.h"

namespace perfora::optimize {

struct EvaluateOptions {
  int threads = 1;
  std::filesystem::path run_file;      ///< R.h5, empty: none
  std::filesystem::path packing_file;  ///< P.h5 to take the periodic packing from (its key must agree); empty: make it
                                       ///< or take it from memory
  bool resume = false;
  double wall_time_limit = 0.0;   ///< s, 0: none
  io::Cancellation cancellation;  ///< requested: the packing is given up, the compression writes a checkpoint and stops
  std::string command_line;
  results::ProgressCallback progress;  ///< of the packing, then of the compression; may be empty
};

/// Layout, periodic packing, clipped packing of one design and replicate, with what was measured on them.
struct PackedDesign {
  geometry::PerforationLayout layout;
  geometry::Packing periodic;
  geometry::Packing clipped;
  results::PackSummary summary;
};

using results::Evaluation;

/// Makes layout and packing (the packing is kept in memory per key and reused within this process; `packing_file` reads
/// it from a file) and clips. Throws io::InputError, and io::Cancelled once options.cancellation is requested; a
/// packing that was not reached shows in periodic.quality.
PackedDesign pack_design(const DesignFile& design, const EvaluateOptions& options, int replicate);

/// With options.resume a run that is finished is read from its file, an unfinished one goes on from its checkpoint.
/// The whole way Design -> PerforationLayout -> Packing -> clipped Packing -> BondNetwork -> Simulation -> Response.
/// Throws io::InputError for bad input only.
Evaluation evaluate_design(const DesignFile& design, const EvaluateOptions& options, int replicate);

/// An evaluation that gave nothing: status `failed`, every result not reached (a design that cannot be laid out, a
/// worker that died).
Evaluation failed_evaluation(const std::string& reason, int replicate, const Seeds::Effective& seeds = {});

/// What r_H and the overlaps of a run are stated in: <d> of the size law, or the mean of the discs of an imported
/// packing, m.
double mean_diameter_of(const DesignFile& design, const geometry::Packing& periodic);

/// Where a result of `design` comes from: this program, the command, the seeds, the resolved configuration.
results::Provenance provenance_of(const DesignFile& design, const Seeds::Effective& seeds,
                                  const std::string& command_line);

/// What a run itself says against its numbers (docs/user/theory.md, "Ledger"), a sentence each; `loading` is the
/// design's.
std::vector<std::string> validity_warnings(const Evaluation& evaluation, const solver::LoadingOptions& loading);

/// The record of one evaluation of `design`, without its curve, with what is said against the design and the run
/// (`warnings`), and with the verdict where the design wishes something (one block shows little: results/verdict.h).
/// schema "perfora.evaluate/1".
nlohmann::json evaluation_record(const DesignFile& design, const Evaluation& evaluation);

/// Throws io::InputError unless `packing_file` holds the periodic packing that `design` and `replicate` ask for; what
/// --packing is checked with before work starts.
void require_packing_file(const DesignFile& design, const std::filesystem::path& packing_file, int replicate);

/// The evaluation a finished run file holds, when it is one of this design, seeds and strain; nothing when the file is
/// missing or its run was stopped. Throws io::InputError when it is a finished run of another configuration.
std::optional<Evaluation> finished_evaluation(const DesignFile& design, const std::filesystem::path& run_file,
                                              int replicate);

using results::number;

}  // namespace perfora::optimize
