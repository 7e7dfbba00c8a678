// What is here: the model's words at the end of a study. What is not: other results (study_result.cpp).
#include "optimize/search/model_record.h"

#include "optimize/search/study_model.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

/// Points of an estimate of Sobol indices: they are read to a tenth.
constexpr int importance_points = 64;

json importance_json(StudyModel& model, const Study& study, int arm) {
  const model::SobolIndices indices = model.importance(arm, importance_points);
  json variables = json::object();
  for (std::size_t k = 0; k < study.variables.size(); ++k)
    variables[study.variables[k].key] = {{"first", indices.first[k]}, {"total", indices.total[k]}};
  return {{study.arms[static_cast<std::size_t>(arm)].name, variables}};
}

}  // namespace

json model_json(const CandidateStore& store, std::span<const Candidate* const> visited) {
  const Study& study = store.study();
  StudyModel model(store, visited, study.keys.replicates);
  json record = {{"in_words", model.in_words()}, {"trusted", model.trusted()}};
  if (!model.made()) return record;
  const std::vector<StudyModel::Ranked> ranked = model.ranked();
  record["coverage"] = model.learnt().coverage().share();
  if (ranked.empty()) return record;
  const StudyModel::Ranked& first = ranked.front();
  record["recommended"] = {{"label", first.candidate->label},
                           {"expected_score", first.answer.score},
                           {"standard_error", first.answer.score_error},
                           {"wishes", first.answer.wishes},
                           {"success", first.answer.success}};
  record["importance"] = importance_json(model, study, first.candidate->arm);
  return record;
}

}  // namespace perfora::optimize
