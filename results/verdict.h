// What is here: whether the wishes of a target are met, as one pure function of evaluations. What is not: the wishes
// (target.h), the intervals (interval.h), scores of a search (optimize/search/objective.h).
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "results/evaluation.h"
#include "results/interval.h"
#include "results/stress_cap.h"
#include "results/target.h"

namespace perfora::results {

enum class Outcome {
  met,           ///< the whole interval keeps the wish
  missed,        ///< the whole interval breaks it
  not_shown,     ///< these seeds tell neither
  out_of_reach,  ///< missed, and by every candidate that was tried, on one side
};
const char* outcome_name(Outcome outcome);

struct WishVerdict {
  Wish wish;
  Outcome outcome = Outcome::not_shown;
  int count = 0;                                ///< replicates with this measure
  int missing = 0;                              ///< completed replicates without it (no plateau was found, ...)
  double mean = not_reached;                    ///< SI
  Interval interval{not_reached, not_reached};  ///< of the statement; unknown for fewer than two values
  std::string text;  ///< "plateau stress 370 kPa (95 %: 310 to 430 kPa), wished 1.2 to 1.8 MPa: 69 % too low"
};

/// Fewer designs say nothing of what is out of reach.
inline constexpr int fewest_tried = 5;

/// What the candidates of a search reached of one wished measure: smallest and largest mean.
struct Reach {
  const Measure* measure = nullptr;
  int candidates = 0;
  double low = 0.0, high = 0.0;
};

struct Verdict {
  Outcome outcome = Outcome::not_shown;
  Statement statement = Statement::mean;
  double fraction = 0.9;  ///< for Statement::block
  int replicates = 0, failed = 0;
  bool fresh = true;                  ///< false: on the seeds that chose the design, which flatter it
  double impact_ratio = not_reached;  ///< mean over the replicates
  double largest_overlap = 0.0;       ///< of their whole runs, over <d>
  std::vector<WishVerdict> wishes;    ///< in the order of results::wishes(); never empty
  std::vector<StressCap> caps;        ///< of these wishes, for pictures
  std::string text;                   ///< one line: outcome, then the wishes that decide it
  std::string note;                   ///< what the numbers are worth beyond their scatter
};

/// The verdict on replicates of one design (no null pointers). A wish is met where the interval of the statement
/// (interval.h) lies within its range, missed where the interval of the mean lies outside, else not shown, as it is
/// with fewer than `fewest_replicates`. Wishes of the packing are compared as they are. A design meets its target where
/// every wish is met (an intersection-union test: no correction for their number), misses it where one is missed.
/// A failed replicate, or seeds that are not `fresh`, leave nothing met. `reach`: of a search, for out_of_reach.
/// `target` has a wish. Formulas: docs/user/theory.md, "Verdict".
Verdict verdict_on(const Target& target, std::span<const Evaluation* const> replicates, bool fresh = true,
                   std::span<const Reach> reach = {});

nlohmann::json to_json(const Verdict& verdict);

}  // namespace perfora::results
