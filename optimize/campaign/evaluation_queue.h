// What is here: evaluations of a folder: those its journal knows, and a loop that has the missing ones evaluated and
// writes each down before anything else happens. What is not: which are wanted (campaign.h), how they are evaluated
// (executor.h).
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/cancellation.h"
#include "optimize/campaign/execution.h"
#include "optimize/campaign/executor.h"
#include "optimize/evaluate/answers.h"

namespace perfora::io {
class Journal;
}

namespace perfora::optimize {

/// Says in an evaluation's event that it came from another folder.
inline constexpr const char* taken_over_name = "taken_over";

/// Says in the events that journals begin a session with whether run files of finished simulations stay.
inline constexpr const char* run_files_kept = "run_files_kept";

/// One question to an executor.
struct Asked {
  std::string key;
  Request request;
  std::string label;  ///< what the journal and people call it
  /// Run file, relative to the folder, that stays there; "": none. Not given: DIR/runs/KEY.h5 (WorkOptions says whether
  /// it stays).
  std::optional<std::filesystem::path> run_file = {};
};

/// How far a folder's work has come.
struct WorkProgress {
  std::int64_t known = 0;      ///< evaluations that the journal holds
  std::int64_t remaining = 0;  ///< that may still come, at most
  std::string standing;        ///< Campaign::standing()
  double under_way = 0.0;      ///< evaluations' worth of work that the workers have done of those they are at
  std::string simulation;      ///< how the one begun first stands: "strain 12.30 %, stress 210 kPa"; empty: not known

  /// Of all evaluations, what is done of those under way included.
  double fraction() const {
    const auto all = static_cast<double>(known + remaining);
    return all > 0.0 ? (static_cast<double>(known) + under_way) / all : 1.0;
  }
};

/// How a folder's work is carried out.
struct WorkOptions {
  std::filesystem::path folder;  ///< made when missing; holds journal.jsonl
  bool resume = false;           ///< continue the journal there
  bool force = false;            ///< remove an earlier one's files first
  std::string command_line;
  /// Makes the executor when something is to be evaluated; not called when the journal answers everything.
  std::function<std::unique_ptr<Executor>()> make_executor;
  /// Run files of finished simulations stay in DIR/runs, with a few frames; otherwise only those that were stopped or
  /// killed, which are resumed.
  bool keep_run_files = false;
  /// What a failure of the surroundings leads to.
  ExecutionKeys execution;
  /// Requested: the workers are ended, the stop is noted in the journal, the work returns. Workers in this process stop
  /// what runs only if their evaluation was given a token, too.
  io::Cancellation cancellation;
  /// What a request to stop means, for people.
  std::string stopped_by = "stopped by a signal";
  /// Called a few times a second while evaluations run in other threads or processes. May be empty.
  std::function<void(const WorkProgress&)> progress;
  /// A line a finished evaluation; off where `progress` draws one line that says it all.
  bool line_an_answer = true;
  /// Where no evaluation has ended for so long, a line says how the one begun first stands.
  std::chrono::milliseconds log_interval = std::chrono::minutes(5);
  /// Results of unfinished work are written this often, so that a kill leaves something to look at.
  std::chrono::seconds results_interval = std::chrono::seconds(60);
  /// Called when they were. May be empty.
  std::function<void()> results_written;
};

class Campaign;

/// An evaluation that the surroundings did not let come about.
struct Trouble {
  std::string label;  ///< of what was asked
  std::string reason;
  int attempts = 1;
};
/// "diameter 9 mm: the worker was ended by signal 9 (Killed), 3 times in a row"
std::string trouble_text(const Trouble& trouble);

/// The journal of a folder as answers, and the loop that adds to it.
class EvaluationQueue {
 public:
  /// Opens (or begins) the journal of options.folder, whose lock the caller holds. Events that are no evaluations go to
  /// `seen` in their order, with the answers so far, so that what does not belong here can be refused before an
  /// evaluation is read. Throws io::InputError when the journal is damaged. Failures of the surroundings that an
  /// earlier program took for evaluations are left out.
  EvaluationQueue(WorkOptions options, const std::function<void(const nlohmann::json&, Answers&)>& seen);
  ~EvaluationQueue();

