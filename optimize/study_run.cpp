// What is here: the loop of a study around its journal. What is not: result files (study_result.cpp).
#include "optimize/study_run.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

#include "io/journal.h"
#include "io/progress.h"
#include "optimize/work_folder.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

/// How often a stop is looked for while evaluations run.
constexpr auto look_interval = std::chrono::milliseconds(200);
constexpr double curve_step = 0.005;

/// Everything a study writes into its folder; --force removes these and nothing else.
constexpr const char* own_files[] = {"journal.jsonl",   "result.json", "best.toml",    "best.h5",
                                     "best.csv",        "best.xdmf",   "best.xdmf.h5", "best.part",
                                     "evaluations.csv", "best.png",    "study.png"};

/// Keys that may differ on resume: they only say how far to go, and the points on the way there stay the same.
bool may_change(const std::string& key) {
  static const std::set<std::string> keys{"study.maxeval", "study.refine", "study.refine_maxeval", "study.refine_step",
                                          "study.final_replicates"};
  return keys.contains(key);
}

/// Arms are compared by name; their shares of maxeval may grow with it.
std::string arm_names(const Study& study) {
  std::string names;
  for (const Arm& arm : study.arms) names += (names.empty() ? "" : "; ") + arm.name;
  return names;
}

json header(const Study& study, const std::string& command_line) {
  auto resolved = study.resolved();
  resolved["arms"] = arm_names(study);
  return {{"event", "study"},     {"schema", "perfora.study/1"},  {"results_version", results_version},
          {"resolved", resolved}, {"command_line", command_line}, {"file", study.file.filename().string()}};
}

bool same(const char* event, const json& record) {
  return record.value("event", "") == event;
}

std::string stress_text(double stress) {
  return std::isfinite(stress) ? readable(stress, io::Dimension::stress) : "none";
}

std::string duration(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace

int useful_workers(const Study& study, int asked) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int wanted = asked > 0 ? asked : study.keys.workers > 0 ? study.keys.workers : cores;
  const std::int64_t parallel = static_cast<std::int64_t>(study.arms.size()) * study.keys.replicates;
  return static_cast<int>(std::clamp<std::int64_t>(parallel, 1, wanted));
}

solver::History coarse_curve(const solver::History& history) {
  solver::History coarse;
  double strain = 0.0, stress = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < history.rows(); ++k) {
    strain += history.strain_yy[k];
    stress += history.stress_yy[k];
    ++count;
    const bool last = k + 1 == history.rows();
    if (!last && std::floor(history.strain_yy[k + 1] / curve_step) == std::floor(history.strain_yy[k] / curve_step))
      continue;
    coarse.strain_yy.push_back(strain / count);
    coarse.stress_yy.push_back(stress / count);
    strain = stress = 0.0;
    count = 0;
  }
  return coarse;
}

StudyRun::StudyRun(Study study, StudyRunOptions options)
    : study_(std::move(study)), options_(std::move(options)), driver_(study_) {
  prepare_work_folder(options_.folder, own_files, "study", options_.force, options_.resume);
  open();
}

StudyRun::~StudyRun() = default;

void StudyRun::open() {
  journal_ = std::make_unique<io::Journal>(options_.folder / "journal.jsonl");
  bool known = false;
  for (const std::string& text : journal_->events()) {
    const json record = json::parse(text);
    if (same("study", record)) {
      take_header(text);
      known = true;
    } else if (same("evaluation", record)) {
      take_evaluation(text);
    }
  }
  const json now = header(study_, options_.command_line);
  if (!known || options_.resume) journal_->append(now.dump());
}

void StudyRun::take_header(const std::string& text) {
  const json there = json::parse(text);
  const json here = header(study_, options_.command_line);
  auto refuse = [&](const std::string& key, const std::string& old_value, const std::string& new_value) {
    throw io::InputError({(options_.folder / "journal.jsonl").string(), 0, key},
                         fmt::format("the study of this folder has {}, this one has {}", old_value, new_value),
                         "only maxeval, refine and final_replicates may change when a study goes on",
                         "give the study as it was, or start another folder with -o");
  };
  auto text_of = [](const json& object, const std::string& key) {
    const auto found = object.find(key);
    return found == object.end() ? std::string("nothing")
           : found->is_string()  ? found->get<std::string>()
                                 : found->dump();
  };
  if (there.at("results_version") != here.at("results_version"))
    refuse("results_version", text_of(there, "results_version"), text_of(here, "results_version"));
  std::set<std::string> keys;
  for (const auto* object : {&there.at("resolved"), &here.at("resolved")})
    for (const auto& entry : object->items()) keys.insert(entry.key());
  for (const std::string& key : keys) {
    const std::string old_value = text_of(there.at("resolved"), key), new_value = text_of(here.at("resolved"), key);
    if (old_value != new_value && !may_change(key)) refuse(key, old_value, new_value);
  }
}

