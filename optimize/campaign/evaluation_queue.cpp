// What is here: known evaluations read from a journal, missing ones handed to the executor and written down as they
// come back. What is not: the format of a journal line (io/journal.h).
#include "optimize/campaign/evaluation_queue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/files.h"
#include "io/journal.h"
#include "io/processors.h"
#include "io/progress.h"
#include "io/text.h"
#include "optimize/campaign/campaign.h"
#include "optimize/campaign/shared_folder.h"
#include "results/history_file.h"
#include "results/json.h"
#include "results/record_reading.h"
#include "solver/run_folder.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

/// How often a stop is looked for while evaluations run.
constexpr auto look_interval = std::chrono::milliseconds(200);
constexpr const char* evaluation_name = "evaluation";
constexpr const char* trouble_name = "trouble";
constexpr const char* runs_folder = "runs";
constexpr const char* histories_folder = "histories";
constexpr const char* journal_name = "journal.jsonl";

/// The key that the request of a journal's evaluation has today: the program that wrote it may have known fewer keys
/// of the design, or put more into a request's key. One that is no design of this program keeps the key it was written
/// with, which nobody asks for.
std::string key_of(const json& record, DesignTexts& designs) {
  std::string written = record.at("key").get<std::string>();
  if (!record.contains("request")) return written;
  try {
    return request_from_json(record.at("request"), &designs).key();
  } catch (const io::InputError&) {
    return written;
  }
}

/// What an earlier program wrote as a failed evaluation when a worker had died twice. That says nothing of the design.
bool was_trouble(const json& record) {
  const json& evaluation = record.at("evaluation");
  const std::string reason = evaluation.value("reason", "");
  return evaluation.value("status", "") == "failed" && reason.starts_with("the worker") &&
         reason.ends_with(" times in a row");
}

}  // namespace

std::string trouble_text(const Trouble& trouble) {
  const std::string times = trouble.attempts > 1 ? fmt::format(", {} times in a row", trouble.attempts) : "";
  return fmt::format("{}: {}{}", trouble.label, trouble.reason, times);
}

int workers_for(int asked, int of_file, std::int64_t together) {
  const int wanted = asked > 0 ? asked : of_file > 0 ? of_file : io::default_threads();
  return static_cast<int>(std::clamp<std::int64_t>(together, 1, wanted));
}

EvaluationQueue::EvaluationQueue(WorkOptions options, const std::function<void(const json&, Answers&)>& seen)
    : options_(std::move(options)) {
  journal_ = std::make_unique<io::Journal>(options_.folder / journal_name);
  answers_.set_histories([folder = options_.folder](const std::string& key) -> std::optional<results::StoredHistory> {
    const std::filesystem::path file = folder / history_file(key);
    if (!std::filesystem::exists(file)) return std::nullopt;
    return results::read_history_file(file);
  });
  DesignTexts designs;  // replicates share theirs
  int line = 0;
  for (const std::string& text : journal_->events())
    results::read_from(options_.folder / journal_name, ++line,
                       "restore the file from a copy, or delete this line and all after it to go on from there", [&] {
                         const json record = json::parse(text);
                         const std::string event = record.at("event");
                         if (event == evaluation_name && !was_trouble(record)) {
                           const std::string key = key_of(record, designs);
                           take_history(options_.folder, record.at("key"), key);
                           take_evaluation(key, record);
                         }
                         if (event == evaluation_name || event == trouble_name) return;
                         // One whose first event does not say it is of an earlier program.
                         if (record.contains("results_version") && record.value(run_files_kept, true))
                           only_own_runs_ = false;
                         seen(record, answers_);
                       });
}

EvaluationQueue::~EvaluationQueue() = default;

void EvaluationQueue::note(const json& event) {
  journal_->append(event.dump());
}

void EvaluationQueue::take_over(json event, const std::filesystem::path& folder) {
  DesignTexts designs;
  const std::string key = key_of(event, designs);
  take_history(folder, event.at("key"), key);
  event["key"] = key;
  event[taken_over_name] = true;
  note(event);
  take_evaluation(key, event);
}

void EvaluationQueue::take_history(const std::filesystem::path& folder, const std::string& written,
                                   const std::string& key) const {
  const std::filesystem::path here = options_.folder / history_file(key);
  std::filesystem::path there = folder / history_file(written);
  if (!std::filesystem::exists(there)) there = folder / history_file(key);  // renamed there already
  if (!std::filesystem::exists(there) || std::filesystem::exists(here)) return;
  io::make_folders(options_.folder / histories_folder);
  if (folder == options_.folder)
    std::filesystem::rename(there, here);
  else
    io::write_file(here, io::read_file(there));
}

