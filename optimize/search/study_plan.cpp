// What is here: counts a stage, from keys or from a budget. What is not: the stages themselves (driver.cpp).
#include "optimize/search/study_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text.h"
#include "optimize/evaluate/estimate.h"
#include "optimize/search/candidate.h"
#include "results/campaign_folder.h"

namespace perfora::optimize {

using nlohmann::json;

namespace {

/// Of what is left beside the end of the study, for its map.
constexpr double fraction_of_map = 0.4;
constexpr int usual_finalists = 12;
/// Race and verification take no more of a budget that leaves them open.
constexpr double most_of_race = 0.15;

std::int64_t verified(const Study& study) {
  return study.keys.race.finalists > 0 ? study.keys.race.keep : 1;
}

std::int64_t race_runs(const RaceKeys& keys) {
  std::int64_t runs = 0;
  for (const int designs : race_rounds(keys)) runs += std::int64_t{designs} * keys.replicates;
  return runs;
}

}  // namespace

std::vector<int> race_rounds(const RaceKeys& keys) {
  std::vector<int> rounds;
  for (int left = keys.finalists; left > keys.keep; left = std::max(keys.keep, (left + 1) / 2)) rounds.push_back(left);
  if (rounds.empty() && keys.finalists > 0) rounds.push_back(keys.finalists);
  return rounds;
}

bool is_plain(const StudyKeys& keys) {
  return keys.map.designs == 0 && keys.map.from.empty() && keys.race.finalists == 0 && keys.fidelity.empty() &&
         keys.verify.fidelity.empty() && !(keys.budget > 0.0);
}

double run_seconds(const Study& study, std::size_t fidelity) {
  if (study.costs[fidelity] > 0.0) return study.costs[fidelity];
  DesignFile design = study.start->clone();
  apply(study.fidelities[fidelity], design, {study.file.string(), 0, ""});
  design.require_valid();
  return estimate_design(design, 1).seconds;
}

StudyPlan plan_of(const Study& study) {
  const StudyKeys& keys = study.keys;
  StudyPlan plan;
  std::vector<double> costs(study.fidelities.size(), -1.0);  // an estimate takes a while
  const auto stage = [&](const char* name, std::size_t fidelity, std::int64_t designs, std::int64_t runs) {
    if (costs[fidelity] < 0.0) costs[fidelity] = run_seconds(study, fidelity);
    return PlannedStage{
        name, study.fidelities[fidelity].name, designs, runs, costs[fidelity], study.costs[fidelity] > 0.0};
  };
  const auto add = [&](const PlannedStage& one) {
    if (one.runs > 0) plan.stages.push_back(one);
  };
  add(stage("map", study.map_fidelity, keys.map.designs,
            std::int64_t{keys.map.designs} * keys.map.replicates - study.taken.map_runs));
  if (keys.maxeval == 0) return plan;
  add(stage("start", 0, 1, keys.replicates));
  add(stage("search", 0, keys.maxeval, std::int64_t{keys.maxeval} * keys.replicates));
  // Of a map of another folder, too: its replicates are taken to be as many as those of this study's map.
  if (const int mapped = std::max(keys.map.designs, study.taken.designs); mapped > 0) {
    const int taken = std::min(mapped, std::max(1, keys.race.finalists));
    const int known = study.map_fidelity == 0 ? std::min(keys.map.replicates, keys.replicates) : 0;
    add(stage("best of the map", 0, taken, std::int64_t{taken} * (keys.replicates - known)));
  }
  if (!keys.refine.empty())
    add(stage("refine", 0, keys.refine_maxeval, std::int64_t{keys.refine_maxeval} * keys.replicates));
  add(stage("race", 0, keys.race.finalists, race_runs(keys.race)));
  const std::int64_t ends = verified(study), start = keys.start_final_replicates();
  add(stage("verify", study.verify_fidelity, ends + 1, ends * keys.final_replicates + start));
  // Another design than the first of the race may come out best; it and the start are then run once more. Or the start
  // itself may, where it is a candidate.
  if (verified(study) > 1)
    add(stage("confirm", study.verify_fidelity, 2, std::int64_t{keys.final_replicates} + start));
  else if (CandidateBook(study).start().arm >= 0)
    add(stage("confirm", study.verify_fidelity, 1, keys.final_replicates));
  return plan;
}

std::int64_t StudyPlan::runs() const {
  std::int64_t sum = 0;
  for (const PlannedStage& one : stages) sum += one.runs;
  return sum;
}

double StudyPlan::seconds() const {
  double sum = 0.0;
  for (const PlannedStage& one : stages) sum += one.seconds();
  return sum;
}

void spend_budget(Study& study, const LeftOpen& open, const io::Origin& origin) {
  StudyKeys& keys = study.keys;
  const double run = run_seconds(study, 0), candidate = run * keys.replicates;
  if (open.map_designs) keys.map.designs = 0;
  if (open.finalists) {
    const double round = run * keys.race.replicates + run_seconds(study, study.verify_fidelity) * keys.final_replicates;
    keys.race.finalists = std::clamp(static_cast<int>(most_of_race * keys.budget / round), 0, usual_finalists);
    keys.race.keep = std::max(1, (keys.race.finalists + 2) / 3);
    if (keys.race.finalists < 2) keys.race.finalists = 0, keys.race.keep = 1;
  }
  keys.maxeval = static_cast<int>(study.arms.size());
  const double least = plan_of(study).seconds();
  double left = keys.budget - least;
  if (left < 0.0)
    throw io::InputError(
        origin,
        fmt::format("{} of one processor are too short: one candidate an arm and the end of the study take {}",
                    io::duration(keys.budget), io::duration(least)),
        "", "raise it, lower study.final_replicates, name a cheaper fidelity, or vary less");
  if (open.map_designs && keys.map.from.empty()) {
    const double design = run_seconds(study, study.map_fidelity) * keys.map.replicates;
    const int before = keys.map.designs;
    keys.map.designs = static_cast<int>(fraction_of_map * left / design);
    while (keys.map.designs > before && plan_of(study).seconds() > keys.budget) --keys.map.designs;
    left = keys.budget - plan_of(study).seconds();
  }
  constexpr double most = 1e6;
  keys.maxeval += static_cast<int>(std::min(most, left / candidate));
}

json planned(const Study& study) {
  const StudyKeys& keys = study.keys;
  json arms = json::object();
  for (const Arm& arm : study.arms) arms[arm.name] = arm.maxeval;
  json stages = json::array();
  const StudyPlan plan = plan_of(study);
  for (const PlannedStage& one : plan.stages)
    stages.push_back({{"stage", one.name},
                      {"fidelity", one.fidelity},
                      {"designs", one.designs},
                      {"runs", one.runs},
                      {"run_seconds", one.run_seconds},
                      {"measured", one.measured}});
  return {{"budget", keys.budget},
          {"map_designs", keys.map.designs},
          {"maxeval", keys.maxeval},
          {"arms", arms},
          {"finalists", keys.race.finalists},
          {"keep", keys.race.keep},
          {"seconds", plan.seconds()},
          {"taken_evaluations", study.taken.evaluations},
          {"taken_seconds", study.taken.seconds},
          {"stages", stages}};
}

void keep_planned(Study& study, const std::filesystem::path& folder) {
  if (!(study.keys.budget > 0.0)) return;
  for (const json& event : results::journal_events(folder)) {
    const auto plan = event.find("plan");
    if (plan == event.end() || plan->value("budget", 0.0) != study.keys.budget) continue;
    StudyKeys& keys = study.keys;
    keys.map.designs = plan->at("map_designs").get<int>();
    keys.maxeval = plan->at("maxeval").get<int>();
    keys.race.finalists = plan->at("finalists").get<int>();
    keys.race.keep = plan->at("keep").get<int>();
    for (Arm& arm : study.arms) arm.maxeval = plan->at("arms").value(arm.name, arm.maxeval);
    return;
  }
}

}  // namespace perfora::optimize
