// What is here: the score of a candidate: how far its curves lie from what is wished, averaged over replicates.
// What is not: wishes (results/target.h), whether they are met (results/verdict.h), constraints on the layout
// (constraints.h), the search.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "optimize/evaluate/evaluation.h"
#include "results/target.h"

namespace perfora::optimize {

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
  int wishes = 0, not_kept = 0;  ///< wishes of the target, and those that the means do not keep; 0 where invalid
  double of_wishes = 0.0;        ///< their part of the value
  std::vector<double> terms;     ///< of objectives(target), means over the replicates, without weights; or empty
  std::vector<double> recorded;  ///< means of results::recorded_measures(target), NaN where none was reached
};

/// Sum over the measures of weight x mean over the replicates of the measure's term (results::Term), plus, for every
/// wish that the means do not keep, weight.limits x ((ln floor)^2 + (ln(mean/bound))^2), cut at `largest_score`: designs
/// that keep more wishes come first, then those that come closer. The terms belong to each replicate's own curve. A
/// stress or ratio below target.floor (of the target, of 1) counts as that; a measure that was not reached counts as
/// (ln floor)^2. Source: docs/user/theory.md, "Score".
/// `replicates` holds no null pointer; empty: a failure.
Score score_of(const results::Target& target, std::span<const Evaluation* const> replicates);

/// The measures whose terms the score weighs, in the order of the table of measures.
std::vector<const results::Measure*> objectives(const results::Target& target);

/// ", 3 of 4 wishes kept"; empty where there are none.
std::string wishes_text(const Score& score);

/// Whether an evaluation can be scored: completed, with a plateau where one is measured within a window.
bool usable(const Evaluation& evaluation);

}  // namespace perfora::optimize