  /// Appends an event that is no evaluation.
  void note(const nlohmann::json& event);

  /// Takes an evaluation from the journal of another folder, with its history where that folder keeps one: written down
  /// and known as if it had been evaluated here, but no time counts.
  void take_over(nlohmann::json event, const std::filesystem::path& folder);

  const Answers& answers() const { return answers_; }
  const WorkOptions& options() const { return options_; }

  /// Has everything evaluated that `campaign` (asked again after every answer) names, until it names nothing; questions
  /// that are under way stay in its list until they are answered. It hears of an answer after that is in the journal.
  /// True: done; false: stopped, what is finished is kept. A failure of the surroundings is noted in the journal, as no
  /// evaluation, and the request is asked again or not as options.execution says.
  bool run(Campaign& campaign);

  /// What ended run(), where the surroundings did.
  const std::optional<Trouble>& trouble() const { return trouble_; }
  /// What was left out (OnTrouble::skip), in order.
  const std::vector<Trouble>& skipped() const { return skipped_; }

  /// The evaluation during which work was stopped, where it said so itself.
  const std::optional<Evaluation>& interrupted() const { return interrupted_; }

  /// Journal and folders that any work has in its folder, and cleans.
  static std::vector<std::string> own_files();
  /// DIR/runs/KEY.h5, relative to the folder, by the request's full key.
  static std::filesystem::path run_file(const Request& request);

  int workers() const { return workers_; }  ///< of the last run(); 1 before
  std::size_t in_flight() const { return in_flight_.size(); }
  double simulated_seconds() const { return simulated_seconds_; }  ///< of all evaluations in the journal
  int retries() const { return retries_; }  ///< attempts beyond the first of all evaluations in the journal
  /// DIR/histories/KEY.h5, relative to the folder: the full history, from which the evaluation can be measured anew.
  static std::filesystem::path history_file(const std::string& key);

  /// "; at most 5 min left" for `remaining` evaluations like those so far; empty where nothing can be said.
  std::string time_left(std::int64_t remaining) const;

 private:
  WorkProgress how_far(const Campaign& campaign, const Executor& executor) const;
  /// "under way since 12 min 05 s: diameter 9 mm: strain 12.30 %, stress 210 kPa"; empty: not known.
  std::string under_way_text(const Executor& executor) const;
  void take_evaluation(const std::string& key, const nlohmann::json& record);
  void record(Campaign& campaign, const Asked& asked, Answer answer);
  /// True: it is asked again or left out; false: the work stops.
  bool go_on_after(const Answer& answer, Executor& executor);
  std::vector<Asked> wanted_by(Campaign& campaign) const;
  void clean_folder() const;
  /// The history of an evaluation that was written down as `written`, in this folder or another, under today's `key`.
  void take_history(const std::filesystem::path& folder, const std::string& written, const std::string& key) const;
  void keep_history(const std::string& key, const Evaluation& evaluation) const;
  void submit(Executor& executor, const Asked& asked) const;
  void drop_run_file(const Request& request) const;

  WorkOptions options_;
  std::unique_ptr<io::Journal> journal_;
  Answers answers_;
  std::optional<Evaluation> interrupted_;
  std::map<std::string, Asked> in_flight_;
  std::map<std::string, int> attempts_;  ///< that failed, by key
  std::optional<Trouble> trouble_;
  std::vector<Trouble> skipped_;
  std::set<std::string> skipped_keys_;
  bool only_own_runs_ = true;  ///< no session of this journal has kept run files of finished simulations
  double simulated_seconds_ = 0.0;
  int timed_ = 0;  ///< evaluations that make these up
  int retries_ = 0;
  int workers_ = 1;
};

/// The event that an answer is in a journal.
nlohmann::json evaluation_event(const Asked& asked, const Answer& answer);

/// How many evaluations run at once: `asked`, or what the file says, or one a processor (io::default_threads; 0: not
/// given), but not more than can be under way together.
int workers_for(int asked, int of_file, std::int64_t together);

}  // namespace perfora::optimize
