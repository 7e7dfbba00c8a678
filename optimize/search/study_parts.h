// What is here: parts of the record of a study: candidates, scores, the race, the verification, the map, what more
// would buy. What is not: the record put together, its files (study_result.h).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "optimize/search/study_run.h"
#include "results/assurance.h"

namespace perfora::optimize {

nlohmann::json score_json(const Score& score);
/// Values of the keys that the study varies.
nlohmann::json design_values(const Study& study, const Candidate& candidate);
/// What a study's record holds of map, plan, race, verified designs and single blocks, as far as there is any.
nlohmann::json end_json(StudyRun& run);

/// A row a design of map, start and search: stage, arm, number, variables, status, replicates, mean and standard
/// deviation of every measure, why it failed or was not run.
std::string candidates_csv(StudyRun& run);

/// The recommended design where it is neither a point of the search nor the start: of the map, or known from a wish
/// before this one.
std::optional<Visit> best_beside_search(const Plan& plan);

/// The best design's blocks on the seeds of the verification; without a full set of them empty.
std::vector<const Evaluation*> fresh_blocks(StudyRun& run);

/// Sentences that a reader should know beside the verdict: that the start is recommended or keeps more wishes, that the
/// fidelity of the search gives another plateau than the verification.
std::vector<std::string> remarks(StudyRun& run);

/// A sentence each: how many more runs would decide a wish that is not shown, and what they take.
std::vector<std::string> what_more_would_buy(StudyRun& run);

}  // namespace perfora::optimize
