// What is here: the seam of search algorithms: what a searcher is given, what it answers, and which searchers there
// are. What is not: an algorithm (nlopt_searcher.h), incumbent and comparison on fresh seeds (driver.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "optimize/search/candidate_store.h"

namespace perfora::optimize {

/// Points of the unit cube.
using Points = std::vector<std::vector<double>>;

/// One search within a stage.
struct SearchTask {
  int arm = 0;                ///< index in Study::arms
  int maxeval = 1;            ///< points in total
  std::uint32_t seed = 1;     ///< of its random numbers
  std::vector<double> start;  ///< where a local algorithm begins, each coordinate in [0, 1]
  /// Points of this arm in every batch that is journalled, batch by batch; one may be empty, as the points of a batch
  /// are of all tasks together. A searcher that asks in batches takes them as given and computes only the next batch.
  /// Left empty, it computes all of them anew: the same points (a check, since batches are journalled as they are run).
  std::vector<Points> batches = {};
};

/// One stage of a study: searches beside each other with one algorithm. Settings that an algorithm does not know are
/// left alone.
struct SearchStage {
  std::string algorithm;  ///< as Searcher::canonical_name() gives it
  std::vector<SearchTask> tasks;
  double initial_step = 0.25;        ///< of local algorithms, as a fraction of the bounds
  int population = 0;                ///< 0: the algorithm's own choice
  double xtol = 0.0;                 ///< as a fraction of the bounds; 0: off
  double ftol = 0.0;                 ///< on the score; 0: off
  std::optional<double> stop_score;  ///< a search ends at a score as low as this
  int batch = 4;  ///< points that are asked together, over all tasks; fixed by the study, never by the workers
};

/// One search as far as the known evaluations carry it. Its unanswered visits are what it asks for.
struct Trace {
  int arm = 0;
  bool refine = false;  ///< of the second stage
  std::vector<Visit> visits;
  bool finished = false;
  std::string reason;  ///< why it finished: "maxeval reached", ...
  /// Visits of each batch, in the order of `visits`: as many entries in every trace of a stage, together the batches
  /// that SearchTask::batches holds and, at most, one more. Empty for a searcher that does not ask in batches.
  std::vector<int> batches = {};
  std::string note =
      {};  ///< what a user should know of how the last points were chosen; a sentence without a full stop
};

/// A search algorithm, or a family of them, behind `study.algorithm`. It asks and is told through the store: ask() is a
/// pure function of the stage and of what the store holds, so the same store gives the same requests in every process,
/// and resume, parallel work and recovery from a crash need nothing else.
class Searcher {
 public:
  virtual ~Searcher() = default;

  /// What it is built on, for result files: {"nlopt", "2.7.1"}.
  struct Library {
    std::string name, version;
  };
  virtual Library library() const = 0;

  /// Names of its algorithms.
  virtual std::vector<std::string> algorithms() const = 0;
  /// The name as algorithms() has it, for any way of writing it that is accepted; otherwise empty, and `problem` says
  /// in one clause why.
  virtual std::string canonical_name(const std::string& name, std::string& problem) const = 0;
  /// Whether it asks in batches, each to be journalled before it runs and given back in SearchTask::batches. All tasks
  /// of a stage are then one search that shares the sum of their maxeval.
  virtual bool asks_in_batches() const { return false; }
  /// Whether it asks for all points of a task at once.
  virtual bool asks_at_once() const { return false; }
  /// Whether an algorithm begins at a given point and stays near it, so that it can be a second stage.
  virtual bool is_local(const std::string& algorithm) const = 0;

  struct Refusal {
    std::string problem, remedy;
  };
  /// Why an algorithm cannot search over this many variables; nothing when it can.
  virtual std::optional<Refusal> refuse(const std::string& algorithm, int variables) const = 0;
  /// What a user should know before it runs: sentences, without a full stop. `maxeval`: the fewest points of an arm.
  virtual std::vector<std::string> warnings(const std::string& algorithm, int variables, int population,
                                            int maxeval) const = 0;

  /// One trace a task, in their order: every point requested from the start on, until the search has ended or knows
  /// nothing to ask before an open visit is answered. A trace that is not finished has at least one open visit.
  virtual std::vector<Trace> ask(const SearchStage& stage, const CandidateStore& store) const = 0;
};

/// The nearest point whose coordinates are multiples of 1/4096: what searchers ask for that compute their points with
/// rounding, so that a last digit that differs from machine to machine makes no other design.
std::vector<double> on_grid(std::vector<double> point);

using Searchers = std::vector<std::shared_ptr<const Searcher>>;

/// Every searcher of the program.
const Searchers& built_in_searchers();

/// An algorithm with the searcher that has it.
struct ChosenSearcher {
  std::shared_ptr<const Searcher> searcher;  ///< nullptr: none has it
  std::string algorithm;                     ///< canonical name
  std::string problem;                       ///< why none has it, as the first of them says
};
ChosenSearcher choose_searcher(const Searchers& searchers, const std::string& name);

/// Names of all algorithms, or of the local ones.
std::vector<std::string> algorithm_names(const Searchers& searchers, bool only_local);

}  // namespace perfora::optimize
