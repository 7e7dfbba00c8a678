// What is here: the loop of a study around its journal. What is not: result files (study_result.cpp).
#include "optimize/search/study_run.h"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "io/progress.h"
#include "io/text.h"
#include "optimize/campaign/work_folder.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

/// Everything a study writes into its folder; --force removes these and nothing else.
constexpr const char* own_files[] = {"journal.jsonl", "result.json",  "best.toml", "best.h5",         "best.csv",
                                     "best.xdmf",     "best.xdmf.h5", "best.part", "evaluations.csv", "best.png",
                                     "study.png",     "runs",         "histories"};

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

/// Throws io::InputError when the study of a journal's header differs from this one in more than how far to go. A key
/// that the program had not learned when the header was written is the same at its default.
void check_same_study(const json& there, const json& here, const Study& study, const std::filesystem::path& journal) {
  auto refuse = [&](const std::string& key, const std::string& old_value, const std::string& new_value) {
    throw io::InputError({journal.string(), 0, key},
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
  const std::set<std::string> at_default = study.at_default();
  for (const std::string& key : keys) {
    if (!there.at("resolved").contains(key) && at_default.contains(key)) continue;
    const std::string old_value = text_of(there.at("resolved"), key), new_value = text_of(here.at("resolved"), key);
    if (old_value != new_value && !may_change(key)) refuse(key, old_value, new_value);
  }
}

}  // namespace

int useful_workers(const Study& study, int asked) {
  const std::int64_t parallel = static_cast<std::int64_t>(study.arms.size()) * study.keys.replicates;
  return workers_for(asked, study.keys.workers, parallel);
}

StudyRun::StudyRun(Study study, WorkOptions options) : study_(std::move(study)), driver_(study_) {
  prepare_work_folder(options.folder, own_files, "study", options.force, options.resume);
  const bool resume = options.resume;
  const json now = header(study_, options.command_line);
  bool known = false;
  const auto path = options.folder / "journal.jsonl";
  queue_ = std::make_unique<EvaluationQueue>(std::move(options), [&](const json& event) {
    if (event.value("event", "") != "study") return;
    check_same_study(event, now, study_, path);
    known = true;
  });
  if (!known || resume) queue_->note(now);
}

StudyRun::~StudyRun() = default;

std::vector<const Evaluation*> StudyRun::known(const Candidate& candidate, int first, int count) {
  std::vector<const Evaluation*> found;
  if (candidate.violation > 0.0) return found;
  for (int replicate = first; replicate < first + count; ++replicate) {
    const Evaluation* answer = answer_for(candidate.request(replicate), book().key(candidate, replicate), answers());
    if (answer) found.push_back(answer);
  }
  return found;
}

std::int64_t StudyRun::most_evaluations() const {
  const auto& keys = study_.keys;
  const std::int64_t candidates = std::int64_t{keys.maxeval} + (keys.refine.empty() ? 0 : keys.refine_maxeval) + 1;
  return candidates * keys.replicates + 2 * std::int64_t{keys.final_replicates};
}

void StudyRun::say(const Asked& asked, const Evaluation& evaluation) {
  const Candidate& candidate = *candidates_.at(asked.key);
  const auto all = known(candidate, 0, study_.keys.replicates);
  std::string what = usable(evaluation)
                         ? "plateau " + io::quantity(evaluation.summary.plateau_stress, io::Dimension::stress, "none")
                         : "failed: " + (evaluation.reason.empty() ? "no plateau" : evaluation.reason);
  const bool final_stage = asked.request.replicate >= study_.keys.replicates;
  if (!final_stage && static_cast<int>(all.size()) == study_.keys.replicates) {
    const Score score = score_of(study_.target, all);
    what += score.valid ? fmt::format(", score {:.4g}", score.value) : ", no score";
  }
  const std::string best = plan_.best ? fmt::format("; best so far {:.4g}", plan_.best_score.value) : "";
  const auto done = static_cast<std::int64_t>(answers().size());
  io::log_info(fmt::format("evaluation {} of at most {}: {}, {}replicate {}: {}{}{}", done, most_evaluations(),
                           asked.label, final_stage ? "final " : "", asked.request.replicate + 1, what, best,
                           queue_->time_left(most_evaluations() - done)));
}

std::vector<Asked> StudyRun::wanted() {
  plan_ = driver_.plan(answers());
  std::vector<Asked> asked;
  for (const Wanted& one : plan_.wanted) {
    candidates_[one.key] = one.candidate;
    asked.push_back({one.key, one.request, one.candidate->label});
  }
  return asked;
}

void StudyRun::run() {
  const auto begin = std::chrono::steady_clock::now();
  const bool done = queue_->run([this] { return wanted(); },
                                [this](const Asked& asked, const Evaluation& evaluation) { say(asked, evaluation); });
  status_ = !done        ? results::RunStatus::stopped
            : plan_.best ? results::RunStatus::completed
                         : results::RunStatus::failed;
  reason_ = done ? plan_.reason : "stopped by a signal; go on with --resume";
  queue_->note({{"event", done ? "finished" : "stop"}, {"reason", reason_}});
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace perfora::optimize