void StudyRun::take_evaluation(const std::string& text) {
  const json record = json::parse(text);
  answers_.insert_or_assign(record.at("key").get<std::string>(), evaluation_from_json(record.at("evaluation")));
  simulated_seconds_ += record.value("seconds", 0.0);
  retries_ += record.value("attempts", 1) - 1;
}

std::vector<const Evaluation*> StudyRun::known(const Candidate& candidate, int first, int count) {
  std::vector<const Evaluation*> found;
  if (candidate.violation > 0.0) return found;
  for (int replicate = first; replicate < first + count; ++replicate) {
    const auto answer = answers_.find(book().key(candidate, replicate));
    if (answer != answers_.end()) found.push_back(&answer->second);
  }
  return found;
}

void StudyRun::submit_new(Executor& executor) {
  for (const Wanted& wanted : plan_.wanted)
    if (in_flight_.emplace(wanted.key, wanted).second) executor.submit(wanted.key, wanted.request);
}

void StudyRun::record(Answer answer) {
  const Wanted& wanted = in_flight_.at(answer.key);
  answer.evaluation.curve = coarse_curve(answer.evaluation.curve);
  const json event = {{"event", "evaluation"},
                      {"key", answer.key},
                      {"candidate", wanted.candidate->label},
                      {"request", to_json(wanted.request)},
                      {"evaluation", to_json(answer.evaluation, true)},
                      {"attempts", answer.attempts},
                      {"seconds", answer.seconds}};
  const std::string text = event.dump();
  journal_->append(text);
  take_evaluation(text);  // The same way as on resume, so that both see the same numbers.
}

std::int64_t StudyRun::most_evaluations() const {
  const auto& keys = study_.keys;
  const std::int64_t candidates = std::int64_t{keys.maxeval} + (keys.refine.empty() ? 0 : keys.refine_maxeval) + 1;
  return candidates * keys.replicates + 2 * std::int64_t{keys.final_replicates};
}

std::string StudyRun::time_left() const {
  if (answers_.empty()) return {};
  const double mean = simulated_seconds_ / static_cast<double>(answers_.size());
  const auto left = static_cast<double>(most_evaluations() - static_cast<std::int64_t>(answers_.size()));
  const double parallel = std::clamp(static_cast<double>(in_flight_.size()), 1.0, static_cast<double>(workers_));
  return left <= 0.0 ? "" : fmt::format("; at most {} left", duration(mean * left / parallel));
}

void StudyRun::say(const std::string& key, const Evaluation& evaluation) {
  const Wanted& wanted = in_flight_.at(key);
  const auto all = known(*wanted.candidate, 0, study_.keys.replicates);
  std::string what = usable(evaluation) ? "plateau " + stress_text(evaluation.summary.plateau_stress)
                                        : "failed: " + (evaluation.reason.empty() ? "no plateau" : evaluation.reason);
  const bool final_stage = wanted.request.replicate >= study_.keys.replicates;
  if (!final_stage && static_cast<int>(all.size()) == study_.keys.replicates) {
    const Score score = score_of(study_.target, all);
    what += score.valid ? fmt::format(", score {:.4g}", score.value) : ", no score";
  }
  const std::string best = plan_.best ? fmt::format("; best so far {:.4g}", plan_.best_score.value) : "";
  io::log_info(fmt::format("evaluation {} of at most {}: {}, {}replicate {}: {}{}{}", answers_.size(),
                           most_evaluations(), wanted.candidate->label, final_stage ? "final " : "",
                           wanted.request.replicate + 1, what, best, time_left()));
}

void StudyRun::run() {
  const auto begin = std::chrono::steady_clock::now();
  const auto asked_to_stop = [&] { return options_.stop_requested && options_.stop_requested(); };
  plan_ = driver_.plan(answers_);
  std::unique_ptr<Executor> executor;
  bool stopped = asked_to_stop();
  while (!plan_.finished && !stopped) {
    if (!executor) executor = options_.make_executor();
    workers_ = executor->workers();
    submit_new(*executor);
    std::optional<Answer> answer = executor->next(look_interval);
    stopped = asked_to_stop();
    if (!answer || answer->evaluation.status == solver::RunStatus::stopped) {
      stopped = stopped || answer;
      continue;
    }
    if (stopped && answer->evaluation.status == solver::RunStatus::failed)
      continue;  // It may have died of the same signal.
    const std::string key = answer->key;
    record(std::move(*answer));
    plan_ = driver_.plan(answers_);
    say(key, answers_.at(key));
    in_flight_.erase(key);
  }
  if (executor) executor->stop();
  status_ = stopped      ? solver::RunStatus::stopped
            : plan_.best ? solver::RunStatus::completed
                         : solver::RunStatus::failed;
  reason_ = stopped ? "stopped by a signal; go on with --resume" : plan_.reason;
  journal_->append(json({{"event", stopped ? "stop" : "finished"}, {"reason", reason_}}).dump());
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace perfora::optimize
