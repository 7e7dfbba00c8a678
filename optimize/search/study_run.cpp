// What is here: what a study asks and says, and which journals it goes on with. What is not: result files
// (study_result.cpp).
#include "optimize/search/study_run.h"

#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "io/error.h"
#include "io/text.h"
#include "optimize/search/study_result.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

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

}  // namespace

int useful_workers(const Study& study, int asked) {
  const std::int64_t parallel = static_cast<std::int64_t>(study.arms.size()) * study.keys.replicates;
  return workers_for(asked, study.keys.execution.workers, parallel);
}

StudyRun::StudyRun(Study study, WorkOptions options) : study_(std::move(study)), driver_(study_) {
  options.execution = study_.keys.execution;
  open(std::move(options));
}

std::vector<std::string> StudyRun::own_files() const {
  return {"journal.jsonl", "result.json",  "best.toml",   "best.h5",  "best.csv",
          "best.xdmf",     "best.xdmf.h5", "best.part",   "best.png", "evaluations.csv",
          "study.json",    "study.png",    "report.html", "runs",     "histories"};
}

json StudyRun::identity() const {
  auto resolved = study_.resolved();
  resolved["arms"] = arm_names(study_);
  return {{"schema", "perfora.study/1"}, {"resolved", resolved}, {"file", study_.file.filename().string()}};
}

/// A key that the program had not learned when the head was written is the same at its default.
/// Of a key in the header of a journal: "study.maxeval", "design.layout.diameter", "variables.layout.diameter".
std::string StudyRun::name_today(const std::string& key) const {
  for (const std::string table : {"design.", "variables."})
    if (key.starts_with(table)) return table + study_.start->schema().name_today(key.substr(table.size()));
  return key;
}

void StudyRun::check_same(const json& head, const std::filesystem::path& journal) const {
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
  json there = json::object();
  for (const auto& [key, value] : head.at("resolved").items()) there[name_today(key)] = value;
  json here = identity().at("resolved");
  std::set<std::string> keys;
  for (const json* object : {&there, &here})
    for (const auto& entry : object->items()) keys.insert(entry.key());
  const std::set<std::string> at_default = study_.at_default();
  for (const std::string& key : keys) {
    if (!there.contains(key) && at_default.contains(key)) continue;
    const std::string old_value = text_of(there, key), new_value = text_of(here, key);
    if (old_value != new_value && !may_change(key)) refuse(key, old_value, new_value);
  }
}

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

std::int64_t StudyRun::remaining() const {
  return most_evaluations() - static_cast<std::int64_t>(answers().size());
}

std::string StudyRun::on_answer(const Asked& asked, const Evaluation& evaluation) {
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
  return fmt::format("evaluation {} of at most {}: {}, {}replicate {}: {}{}", done, most_evaluations(), asked.label,
                     final_stage ? "final " : "", asked.request.replicate + 1, what, best);
}

std::vector<Asked> StudyRun::pending(const Answers& answers) {
  plan_ = driver_.plan(answers);
  std::vector<Asked> asked;
  for (const Wanted& one : plan_.wanted) {
    candidates_[one.key] = one.candidate;
    asked.push_back({one.key, one.request, one.candidate->label});
  }
  return asked;
}

CampaignEnd StudyRun::finished() {
  return {plan_.best ? results::RunStatus::completed : results::RunStatus::failed, plan_.reason};
}

void StudyRun::write_results() {
  optimize::write_results(*this);
}

}  // namespace perfora::optimize
