// What is here: one design evaluated: packed, bonded, compressed, measured. What is not: many evaluations in a folder
// (campaign.h), reading what was written (results.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "perfora/design.h"
#include "perfora/results.h"

namespace perfora {

/// How far work has come.
struct Progress {
  double fraction = 0.0;  ///< done, 0 to 1; a smaller one than before belongs to the next part of the work
  std::string text;       ///< for people
  double strain = std::numeric_limits<double>::quiet_NaN();  ///< of a compression; NaN of other work
  double stress = std::numeric_limits<double>::quiet_NaN();  ///< of a compression, Pa; NaN of other work
  std::int64_t finished = 0;                                 ///< evaluations of a campaign
  std::int64_t remaining = 0;                                ///< evaluations of a campaign that may still come, at most
  double seconds = 0.0;                                      ///< wall time so far
  double seconds_left = std::numeric_limits<double>::quiet_NaN();  ///< expected; NaN while it is not known
};

/// Is told of progress now and then and says whether to go on: false asks the work to stop, which it does within a few
/// steps, keeping what it has. It is called by one thread at a time. An exception stops the work as well and then comes
/// out of the function that was called.
using ProgressCallback = std::function<bool(const Progress&)>;

/// Asks work to stop, from any thread or a signal handler: it is given with the options of the work, which stops within
/// a few steps and keeps what it has. There is no way back: work that is begun afterwards takes a new one.
class Stop {
 public:
  Stop();
  ~Stop();
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;

  /// Asks.
  void request() noexcept;
  /// Whether it was asked.
  bool requested() const noexcept;

 private:
  friend struct Inside;
  struct Content;
  std::unique_ptr<Content> content_;
};

/// How a design is evaluated.
struct EvaluateOptions {
  int threads = 0;                     ///< 0: one a processor. The result does not depend on it
  int replicate = 0;                   ///< 0, 1, ...: another packing and strength field of the same design
  std::filesystem::path run_file;      ///< R.h5 to write; empty: none. A run that is stopped needs it to go on
  std::filesystem::path packing_file;  ///< packing file of this design to start from; empty: the packing is made
  bool resume = false;                 ///< go on from what run_file has, or read it when it is finished
  bool force = false;                  ///< replace a run file that exists
  double wall_time = 0.0;              ///< s, after which it stops with a checkpoint; 0: none
  double memory = 0.0;                 ///< bytes it may take by its estimate; 0: what this process may
  ProgressCallback progress;           ///< may be empty
  std::shared_ptr<Stop> stop;          ///< may be null; is requested where the callback says false, too
};

/// Packs a design, compresses it and measures the curve, what `perfora evaluate` does. A stop (by the callback, a Stop
/// or the wall time) is Status::stopped; numerical trouble is Status::failed. Throws Error for a design that cannot be
/// evaluated or would take more than `memory`, and a run file that exists or is of another design.
Evaluation evaluate(const Design& design, const EvaluateOptions& options = {});

/// What a search minimises (docs/user/theory.md, "Score"): how far the replicates of one design lie from what `design`
/// wishes in [target]. Of two designs that keep all wishes the flatter one has less: the distance to a wished stress
/// and, unless target.weight.cap_ratio is 0, the cap ratio count as well. Whole curves are measured anew for this
/// target, so that one run answers any wish. A replicate that failed or stopped makes it 750, worse than any that was
/// simulated. Throws Error where nothing is wished, where there is no replicate, where a curve ends before the window
/// does, and for evaluations that were not made by the library.
double score(const Design& design, const std::vector<Evaluation>& replicates);

}  // namespace perfora
