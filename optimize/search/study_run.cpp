// What is here: what a study asks and says, and which journals it goes on with. What is not: result files
// (study_result.cpp).
#include "optimize/search/study_run.h"

#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "io/error.h"
#include "io/progress.h"
#include "io/text.h"
#include "optimize/campaign/evaluation_queue.h"
#include "optimize/search/map_import.h"
#include "optimize/search/map_result.h"
#include "optimize/search/study_result.h"
#include "optimize/search/study_space.h"
#include "results/campaign_folder.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

/// Keys that may differ on resume: they say how far to go, so that the points on the way there stay the same, or what
/// is wished, so that all that is known is measured anew.
bool may_change(const Difference& one) {
  static const std::set<std::string> keys{"study.maxeval",     "study.refine",           "study.refine_maxeval",
                                          "study.refine_step", "study.final_replicates", "study.budget",
                                          "map.designs",       "race.finalists",         "race.keep",
                                          "race.replicates",   "verify.fidelity"};
  const std::string& key = one.key;
  return keys.contains(key) || key.starts_with("target.") || key.starts_with("design.target.") ||
         key.starts_with("design.measures.") || (key.starts_with("fidelity.") && one.there == "nothing");
}

/// How often the surroundings of a run cost more than the run itself: a limit of time is kept by this much.
constexpr double margin = 1.2;

/// Whether a replicate is one of the verification.
bool is_final(const Plan& plan, int replicate) {
  return plan.finals.replicates > 0 && replicate >= plan.finals.first;
}

/// What is asked first says it.
std::string stage_now(const Plan& plan, const Study& study) {
  if (plan.wanted.empty()) return plan.finished ? "finished" : "waiting";
  const int replicate = plan.wanted.front().request.replicate;
  if (replicate >= first_confirming_replicate) return "confirmation";
  if (replicate >= first_race_replicate) return "race";
  if (study.keys.map.designs > 0 && !plan.map_finished) return "map";
  return is_final(plan, replicate) ? "verification" : "search";
}

}  // namespace

int useful_workers(const Study& study, int asked) {
  const StudyKeys& keys = study.keys;
  std::int64_t parallel = static_cast<std::int64_t>(study.arms.size()) * keys.replicates;
  if (study.searcher->asks_in_batches()) parallel = std::max(parallel, std::int64_t{keys.batch} * keys.replicates);
  if (study.searcher->asks_at_once()) parallel = std::max(parallel, std::int64_t{keys.maxeval} * keys.replicates);
  parallel = std::max(parallel, std::int64_t{keys.map.designs} * keys.map.replicates);
  parallel = std::max(parallel, std::int64_t{keys.race.finalists} * keys.race.replicates);
  return workers_for(asked, study.keys.execution.workers, parallel);
}

StudyRun::StudyRun(Study study, WorkOptions options, double wall_time)
    : study_(std::move(study)), driver_(study_), wall_time_(wall_time) {
  options.execution = study_.keys.execution;
  if (options.resume) keep_planned(study_, options.folder);
  planned_ = plan_of(study_);
  Taken taken = read_map(options);  // before the folder is begun: it may be refused
  open(std::move(options));
  take_map(std::move(taken));
  taken_over_ = tell_driver(driver_, study_, results::journal_events(this->options().folder), kind());
}

std::vector<std::string> StudyRun::own_files() const {
  return {"result.json", "best.toml", "best.h5",         "best.csv",   "best.xdmf", "best.xdmf.h5",
          "best.part",   "best.png",  "evaluations.csv", "study.json", "study.png", "report.html",
          "map.json",    "map.csv",   "candidates.csv",  "map.png"};
}

json StudyRun::identity() const {
  json head = study_identity(study_);
  head["schema"] = "perfora.study/1";
  head["plan"] = planned(study_);
  return head;
}

void StudyRun::check_same(const json& head, const std::filesystem::path& journal) const {
  for (const Difference& one : differences(study_, head))
    if (!may_change(one))
      throw io::InputError(
          {journal.string(), 0, one.key},
          fmt::format("the study of this folder has {}, this one has {}", shown(one.there), shown(one.here)),
          "only [target], [map], [race], maxeval, budget, refine and final_replicates may change when "
          "a study goes on",
          "give the study as it was, or start another folder with -o");
}

StudyRun::Taken StudyRun::read_map(const WorkOptions& options) {
  const std::filesystem::path& from = study_.keys.map.from;
  if (from.empty()) return {};
  std::set<std::string> there;  // a kill may have left a part
  for (const json& event : options.resume ? results::journal_events(options.folder) : std::vector<json>()) {
    if (event.value("event", "") == "map_taken" && event.value("from", "") == from.string()) return {};
    if (event.value(taken_over_name, false)) there.insert(event.at("key").get<std::string>());
  }
  const io::Origin origin{study_.file.string(), 0, "map.from"};
  Taken taken{evaluations_of(from, study_, origin), 0};
  taken.designs = designs_of(taken.events, study_, driver_.book()).size();
  if (taken.designs == 0)
    throw io::InputError(origin, fmt::format("{} holds no design of this study", from.string()), "",
                         "name another folder");
  std::erase_if(taken.events, [&](const json& event) { return there.contains(event.at("key").get<std::string>()); });
  return taken;
}

