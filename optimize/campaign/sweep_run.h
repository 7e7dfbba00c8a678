// What is here: a sweep carried out in a folder: every case and replicate evaluated once, going on after a stop, a kill
// or a change of the sweep file. What is not: result files (sweep_result.h), how it is evaluated (executor.h).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "optimize/campaign/evaluation_queue.h"
#include "optimize/campaign/sweep.h"

namespace perfora::optimize {

class SweepRun {
 public:
  /// Opens the folder and its journal. Throws io::InputError when the folder holds a sweep and neither `resume` nor
  /// `force` is set. A journal's evaluations are found by their request, so a resumed sweep may have other cases, other
  /// replicates, even another design: what was run already is not run again, what is no longer requested is not shown.
  SweepRun(Sweep sweep, WorkOptions options);
  ~SweepRun();

  /// Runs replicate 0 of every case, then replicate 1, ..., to the end or to a stop.
  void run();

  const Sweep& sweep() const { return sweep_; }
  const WorkOptions& options() const { return queue_->options(); }
  results::RunStatus status() const { return status_; }
  std::string reason() const { return reason_; }
  /// The evaluation of one run; nullptr while it is not known.
  const Evaluation* known(const SweepCase& one, int replicate) const;
  /// The same of a run that reached its strain; nullptr otherwise.
  const Evaluation* completed(const SweepCase& one, int replicate) const;
  double seconds() const { return seconds_; }  ///< wall time of this call of run()
  double simulated_seconds() const { return queue_->simulated_seconds(); }
  int retries() const { return queue_->retries(); }

 private:
  std::vector<Asked> wanted() const;
  void say(const Asked& asked, const Evaluation& evaluation);
  struct Run {
    Asked asked;
    std::string full_key;  ///< cases that come to the same design are one run
  };
  /// One replicate of a case that can be run.
  const Run& run_of(const SweepCase& one, int replicate) const;

  Sweep sweep_;
  std::unique_ptr<EvaluationQueue> queue_;
  std::vector<std::vector<Run>> runs_;  ///< by case and replicate; empty where a case cannot be run
  results::RunStatus status_ = results::RunStatus::completed;
  std::string reason_;
  double seconds_ = 0.0;
};

}  // namespace perfora::optimize
