// What is here: a study as a pure function of the answers known so far: what to ask next, or that it has ended, and
// with what. What is not: asking (executor.h), remembering (study_run.h), the algorithms (searcher.h).
#pragma once

#include <string>
#include <vector>

#include "optimize/search/searcher.h"

namespace perfora::optimize {

/// One question to an executor.
struct Wanted {
  std::string key;
  Request request;
  const Candidate* candidate = nullptr;
};

/// Best and start design on fresh seeds, pair by pair.
struct Finals {
  int replicates = 0;                             ///< requested
  int pairs = 0;                                  ///< both simulations gave a plateau
  std::vector<double> best_scores, start_scores;  ///< of single simulations (no spread term), one a pair
  double gain = 0.0;                              ///< mean of start score - best score
  double gain_error = 0.0;                        ///< its standard error; 0 with fewer than two pairs
  double gain_interval = 0.0;                     ///< half width of its 95 % interval (Student's t)
  bool significant = false;  ///< gain > gain_interval, with every pair complete and three pairs at least
  Score best, start;         ///< over the fresh seeds, spread included
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

/// The search of a study: the start design, the arms, the second stage, the comparison on fresh seeds. plan() is a pure
/// function of the study and the answers, as its searchers are. Which answers arrive first, how many workers there are,
/// a crash and a resume change nothing in what it asks in the end.
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
