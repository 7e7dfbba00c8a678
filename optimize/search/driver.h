// What is here: the search as a pure function of a study and the answers known so far: what to ask next, or that it has
// ended, and with what. What is not: asking (executor.h), remembering (study_run.h), NLopt (nlopt_search.h).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "optimize/evaluate/answers.h"
#include "optimize/search/candidate.h"
#include "optimize/search/objective.h"
#include "optimize/search/study.h"

namespace perfora::optimize {

/// One question to an executor.
struct Wanted {
  std::string key;
  Request request;
  const Candidate* candidate = nullptr;
};

/// One point that a search asked for.
struct Visit {
  const Candidate* candidate = nullptr;
  bool answered = false;  ///< false: waits for its simulations
  double score = 0.0;     ///< finite; with the penalties of objective.h and constraints.h
  Score detail;           ///< of the simulations, where there were any
};

/// One search as far as the answers carry it.
struct Trace {
  int arm = 0;
  bool refine = false;  ///< the second stage
  std::vector<Visit> visits;
  bool finished = false;
  std::string reason;
};

/// Best and start design on fresh seeds, pair by pair.
struct Finals {
  int replicates = 0;                             ///< asked for
  int pairs = 0;                                  ///< both simulations gave a plateau
  std::vector<double> best_scores, start_scores;  ///< of single simulations (no spread term), one a pair
  double gain = 0.0;                              ///< mean of start score - best score
  double gain_error = 0.0;                        ///< its standard error; 0 with fewer than two pairs
  bool significant = false;                       ///< gain > 2 standard errors, with every pair complete
  Score best, start;                              ///< over the fresh seeds, spread included
};

/// What there is to do and what is known.
struct Plan {
  bool finished = false;
  std::vector<Wanted> wanted;       ///< unanswered, in the order in which they should be taken; no key twice
  std::vector<Trace> traces;        ///< one an arm, then the second stage
  Visit start;                      ///< the start design with the replicates of the search
  const Candidate* best = nullptr;  ///< of everything simulated so far, the start included; nullptr: nothing valid yet
  Score best_score;
  Finals finals;
  std::string reason;  ///< why it finished
};

/// The search. plan() is a pure function of the study and the answers: it runs NLopt from the start, answers known
/// points and stops each arm at its first unknown one. Which answers arrive first, how many workers there are, a crash
/// and a resume change nothing in what it asks in the end.
class Driver {
 public:
  explicit Driver(const Study& study) : study_(study), book_(study) {}
  Plan plan(const Answers& answers);
  CandidateBook& book() { return book_; }

 private:
  struct View;  ///< one call of plan()
  const Study& study_;
  CandidateBook book_;
};

}  // namespace perfora::optimize
