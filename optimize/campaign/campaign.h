// What is here: a campaign: many evaluations carried out in a folder, with its journal, its lock, its results, going on
// after a stop or a kill. What is not: which evaluations (studies, sweeps, ensembles, calibrations), how they are
// carried out (executor.h), pictures.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/lock.h"
#include "optimize/campaign/evaluation_queue.h"

namespace perfora::optimize {

/// How a campaign ended.
struct CampaignEnd {
  results::RunStatus status = results::RunStatus::completed;
  std::string reason;
};

/// Work in a folder. A kind of work says what it is, what it asks next and what it leaves behind; everything else is
/// here. Its constructor calls open() when all it answers with is in place.
class Campaign {
 public:
  Campaign();
  virtual ~Campaign();
  Campaign(const Campaign&) = delete;
  Campaign& operator=(const Campaign&) = delete;

  /// Evaluates what is pending, to the end or to a stop; notes the end in the journal and writes the results.
  void run();

  const WorkOptions& options() const { return queue_->options(); }
  const Answers& answers() const { return queue_->answers(); }
  /// `stopped` while it is under way.
  results::RunStatus status() const { return end_.status; }
  const std::string& reason() const { return end_.reason; }
  double seconds() const;  ///< wall time of run(), so far
  double simulated_seconds() const { return queue_->simulated_seconds(); }
  int retries() const { return queue_->retries(); }
  /// Failures of the surroundings that kept evaluations from coming about, a sentence each: what ended the work, or
  /// what was left out. The work is `stopped` then, and --resume tries them again.
  std::vector<std::string> troubles() const;

  /// Name of the work in messages and of the event that its journal begins with: "study".
  virtual std::string kind() const = 0;
  /// Files it writes into its folder beside those of EvaluationQueue::own_files(); a name that ends in * stands for all
  /// that begin so. --force removes these and nothing else.
  virtual std::vector<std::string> own_files() const = 0;
  /// What the journal's first event says beside `event`, `results_version` and `command_line`.
  virtual nlohmann::json identity() const = 0;
  /// Throws io::InputError when the first event of a journal is of work that this one cannot continue. Any may be
  /// resumed where it is not overridden.
  virtual void check_same(const nlohmann::json& head, const std::filesystem::path& journal) const;
  /// An event of the journal that is neither the first nor an evaluation; may add answers.
  virtual void read_event(const nlohmann::json& event, Answers& answers) const;
  /// What to ask: a function of the answers alone. Empty: nothing is left.
  virtual std::vector<Asked> pending(const Answers& answers) = 0;
  /// How an answer is written down; null: not yet (a later answer of the same kind holds it).
  virtual nlohmann::json event_of(const Asked& asked, const Answer& answer, const Answers& answers) const;
  /// Hears of an answer after pending() has seen it. A line for people; empty: none.
  virtual std::string on_answer(const Asked& asked, const Evaluation& evaluation) = 0;
  /// How the work stands, in a few words: the stage, the best so far, the verdict so far. Empty: nothing to say.
  virtual std::string standing() const { return {}; }
  /// How many evaluations may still come, at most.
  virtual std::int64_t remaining() const = 0;
  /// What came out, once nothing is pending.
  virtual CampaignEnd finished() = 0;
  /// The same after a stop; `interrupted`: the evaluation that was stopped, where it said so itself.
  virtual CampaignEnd stopped(const Evaluation* interrupted);
  /// Writes all results into options().folder, each file whole. Also called while it is under way.
  virtual void write_results() = 0;

 protected:
  /// Takes the folder: its lock first, then its journal. Throws io::InputError when the folder holds such work and
  /// neither `resume` nor `force` is set, when it holds other work, is in use, and what check_same() throws.
  void open(WorkOptions options);
  /// Appends an event of its own to the journal; from pending() on: before what that names is asked.
  void note(const nlohmann::json& event) { queue_->note(event); }
  /// Takes an evaluation of another folder, as that one's journal has it, and its history where there is one.
  void take_over(nlohmann::json event, const std::filesystem::path& folder) {
    queue_->take_over(std::move(event), folder);
  }
  std::string time_left() const { return queue_->time_left(remaining()); }

 private:
  io::OutputLock lock_;  ///< of the journal; goes last
  std::unique_ptr<EvaluationQueue> queue_;
  CampaignEnd end_{results::RunStatus::stopped, "not finished yet"};
  std::chrono::steady_clock::time_point begun_;
  double seconds_ = -1.0;  ///< below 0: under way
};

}  // namespace perfora::optimize