void StudyRun::take_map(Taken taken) {
  if (taken.designs == 0) return;
  const std::filesystem::path& from = study_.keys.map.from;
  // Another wish is measured on whole histories; a folder that was copied without them answers its own wish alone.
  const std::string frame = study_.start->design().measuring_frame().text();
  const auto lost = std::count_if(taken.events.begin(), taken.events.end(), [&](const json& event) {
    const json& run = event.at("evaluation");
    return run.value("status", "") == "completed" && run.value("measured", "") != frame &&
           !std::filesystem::exists(from / EvaluationQueue::history_file(event.at("key").get<std::string>()));
  });
  if (lost > 0)
    io::log_warning(fmt::format(
        "{} of the {} runs in {} are without their history (folder histories): what they give for this target is not "
        "known, so they are run again; copy the folder whole",
        lost, taken.events.size(), from.string()));
  for (json& event : taken.events) take_over(std::move(event), from);
  note({{"event", "map_taken"}, {"from", from.string()}, {"designs", taken.designs}});
}

std::optional<results::MapRecord> StudyRun::map() {
  if (plan_.map.empty()) return std::nullopt;
  return map_record(study_, driver_.book(), answers(), plan_);
}

std::vector<const Evaluation*> StudyRun::known(const Candidate& candidate, int first, int count, std::size_t fidelity) {
  if (candidate.violation > 0.0) return {};
  auto found = CandidateStore(study_, book(), answers()).evaluations(candidate, first, count, fidelity);
  std::erase(found, nullptr);
  return found;
}

std::int64_t StudyRun::remaining() const {
  const std::int64_t own = static_cast<std::int64_t>(answers().size()) - taken_over_;
  return std::max<std::int64_t>(0, planned_.runs() - own);
}

std::string StudyRun::on_answer(const Asked& asked, const Evaluation& evaluation) {
  const Candidate& candidate = *candidates_.at(asked.key);
  const auto all = known(candidate, 0, study_.keys.replicates);
  std::string what = usable(evaluation)
                         ? "plateau " + io::quantity(evaluation.summary.plateau_stress, io::Dimension::stress, "none")
                         : "failed: " + (evaluation.reason.empty() ? "no plateau" : evaluation.reason);
  const int replicate = asked.request.replicate;
  const char* stage = replicate >= first_confirming_replicate ? "confirming "
                      : replicate >= first_race_replicate     ? "race "
                      : is_final(plan_, replicate)            ? "final "
                                                              : "";
  const bool scored = asked.request.fidelity == study_.fidelities.front().name;
  if (*stage == '\0' && scored && static_cast<int>(all.size()) == study_.keys.replicates) {
    const Score score = score_of(study_.target, all);
    what += score.valid ? fmt::format(", score {:.4g}", score.value) : ", no score";
  }
  const std::int64_t most = planned_.runs(), done = most - remaining();
  return fmt::format("evaluation {} of at most {}: {}, {}replicate {}: {}", done, most, asked.label, stage, replicate,
                     what);
}

/// Computed after every answer, not at every look at it.
std::string StudyRun::standing_now() {
  std::string text = stage_now(plan_, study_);
  const bool past_search = plan_.finished || text == "race" || text == "verification" || text == "confirmation";
  if (!plan_.best) return text;
  // At the end the model's expectation recommends, not the smallest score that was seen.
  text += fmt::format(", {}: score {:.4g}{}", past_search ? "recommended" : "best so far", plan_.best_score.value,
                      wishes_text(plan_.best_score));
  if (const auto verdict = verdict_of(*this))
    text += fmt::format(", verdict so far: {}", results::outcome_name(verdict->outcome));
  text += ", " + plan_.best->label;  // last: a terminal may cut it off
  return text;
}

void StudyRun::end_early_if_late() {
  if (!(wall_time_ > 0.0) || driver_.search_ended() || plan_.finished || !plan_.finalists.empty()) return;
  const auto own = static_cast<double>(answers().size()) - taken_over_;
  if (!(own > 0.0)) return;
  const double slower = simulated_seconds() / own / run_seconds(study_, 0);
  double behind = 0.0;  // of one processor
  for (const PlannedStage& stage : planned_.stages)
    if (stage.name == "race" || stage.name == "verify" || stage.name == "best of the map") behind += stage.seconds();
  const int together = std::max(1, useful_workers(study_, 0));
  if (seconds() < wall_time_ - margin * slower * behind / together) return;
  json dropped = json::array();
  std::set<const Candidate*> open;
  for (const Wanted& one : plan_.wanted)
    if (open.insert(one.candidate).second)
      dropped.push_back({{"arm", one.candidate->arm}, {"values", one.candidate->values}});
  const std::string reason =
      fmt::format("ended early, after {}, to keep to {}", io::duration(seconds()), io::duration(wall_time_));
  note({{"event", "early_end"}, {"reason", reason}, {"dropped", dropped}});
  io::log_warning("the search is " + reason);
  driver_.end_search(reason, std::move(open));
  plan_ = driver_.plan(answers());
}

std::vector<Asked> StudyRun::pending(const Answers& answers) {
  plan_ = driver_.plan(answers);
  end_early_if_late();
  for (const Trace& trace : plan_.traces)
    if (!trace.note.empty() && said_.insert(trace.note).second) io::log_info(trace.note);
  for (const Batch& batch : plan_.new_batches) {
    note(to_json(batch, study_));
    driver_.take(batch);
  }
  std::vector<Asked> asked;
  for (const Wanted& one : plan_.wanted) {
    candidates_[one.key] = one.candidate;
    asked.push_back({one.key, one.request, one.candidate->label});
  }
  standing_ = standing_now();
  return asked;
}

CampaignEnd StudyRun::finished() {
  return {plan_.best ? results::RunStatus::completed : results::RunStatus::failed, plan_.reason};
}

void StudyRun::write_results() {
  optimize::write_results(*this);
}

}  // namespace perfora::optimize
