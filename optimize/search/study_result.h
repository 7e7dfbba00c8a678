// What is here: what a study leaves behind: the JSON record, best.toml, evaluations.csv. What is not: pictures
// (report/), the search.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "optimize/search/study_run.h"
#include "results/verdict.h"

namespace perfora::optimize {

/// schema "perfora.optimize/1". SI; null for what is not known. All but `performance` depends on the study only, never
/// on workers, stops or kills.
nlohmann::json to_json(StudyRun& run);

/// The verdict on the best design: on the fresh seeds where they were run, else on those of the search. Nothing without
/// a best design or a wish.
std::optional<results::Verdict> verdict_of(StudyRun& run);

/// The best design as a design file, with what was found as comments. Empty without a best design.
std::string best_toml(StudyRun& run);

/// One line a point of the search, in the order of arms and points: stage, arm, number, values, score and what it is
/// made of; empty where not known.
std::string evaluations_csv(StudyRun& run);

/// Writes result.json, best.toml (where there is one), evaluations.csv and study.json (what its picture shows) into the
/// study's folder, each whole.
void write_results(StudyRun& run);

/// Evaluates the best design once more (replicate 0), with its frames, into DIR/best.h5; goes on where an earlier call
/// for the same design was stopped. The search itself keeps coarse curves only. Threads, cancellation, command line and
/// progress are those of `options`. Only for a run with a best design.
Evaluation evaluate_best(const StudyRun& run, EvaluateOptions options);

}  // namespace perfora::optimize
