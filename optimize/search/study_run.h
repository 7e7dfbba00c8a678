// What is here: a study carried out in a folder: journal, driver and executor put together; going on after a stop or a
// kill. What is not: what comes next (driver.h), how it is evaluated (executor.h), the result files (study_result.h).
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "optimize/campaign/evaluation_queue.h"
#include "optimize/search/driver.h"
#include "optimize/search/study.h"

namespace perfora::optimize {

/// One study. Plans point into it, so it must outlive them.
class StudyRun {
 public:
  /// Opens the folder and its journal. Throws io::InputError when the folder holds a study and neither `resume` nor
  /// `force` is set, and when the study of the journal differs from this one (the key that differs and both values are
  /// named; maxeval, refine and final_replicates may change).
  StudyRun(Study study, WorkOptions options);
  ~StudyRun();

  /// Searches to the end or to a stop.
  void run();

  const Study& study() const { return study_; }
  const WorkOptions& options() const { return queue_->options(); }
  const Plan& plan() const { return plan_; }
  const Answers& answers() const { return queue_->answers(); }
  CandidateBook& book() { return driver_.book(); }
  results::RunStatus status() const { return status_; }
  std::string reason() const { return reason_; }
  /// Evaluations of a candidate for replicates [first, first + count) that are known, in order.
  std::vector<const Evaluation*> known(const Candidate& candidate, int first, int count);
  double seconds() const { return seconds_; }  ///< wall time of this call of run()
  double simulated_seconds() const { return queue_->simulated_seconds(); }
  int retries() const { return queue_->retries(); }

 private:
  std::vector<Asked> wanted();
  void say(const Asked& asked, const Evaluation& evaluation);
  std::int64_t most_evaluations() const;

  Study study_;
  std::unique_ptr<EvaluationQueue> queue_;
  Driver driver_;
  Plan plan_;
  std::map<std::string, const Candidate*> candidates_;  ///< by request key, of everything asked
  results::RunStatus status_ = results::RunStatus::completed;
  std::string reason_;
  double seconds_ = 0.0;
};

/// How many evaluations can run at once: `asked`, or the study's workers, or all cores, but not more than arms x
/// replicates.
int useful_workers(const Study& study, int asked);

}  // namespace perfora::optimize
