// What is here: the known evaluations of a study as candidates with their scores: what a search is told.
// What is not: which candidates are requested (searcher.h), the journal (campaign/evaluation_queue.h).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "optimize/evaluate/answers.h"
#include "optimize/search/candidate.h"
#include "optimize/search/objective.h"

namespace perfora::optimize {

/// One point that a search requested.
struct Visit {
  const Candidate* candidate = nullptr;
  bool answered = false;  ///< false: waits for its simulations
  double score = 0.0;     ///< finite; with the penalties of objective.h and constraints.h
  Score detail;           ///< of the simulations, where there were any
};

/// A view of a study's evaluations for as long as they do not change. Candidates are made when first looked at.
class CandidateStore {
 public:
  CandidateStore(const Study& study, CandidateBook& book, const Answers& answers)
      : study_(study), book_(book), answers_(answers) {}

  int variables() const { return static_cast<int>(study_.variables.size()); }
  /// Number of constraints; Candidate::limits has that many entries, kept where <= 0.
  int constraints() const;
  /// The candidate at a point of the unit cube; layout and constraints are known without a simulation.
  const Candidate& at(int arm, std::span<const double> x) const;
  /// A candidate with its score on the replicates of the search: answered at once where it breaks a constraint,
  /// otherwise when all its evaluations are known.
  Visit visit(const Candidate& candidate) const;
  /// Evaluations of a candidate for replicates [first, first + count), in order; nullptr for those not known.
  std::vector<const Evaluation*> evaluations(const Candidate& candidate, int first, int count) const;

 private:
  const Study& study_;
  CandidateBook& book_;
  const Answers& answers_;
};

}  // namespace perfora::optimize
