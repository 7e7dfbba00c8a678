// What is here: the known evaluations of a study as candidates with their scores, and as the list of designs that a
// model learns from: what a search is told.
// What is not: which candidates are requested (searcher.h), the journal (campaign/evaluation_queue.h).
#pragma once

#include <set>
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

/// What is known of one design at one fidelity: all that a model learns from. The resolved design (the fidelity's
/// changes made) is *candidate->requests[fidelity].design.
struct Observed {
  const Candidate* candidate = nullptr;       ///< with arm, values, layout, requests
  std::vector<double> point;                  ///< of the unit cube; a start outside the bounds is moved into them
  std::size_t fidelity = 0;                   ///< index in Study::fidelities
  std::vector<const Evaluation*> replicates;  ///< those known, by replicate; with status, measures, coarse curve
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
  /// The same on the first `replicates` at one fidelity.
  Visit visit(const Candidate& candidate, int replicates, std::size_t fidelity) const;
  /// Evaluations of a candidate for replicates [first, first + count), in order; nullptr for those not known.
  std::vector<const Evaluation*> evaluations(const Candidate& candidate, int first, int count,
                                             std::size_t fidelity = 0) const;

  /// Adds a design that a search is told of beside those it visits: the start, the designs of a map. Once is enough.
  void observe(const Candidate& candidate) { told_.insert(&candidate); }
  /// The designs of observe() and of `visited` that have an evaluation, each once a fidelity, with replicates below
  /// `replicates`; by arm, values and fidelity, whatever the order in which they were added or answered. Candidates
  /// that break a constraint have none.
  std::vector<Observed> observed(std::span<const Candidate* const> visited, int replicates) const;
  const Study& study() const { return study_; }

 private:
  const Study& study_;
  CandidateBook& book_;
  const Answers& answers_;
  std::set<const Candidate*> told_;
};

}  // namespace perfora::optimize
