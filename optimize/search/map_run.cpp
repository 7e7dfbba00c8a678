// What is here: what a map asks and says. What is not: its record (map_result.h).
#include "optimize/search/map_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/error.h"
#include "io/text.h"
#include "optimize/search/map_import.h"
#include "optimize/search/map_result.h"
#include "optimize/search/study_space.h"
#include "results/campaign_folder.h"
#include "results/formats.h"

namespace perfora::optimize {

using nlohmann::json;

MapRun::MapRun(Study study, WorkOptions options) : study_(std::move(study)), driver_(study_) {
  options.execution = study_.keys.execution;
  open(std::move(options));
  static_cast<void>(tell_driver(driver_, study_, results::journal_events(this->options().folder), kind()));
}

std::vector<std::string> MapRun::own_files() const {
  return {"map.json", "map.csv", "map.png", "report.html"};
}

json MapRun::identity() const {
  json head = study_identity(study_);
  head["schema"] = results::map_schema;
  return head;
}

void MapRun::check_same(const json& head, const std::filesystem::path& journal) const {
  const Difference one = difference_in_space(study_, head);
  if (!one.key.empty())
    throw io::InputError(
        {journal.string(), 0, one.key},
        fmt::format("the map of this folder has {}, this one has {}", shown(one.there), shown(one.here)),
        "only the number of designs and what is wished may change when a map goes on",
        "give the study as it was, or start another folder with -o");
}

results::MapRecord MapRun::record() {
  return map_record(study_, driver_.book(), answers(), plan_);
}

std::vector<Asked> MapRun::pending(const Answers& answers) {
  plan_ = driver_.plan_map(answers);
  for (const Batch& batch : plan_.new_batches) {
    note(to_json(batch, study_));
    driver_.take(batch);
  }
  std::vector<Asked> asked;
  for (const Wanted& one : plan_.wanted) asked.push_back({one.key, one.request, one.candidate->label});
  remaining_ = static_cast<std::int64_t>(asked.size());
  standing_ = standing_of_map(study_, plan_);
  return asked;
}

std::string MapRun::on_answer(const Asked& asked, const Evaluation& evaluation) {
  const bool completed = evaluation.status == results::RunStatus::completed;
  const std::int64_t all = static_cast<std::int64_t>(plan_.map.size()) * study_.keys.map.replicates;
  return fmt::format(
      "evaluation {} of {}: {}, replicate {}: {}", all - remaining_, all, asked.label, asked.request.replicate,
      completed ? "plateau " + io::quantity(evaluation.summary.plateau_stress, io::Dimension::stress, "none")
                : "failed: " + evaluation.reason);
}

CampaignEnd MapRun::finished() {
  const bool any = std::any_of(plan_.map.begin(), plan_.map.end(),
                               [](const Visit& visit) { return visit.detail.failed < visit.detail.replicates; });
  return {any ? results::RunStatus::completed : results::RunStatus::failed, plan_.reason};
}

void MapRun::write_results() {
  write_map(record(), options().folder);
}

}  // namespace perfora::optimize
