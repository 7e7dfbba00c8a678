// What is here: the model of a study: what its known evaluations say of any of its candidates. What is not: the model's
// parts (optimize/model/), which candidate is asked next (model_searcher.h).
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "optimize/model/response_model.h"
#include "optimize/model/sensitivity.h"
#include "optimize/model/target_answers.h"
#include "optimize/search/candidate_store.h"

namespace perfora::optimize {

/// Learns from what the store holds of the designs that were told to it and of `visited`, replicates below
/// `replicates`. A pure function of these; some seconds for a hundred designs.
class StudyModel {
 public:
  StudyModel(const CandidateStore& store, std::span<const Candidate* const> visited, int replicates);

  /// A target may be asked about where this is true; trusted() says whether a search should go by it.
  bool made() const { return learnt_.made(); }
  bool trusted() const { return learnt_.trusted(); }
  std::string in_words() const { return learnt_.in_words(); }
  const model::ResponseModel& learnt() const { return learnt_; }

  /// What is expected of a candidate that keeps the constraints. Worked out once, as long as the model is told nothing.
  const model::Answer& at(const Candidate& candidate);
  /// The same with the improvement over `best`.
  model::Answer against(const Candidate& candidate, double best);

  struct Ranked {
    const Candidate* candidate = nullptr;
    model::Answer answer;
  };
  /// The evaluated designs of the arms by what is expected at the first fidelity, lowest expected score first: the
  /// first is what the model recommends. The best score that was seen is no recommendation: the luckiest of many is
  /// seldom the best.
  std::vector<Ranked> ranked();
  /// The batch so far is as good as evaluated: told what is expected there.
  void expect(const Candidate& candidate);

  /// Names of the study's variables with first-order and total Sobol indices of the expected score over an arm's
  /// bounds; points that break a constraint count with the mean of those that keep it. `count`: points, a power of two.
  model::SobolIndices importance(int arm, int count);

 private:
  model::Inputs inputs_of(const Candidate& candidate);
  const CandidateStore& store_;
  std::vector<Observed> observed_;
  std::map<const Candidate*, model::Traits> traits_;
  model::ResponseModel learnt_;
  std::optional<model::TargetAnswers> answers_;
  std::map<const Candidate*, model::Answer> known_;
};

}  // namespace perfora::optimize
