// What is here: a study that asks its caller for evaluations and is told them: for callers with their own way to spread
// work. What is not: a study that evaluates by itself (run_campaign in campaign.h).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "perfora/campaign.h"
#include "perfora/design.h"
#include "perfora/evaluate.h"

namespace perfora {

/// One evaluation that a study wants.
struct Trial {
  std::string key;      ///< its name within the study
  std::string label;    ///< of its candidate, for people: "diameter 7 mm"
  int replicate = 0;    ///< which packing and strength field: 0, 1, ...
  std::string request;  ///< all of it as JSON, for evaluate_trial() in any process

  /// The design as it is to be run. Throws Error for a request that is none.
  Design design() const;
};

/// How a trial is evaluated.
struct TrialOptions {
  int threads = 1;                 ///< 0: one a processor. The result does not depend on it
  std::filesystem::path run_file;  ///< R.h5 to write, or to go on from where it is of the same trial; empty: none
  std::shared_ptr<Stop> stop;      ///< may be null
};

/// Evaluates the request of a trial; needs nothing of the study, so that any process on any host may call it. A design
/// that cannot be evaluated is Status::failed, which the study is told, too. Throws Error for a request that is none.
Evaluation evaluate_trial(const std::string& request, const TrialOptions& options = {});

/// Where and how a study is begun.
struct StudyOptions {
  std::filesystem::path folder;        ///< for its journal and results; made when missing. Must be given
  std::vector<std::string> overrides;  ///< "section.key=value" of the file or of the design that it names
  bool resume = false;                 ///< go on with what the folder has; what it knows is not asked again
  bool force = false;                  ///< remove an earlier study first
};

/// The search of a study file, in a folder that it alone may use as long as it lives. What it asks depends on what it
/// was told only, not on the order in which it was told or on who evaluated. Its functions may be called from any
/// thread.
class Study {
 public:
  /// Reads the file and takes the folder. Throws Error for a file that is no study and a folder that holds other work,
  /// or the same without `resume` or `force`.
  Study(const std::filesystem::path& file, const StudyOptions& options);
  /// Ends it as close() does.
  ~Study();
  Study(Study&& other) noexcept;  ///< Takes the study of `other`, which may only be destroyed then.
  Study& operator=(Study&&) = delete;

  /// Trials that can be evaluated now, at most `most` (0: all), none that was given before unless `again` (its worker
  /// may be lost). Empty where everything waits for what was given before, and once the study is finished. Throws
  /// Error, SurroundingsError.
  std::vector<Trial> ask(int most = 0, bool again = false);
  /// Writes the evaluation of a trial into the journal; then ask() has what follows from it. A trial that is not open
  /// (told before, by another worker) is left alone. Throws Error for an evaluation that was stopped or is not one of
  /// this trial.
  void tell(const Trial& trial, const Evaluation& evaluation);
  /// Whether nothing is left to ask.
  bool finished();
  /// Writes the results into the folder, gives it free and reads it back. One that is not finished goes on with
  /// `resume`. Afterwards ask() is empty.
  Campaign close();

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace perfora