void EvaluationQueue::take_evaluation(const std::string& key, const json& record) {
  answers_.add(key, results::evaluation_from_json(record.at("evaluation")));
  if (record.value(taken_over_name, false)) return;
  simulated_seconds_ += record.value("seconds", 0.0);
  ++timed_;
  retries_ += record.value("attempts", 1) - 1;
}

void EvaluationQueue::keep_history(const std::string& key, const Evaluation& evaluation) const {
  const results::History& history = evaluation.curve;
  if (evaluation.status != results::RunStatus::completed || !history.is_full()) return;
  const auto [first, last] = answers_.of(key);
  const bool longer_known = std::any_of(first, last, [&](const auto& stored) {
    return stored.second.summary.final_strain > evaluation.summary.final_strain;
  });
  if (longer_known) return;
  io::make_folders(options_.folder / histories_folder);
  results::write_history_file(options_.folder / history_file(key), history, evaluation.grade);
}

std::filesystem::path EvaluationQueue::history_file(const std::string& key) {
  return std::filesystem::path(histories_folder) / (key + ".h5");
}

json evaluation_event(const Asked& asked, const Answer& answer) {
  return {{"event", evaluation_name},
          {"key", answer.key},
          {"candidate", asked.label},
          {"request", to_json(asked.request)},
          {"evaluation", to_json(answer.evaluation, true)},
          {"attempts", answer.attempts},
          {"seconds", answer.seconds}};
}

void EvaluationQueue::record(Campaign& campaign, const Asked& asked, Answer answer) {
  if (!asked.run_file) keep_history(answer.key, answer.evaluation);  // A run file that stays holds it.
  answer.evaluation.curve = results::coarse_curve(answer.evaluation.curve);
  const json event = campaign.event_of(asked, answer, answers_);
  if (!event.is_null()) note(event);
  // The same way as on resume, so that both see the same numbers.
  if (event.is_object() && event.value("event", "") == evaluation_name) return take_evaluation(answer.key, event);
  simulated_seconds_ += answer.seconds;
  ++timed_;
  retries_ += answer.attempts - 1;
  answers_.add(answer.key, std::move(answer.evaluation));
}

bool EvaluationQueue::go_on_after(const Answer& answer, Executor& executor) {
  const Asked& asked = in_flight_.at(answer.key);
  const ExecutionKeys& rules = options_.execution;
  const Trouble trouble{asked.label, answer.trouble, ++attempts_[answer.key]};
  note({{"event", trouble_name},
        {"key", answer.key},
        {"candidate", asked.label},
        {"reason", trouble.reason},
        {"attempts", trouble.attempts}});
  if (rules.on_trouble != OnTrouble::stop && trouble.attempts < rules.attempts) {
    io::log_warning(fmt::format("{}; tried again", trouble_text(trouble)));
    submit(executor, asked);
    return true;
  }
  if (rules.on_trouble != OnTrouble::skip) {
    trouble_ = trouble;
    return false;
  }
  io::log_warning(fmt::format("{}; left out", trouble_text(trouble)));
  skipped_.push_back(trouble);
  skipped_keys_.insert(answer.key);
  in_flight_.erase(answer.key);
  return true;
}

std::vector<Asked> EvaluationQueue::wanted_by(Campaign& campaign) const {
  std::vector<Asked> wanted = campaign.pending(answers_);
  std::erase_if(wanted, [this](const Asked& asked) { return skipped_keys_.contains(asked.key); });
  return wanted;
}

void EvaluationQueue::clean_folder() const {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path runs = options_.folder / runs_folder, histories = options_.folder / histories_folder;
  std::vector<fs::path> left;  // by a kill after the journal's line, or of what is no longer asked
  for (const auto& entry : fs::directory_iterator(runs, ignored))
    if ((only_own_runs_ && !options_.keep_run_files) || entry.path().extension() == ".part")
      left.push_back(entry.path());
  for (const auto& entry : fs::directory_iterator(histories, ignored)) {
    const auto [first, last] = answers_.of(entry.path().stem().string());
    if (first == last) left.push_back(entry.path());
  }
  for (const fs::path& path : left) fs::remove_all(path, ignored);
  fs::remove(histories, ignored);  // Where nothing is left in it.
}

std::string EvaluationQueue::time_left(std::int64_t remaining) const {
  if (timed_ == 0 || remaining <= 0) return {};
  const double mean = simulated_seconds_ / timed_;
  const double parallel = std::clamp(static_cast<double>(in_flight_.size()), 1.0, static_cast<double>(workers_));
  return fmt::format("; at most {} left", io::duration(mean * static_cast<double>(remaining) / parallel));
}

std::vector<std::string> EvaluationQueue::own_files() {
  return {journal_name, runs_folder, histories_folder, SharedFolder::folder_name};
}

std::filesystem::path EvaluationQueue::run_file(const Request& request) {
  return std::filesystem::path(runs_folder) / (request.full_key() + ".h5");
}

