// What is here: what the model of a study says at its end, as JSON for result.json. What is not: the model
// (study_model.h).
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "optimize/search/candidate_store.h"

namespace perfora::optimize {

/// {"in_words", "trusted", "coverage", "recommended": {"label", "expected_score", "standard_error", "wishes":
/// probability that the means keep all of them, "success"}, "importance": {arm: {variable: {"first", "total"}}}}: the
/// design that the model recommends and the Sobol indices of the expected score over the bounds of its arm. `visited`:
/// the designs of the search and of its map. Without enough designs "in_words" and "trusted" alone.
nlohmann::json model_json(const CandidateStore& store, std::span<const Candidate* const> visited);

}  // namespace perfora::optimize
