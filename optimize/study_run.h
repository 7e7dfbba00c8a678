// What is here: a study carried out in a folder: journal, driver and executor put together; going on after a stop or a
// kill. What is not: what comes next (driver.h), how it is evaluated (executor.h), the result files (study_result.h).
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "optimize/driver.h"
#include "optimize/executor.h"
#include "optimize/study.h"

namespace perfora::io {
class Journal;
}

namespace perfora::optimize {

struct StudyRunOptions {
  std::filesystem::path folder;  ///< made when missing; holds journal.jsonl
  bool resume = false;           ///< go on with the journal there
  bool force = false;            ///< remove an earlier study's files first
  std::string command_line;
  /// Makes the executor when something is to be evaluated; not called when the journal answers everything.
  std::function<std::unique_ptr<Executor>()> make_executor;
  /// Asked often; true: end the workers, note the stop in the journal and return.
  std::function<bool()> stop_requested;
};

/// One study. Plans point into it, so it must outlive them.
class StudyRun {
 public:
  /// Opens the folder and its journal. Throws io::InputError when the folder holds a study and neither `resume` nor
  /// `force` is set, and when the study of the journal differs from this one (the key that differs and both values are
  /// named; maxeval, refine and final_replicates may change).
  StudyRun(Study study, StudyRunOptions options);
  ~StudyRun();

  /// Searches to the end or to a stop.
  void run();

  const Study& study() const { return study_; }
  const StudyRunOptions& options() const { return options_; }
  const Plan& plan() const { return plan_; }
  const Answers& answers() const { return answers_; }
  CandidateBook& book() { return driver_.book(); }
  solver::RunStatus status() const { return status_; }
  std::string reason() const { return reason_; }
  /// Evaluations of a candidate for replicates [first, first + count) that are known, in order.
  std::vector<const Evaluation*> known(const Candidate& candidate, int first, int count);
  double seconds() const { return seconds_; }                      ///< wall time of this call of run()
  double simulated_seconds() const { return simulated_seconds_; }  ///< of all evaluations in the journal
  int retries() const { return retries_; }                         ///< evaluations that were asked twice

 private:
  void open();
  void take_header(const std::string& text);
  void take_evaluation(const std::string& text);
  void submit_new(Executor& executor);
  void record(Answer answer);
  void say(const std::string& key, const Evaluation& evaluation);
  std::string time_left() const;
  std::int64_t most_evaluations() const;

  Study study_;
  StudyRunOptions options_;
  Driver driver_;
  std::unique_ptr<io::Journal> journal_;
  Answers answers_;
  Plan plan_;
  std::map<std::string, Wanted> in_flight_;
  solver::RunStatus status_ = solver::RunStatus::completed;
  std::string reason_;
  double seconds_ = 0.0, simulated_seconds_ = 0.0;
  int retries_ = 0;
  int workers_ = 1;
};

/// How many evaluations can run at once: `asked`, or the study's workers, or all cores, but not more than arms x
/// replicates.
int useful_workers(const Study& study, int asked);

/// A curve of at most some hundred points: strain and stress averaged over steps of 0.5 % strain. What the journal
/// keeps.
solver::History coarse_curve(const solver::History& history);

}  // namespace perfora::optimize
