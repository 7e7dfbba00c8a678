// What is here: a study as a pure function of the answers known so far: what to ask next, or that it has ended, and
// with what. What is not: asking (executor.h), remembering (study_run.h), the algorithms (searcher.h).
#pragma once

#include <set>
#include <string>
#include <vector>

#include "optimize/search/batch.h"
#include "optimize/search/searcher.h"
#include "results/verdict.h"

namespace perfora::optimize {

/// Replicates from here on are those of a race, and of a confirmation. Those of the search are 0, 1, ..., those of the
/// verification follow them: no seed serves two of these.
inline constexpr int first_race_replicate = 1000;
inline constexpr int first_confirming_replicate = 1000000;

/// One question to an executor.
struct Wanted {
  std::string key;
  Request request;
  const Candidate* candidate = nullptr;
};

/// Best and start design on fresh seeds, pair by pair.
struct Finals {
  int replicates = 0;                             ///< requested of the best
  int start_replicates = 0;                       ///< requested of the start: the first of them
  int first = 0;                                  ///< replicate that they begin with
  std::size_t fidelity = 0;                       ///< index in Study::fidelities
  int pairs = 0;                                  ///< both simulations gave a plateau
  std::vector<double> best_scores, start_scores;  ///< of single simulations, without what wishes cost, one a pair
  double gain = 0.0;                              ///< mean of start score - best score
  double gain_error = 0.0;                        ///< its standard error; 0 with fewer than two pairs
  double gain_interval = 0.0;                     ///< half width of its 95 % interval (Student's t)
  bool significant = false;  ///< gain > gain_interval, with every pair complete and three pairs at least
  Score best, start;         ///< over the fresh seeds, spread included
  bool start_keeps_more() const { return best.valid && start.valid && start.not_kept < best.not_kept; }
};

/// A design of the race.
struct Finalist {
  const Candidate* candidate = nullptr;
  int rounds = 0;  ///< that it took part in
  bool kept = false;
  Score score;  ///< over the seeds of the search and of its rounds
};

/// A design on the seeds of the verification.
struct Verified {
  const Candidate* candidate = nullptr;
  Score score;
  results::Outcome outcome = results::Outcome::not_shown;  ///< of the wishes, where there are any
  int first = 0, count = 0;                                ///< replicates that the two speak of
};

/// What there is to do and what is known.
struct Plan {
  bool finished = false;
  std::vector<Wanted> wanted;      ///< unanswered, in the order in which they should be taken; no key twice
  std::vector<Batch> new_batches;  ///< to be journalled, and given to Driver::take(), before `wanted` is asked
  std::vector<Visit> map;          ///< its designs, at its fidelity and replicates; the study's own first
  int map_tried = 0;               ///< points looked at for the map; 0: not known
  bool map_finished = false;
  /// Designs that a model learns from beside those of `traces`: the start and all of the map, those taken from another
  /// folder among them.
  std::vector<const Candidate*> told;
  std::vector<Trace> traces;        ///< one an arm, then the second stage
  Visit start;                      ///< the start design with the replicates of the search
  const Candidate* best = nullptr;  ///< recommended: of everything simulated so far; nullptr: nothing valid yet
  Score best_score;                 ///< on the seeds of the search
  std::vector<Finalist> finalists;  ///< of the race, as it stands: best first
  std::vector<Verified> verified;   ///< in the order of the race; complete ones
  Finals finals;
  std::string reason;  ///< why it finished
};

/// The search of a study: its map, the start design, the arms, the second stage, the race, the verification, the
/// comparison with the start on fresh seeds. plan() is a pure function of the study, of what take(), observe() and
/// end_search() were told, and of the answers, as its searchers are. Which answers arrive first, how many workers there
/// are, a crash and a resume change nothing in what it asks in the end.
class Driver {
 public:
  explicit Driver(const Study& study) : study_(study), book_(study) {}
  Plan plan(const Answers& answers);
  /// The map alone.
  Plan plan_map(const Answers& answers);
  /// A batch that stands in the journal: taken as it is.
  void take(Batch batch) { batches_.push_back(std::move(batch)); }
  /// A design that is known beside the study's own: of another folder, or of this one before its target was changed.
  void observe(const Candidate& candidate) { told_.push_back(&candidate); }
  /// Ends map and search without the designs in `dropped`, those that were open (a limit of time that the journal
  /// holds): what comes behind them goes on.
  void end_search(std::string reason, std::set<const Candidate*> dropped) {
    ended_ = std::move(reason);
    dropped_ = std::move(dropped);
  }
  bool search_ended() const { return !ended_.empty(); }
  CandidateBook& book() { return book_; }

 private:
  struct View;  ///< one call of plan()
  const Study& study_;
  CandidateBook book_;
  std::vector<Batch> batches_;
  std::vector<const Candidate*> told_;
  std::string ended_;
  std::set<const Candidate*> dropped_;
};

}  // namespace perfora::optimize
