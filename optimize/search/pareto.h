// What is here: the designs of a study that no other beats in everything the score weighs. What is not: the score
// (objective.h), its files (study_parts.h).
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "optimize/search/driver.h"

namespace perfora::optimize {

/// Rows that no other is better than or as good as in every column and better in one (Pareto), less being better. Rows
/// of one length, no NaN.
std::vector<bool> not_beaten(std::span<const std::vector<double>> rows);

struct ParetoMember {
  const Candidate* candidate = nullptr;
  int number = 0;  ///< among the answered points of the search, from 1; 0: a design of the map
  Score score;
  bool verified = false;  ///< run on seeds that it was not chosen by
};

/// The Pareto set in the objectives() of the target, of the designs with all replicates of the search that keep as many
/// wishes as any of them; those of the map where they were run as candidates are. Smallest score first. Empty with
/// fewer than two objectives.
std::vector<ParetoMember> pareto_set(const Study& study, const Plan& plan);

/// {"objectives": keys, "designs": [{"number", "label", "design", "score", "verified"}]}, null where there is no set.
nlohmann::json pareto_json(const Study& study, const Plan& plan);

}  // namespace perfora::optimize
