// What is here: the score of a candidate: how far its plateau lies from the target, averaged over replicates.
// What is not: constraints on the layout (constraints.h), the search.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/schema.h"
#include "optimize/evaluate/evaluation.h"

namespace perfora::optimize {

/// [target] of a study.
struct TargetKeys {
  double plateau_stress = 0.0;                ///< Pa; must be given
  std::vector<double> window = {0.20, 0.40};  ///< engineering strain over which the plateau is measured
  double weight_std = 1.0;                    ///< w_std
  double weight_undulation = 0.0;             ///< w_undulation
  double weight_peak = 0.0;                   ///< w_peak
};

void describe(io::Schema& schema, TargetKeys& keys);

/// A candidate with any failed replicate scores this: worse than every candidate that could be simulated, better than
/// one that breaks a constraint.
inline constexpr double failed_score = 750.0;
/// Scores of simulated candidates end here, so that the order above always holds.
inline constexpr double largest_score = 500.0;

struct Score {
  double value = failed_score;  ///< always finite
  bool valid = false;           ///< false: at least one replicate failed or has no plateau
  int replicates = 0, failed = 0;
  std::string reason;  ///< of the first failure
  double plateau_mean = 0.0,
         plateau_std = 0.0;  ///< Pa, over the replicates that gave one; std with n - 1, 0 for one replicate
  double undulation_mean = 0.0;
  double first_peak_mean = 0.0;  ///< Pa
};

/// score = ((mean plateau - target)/target)^2 + w_std (std/target)^2 + w_undulation (mean undulation)^2 + w_peak
/// (max(0, mean first peak - target)/target)^2, cut at `largest_score`. Terms whose weight is 0 are left out.
/// `replicates` holds no null pointer; empty: a failure.
Score score_of(const TargetKeys& target, std::span<const Evaluation* const> replicates);

/// Whether an evaluation gave a plateau.
bool usable(const Evaluation& evaluation);

}  // namespace perfora::optimize