void EvaluationQueue::submit(Executor& executor, const Asked& asked) const {
  Request request = asked.request;
  if (!asked.run_file) {
    io::make_folders(options_.folder / runs_folder);
    request.run_file = std::filesystem::absolute(options_.folder / run_file(asked.request));
    request.frames = options_.keep_run_files;
  } else if (!asked.run_file->empty()) {
    request.run_file = options_.folder / *asked.run_file;
  }
  executor.submit(asked.key, request);
}

void EvaluationQueue::drop_run_file(const Request& request) const {
  const std::filesystem::path path = options_.folder / run_file(request);
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  std::filesystem::remove_all(solver::RunFolder(path).path(), ignored);
}

WorkProgress EvaluationQueue::how_far(const Campaign& campaign, const Executor& executor) const {
  WorkProgress work{static_cast<std::int64_t>(answers_.size()), campaign.remaining(), campaign.standing(), 0.0, {}};
  double longest = -1.0;
  for (const UnderWay& one : executor.under_way()) {
    work.under_way += one.progress.fraction;
    if (one.progress.text.empty() || one.seconds <= longest) continue;
    longest = one.seconds;
    work.simulation = one.progress.text;
  }
  return work;
}

std::string EvaluationQueue::under_way_text(const Executor& executor) const {
  const std::vector<UnderWay> all = executor.under_way();
  const auto longest = std::max_element(all.begin(), all.end(),
                                        [](const UnderWay& a, const UnderWay& b) { return a.seconds < b.seconds; });
  if (longest == all.end() || longest->progress.text.empty() || !in_flight_.contains(longest->key)) return {};
  return fmt::format("under way since {}: {}: {}{}", io::duration(longest->seconds), in_flight_.at(longest->key).label,
                     longest->progress.text, all.size() > 1 ? fmt::format("; {} more", all.size() - 1) : "");
}

bool EvaluationQueue::run(Campaign& campaign) {
  using Clock = std::chrono::steady_clock;
  const io::Cancellation::Attention attention = options_.cancellation.attend();
  std::unique_ptr<Executor> executor;
  std::vector<Asked> wanted = wanted_by(campaign);
  bool stopped = options_.cancellation.requested();
  Clock::time_point written = Clock::now(), said = written;
  const auto tell = [&] {
    if (options_.progress) options_.progress(how_far(campaign, *executor));
  };
  while (!wanted.empty() && !stopped) {
    if (!executor) executor = options_.make_executor();
    workers_ = executor->workers();
    for (const Asked& asked : wanted)
      if (in_flight_.emplace(asked.key, asked).second) submit(*executor, asked);
    tell();
    std::optional<Answer> answer = executor->next(look_interval);
    if (options_.line_an_answer && Clock::now() - said >= options_.log_interval) {
      if (const std::string text = under_way_text(*executor); !text.empty()) io::log_info(text);
      said = Clock::now();
    }
    stopped = options_.cancellation.requested();
    if (!answer || (answer->trouble.empty() && answer->evaluation.status == results::RunStatus::stopped)) {
      if (answer) interrupted_ = std::move(answer->evaluation);
      stopped = stopped || interrupted_;
      continue;
    }
    if (!answer->trouble.empty()) {
      if (stopped) continue;  // It may have died of the same signal.
      stopped = !go_on_after(*answer, *executor);
      wanted = wanted_by(campaign);
      continue;
    }
    const Asked asked = in_flight_.at(answer->key);
    answer->attempts = attempts_[answer->key] + 1;
    record(campaign, asked, std::move(*answer));
    const Evaluation* evaluation = answer_for(asked.request, asked.key, answers_);
    if (!evaluation) throw std::logic_error("an evaluation does not answer its request: " + asked.label);
    if (!asked.run_file && !options_.keep_run_files) drop_run_file(asked.request);
    wanted = wanted_by(campaign);
    const std::string text = campaign.on_answer(asked, *evaluation);
    if (!text.empty() && options_.line_an_answer) {
      const std::string standing = campaign.standing();
      io::log_info(text + (standing.empty() ? "" : "; " + standing) + time_left(campaign.remaining()));
      said = Clock::now();
    }
    in_flight_.erase(asked.key);
    tell();
    if (wanted.empty() || Clock::now() - written < options_.results_interval) continue;
    campaign.write_results();
    if (options_.results_written) options_.results_written();
    written = Clock::now();
  }
  if (executor) executor->stop();
  if (!stopped) SharedFolder(options_.folder).end();
  if (!stopped && skipped_.empty()) clean_folder();
  std::error_code ignored;
  std::filesystem::remove(options_.folder / runs_folder, ignored);  // Where nothing is left in it.
  return !stopped;
}

}  // namespace perfora::optimize
