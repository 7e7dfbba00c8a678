// What is here: the result files of a study. What is not: the search.
#include "optimize/search/study_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/csv.h"
#include "io/files.h"
#include "io/hdf5.h"
#include "io/text.h"
#include "optimize/campaign/value_json.h"
#include "optimize/search/map_result.h"
#include "optimize/search/model_record.h"
#include "optimize/search/searcher.h"
#include "optimize/search/study_parts.h"
#include "optimize/search/study_plan.h"
#include "optimize/search/study_record.h"
#include "results/formats.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

std::string window_text(const results::MeasureOptions& measures) {
  if (measures.plateau == results::PlateauPlace::found) return "on the found plateau";
  return fmt::format("over strain {:g} to {:g}", measures.plateau_start, measures.plateau_end);
}

/// What all designs that were simulated, the start among them, reached of each wish.
std::vector<results::Reach> reach_of(const StudyRun& run) {
  const results::Target& target = run.study().target;
  const auto recorded = results::recorded_measures(target);
  std::vector<results::Reach> all;
  for (const results::Wish& wish : results::wishes(target)) {
    const auto place = std::find(recorded.begin(), recorded.end(), wish.measure) - recorded.begin();
    results::Reach reach{wish.measure};
    const auto add = [&](const Score& score) {
      if (!score.valid) return;
      const double mean = score.recorded[static_cast<std::size_t>(place)];
      if (!std::isfinite(mean)) return;
      reach.low = reach.candidates == 0 ? mean : std::min(reach.low, mean);
      reach.high = reach.candidates == 0 ? mean : std::max(reach.high, mean);
      ++reach.candidates;
    };
    // Levels do not carry over from one fidelity to another: what none of them gave is out of reach.
    for (const Visit& visit : run.plan().map) add(visit.detail);
    for (const Trace& trace : run.plan().traces)
      for (const Visit& visit : trace.visits) add(visit.detail);
    for (const Verified& one : run.plan().verified) add(one.score);
    // What the start reached on fresh seeds counts for more than the few of the search.
    const Finals& finals = run.plan().finals;
    add(finals.replicates > 0 ? finals.start : run.plan().start.detail);
    all.push_back(reach);
  }
  return all;
}

json finals_json(const Plan& plan) {
  const Finals& finals = plan.finals;
  if (finals.replicates == 0 || finals.best.replicates == 0) return nullptr;
  json found = {{"replicates", finals.replicates},
                {"pairs", finals.pairs},
                {"best", score_json(finals.best)},
                {"start", score_json(finals.start)},
                {"best_scores", finals.best_scores},
                {"start_scores", finals.start_scores},
                {"gain", finals.pairs > 0 ? number(finals.gain) : json(nullptr)},
                {"gain_standard_error", finals.pairs > 1 ? number(finals.gain_error) : json(nullptr)},
                {"gain_confidence_95", finals.pairs > 1 ? number(finals.gain_interval) : json(nullptr)},
                {"significant", finals.significant}};
  if (plan.start.candidate && plan.start.candidate->violation > 0.0)
    found["not_compared"] = "the start breaks a constraint";
  return found;
}

json arms_json(const StudyRun& run) {
  json arms = json::array();
  for (const Trace& trace : run.plan().traces) {
    const Arm& arm = run.study().arms[static_cast<std::size_t>(trace.arm)];
    json best = nullptr;
    std::int64_t answered = 0, violating = 0;
    for (const Visit& visit : trace.visits) {
      answered += visit.answered;
      violating += visit.candidate->violation > 0.0;
      if (visit.detail.valid && (best.is_null() || visit.score < best.get<double>())) best = visit.score;
    }
    arms.push_back({{"name", arm.name},
                    {"stage", trace.refine ? "refine" : "search"},
                    {"maxeval", trace.refine ? run.study().keys.refine_maxeval : arm.maxeval},
                    {"candidates", answered},
                    {"breaking_a_constraint", violating},
                    {"best_score", best},
                    {"stop_reason", trace.finished ? json(trace.reason) : json(nullptr)}});
    if (!trace.note.empty()) arms.back()["note"] = trace.note;
  }
  return arms;
}

json performance_json(const StudyRun& run) {
  double memory = 0.0;
  std::string simd;
  int threads = 1;
  double steps = 0.0, bond_steps = 0.0, seconds = 0.0;  // of the simulations alone
  for (const auto& [key, evaluation] : run.answers()) {
    memory = std::max(memory, evaluation.performance.peak_memory);
    simd = evaluation.performance.simd.empty() ? simd : evaluation.performance.simd;
    threads = std::max(threads, evaluation.performance.threads);
    const double time = evaluation.performance.seconds, per_bond = evaluation.performance.ns_per_bond_step;
    if (!(time > 0.0) || !(per_bond > 0.0)) continue;
    steps += static_cast<double>(evaluation.summary.steps);
    bond_steps += time / per_bond;
    seconds += time;
  }
  return {{"seconds", run.seconds()},
          {"simulated_seconds", run.simulated_seconds()},
          {"retries", run.retries()},
          {"steps_per_second", seconds > 0.0 ? json(steps / seconds) : json(nullptr)},
          {"ns_per_bond_step", bond_steps > 0.0 ? json(seconds / bond_steps) : json(nullptr)},
          {"threads", threads},
          {"simd", simd},
          {"peak_memory", number(memory)}};
}

/// The plateau of the best design on the most seeds there are: fresh ones where they were run.
json plateau_json(const Plan& plan) {
  const bool fresh = plan.finals.best.replicates - plan.finals.best.failed > 0;
  const Score& score = fresh ? plan.finals.best : plan.best_score;
  return {{"mean", number(score.plateau_mean)},
          {"standard_deviation", score.replicates - score.failed > 1 ? number(score.plateau_std) : json(nullptr)},
          {"count", score.replicates - score.failed},
          {"seeds", fresh ? "fresh" : "of the search"}};
}

/// Places among the recorded measures of those without a column of old.
std::vector<std::size_t> further_columns(const Study& study) {
  static const std::set<std::string_view> there{"plateau_stress", "undulation", "first_peak_stress"};
  const auto recorded = results::recorded_measures(study.target);
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < recorded.size(); ++k)
    if (!there.contains(recorded[k]->key)) places.push_back(k);
  return places;
}

std::string csv_line(const Study& study, const char* stage, const std::string& arm, std::size_t place,
                     const Visit& visit) {
  std::string line = fmt::format("{},{},{}", stage, io::csv_quoted(arm), place);
  for (std::size_t k = 0; k < study.variables.size(); ++k) line += fmt::format(",{}", visit.candidate->values[k]);
  const bool broken = visit.candidate->violation > 0.0;
  const char* status = broken               ? "breaks a constraint"
                       : !visit.answered    ? "open"
                       : visit.detail.valid ? "completed"
                                            : "failed";
  line += fmt::format(",{},{}", io::csv_quoted(status), visit.candidate->violation);
  auto add = [&](double value, bool known) { line += known ? fmt::format(",{}", value) : ","; };
  const bool any = visit.detail.replicates > visit.detail.failed;
  add(visit.score, visit.answered);
  add(visit.detail.not_kept, visit.detail.valid);
  add(visit.detail.plateau_mean, any);
  add(visit.detail.plateau_std, visit.detail.replicates - visit.detail.failed > 1);
  add(visit.detail.undulation_mean, any);
  add(visit.detail.first_peak_mean, any);
  const auto columns = further_columns(study);
  for (const std::size_t k : columns) {
    const bool known = any && k < visit.detail.recorded.size() && std::isfinite(visit.detail.recorded[k]);
    add(known ? visit.detail.recorded[k] : 0.0, known);
  }
  return line + fmt::format(",{},{}\n", visit.detail.replicates, visit.detail.failed);
}

/// What the model says of all that was evaluated, the designs of the map among them.
json model_of(StudyRun& run) {
  CandidateStore store(run.study(), run.book(), run.answers());
  for (const Candidate* one : run.plan().told) store.observe(*one);
  std::vector<const Candidate*> visited;
  for (const Trace& trace : run.plan().traces)
    for (const Visit& visit : trace.visits) visited.push_back(visit.candidate);
  return model_json(store, visited);
}

}  // namespace

std::optional<results::Verdict> verdict_of(StudyRun& run) {
  const Plan& plan = run.plan();
  const Study& study = run.study();
  if (!plan.best || results::wishes(study.target).empty()) return std::nullopt;
  auto judged = fresh_blocks(run);
  const bool fresh = !judged.empty();
  if (!fresh) judged = run.known(*plan.best, 0, study.keys.replicates);
  return results::verdict_on(study.target, judged, fresh, reach_of(run));
}

json to_json(StudyRun& run) {
  const Plan& plan = run.plan();
  const Study& study = run.study();
  const Searcher::Library library = study.searcher->library();
  json record = {{"schema", results::study_schema},
                 {"status", results::status_name(run.status())},
                 {"reason", run.reason()},
                 {"seeds", to_json(study.start->design().seeds.effective(0))},
                 {"results_version", results_version},
                 {"algorithm", study.keys.algorithm},
                 {library.name + "_version", library.version},
                 {"target", study.target.plateau_stress > 0.0 ? json(study.target.plateau_stress) : json(nullptr)},
                 {"plateau_window", window_json(study.start->design().measures)},
                 {"until", study.until()},
                 {"replicates", study.keys.replicates},
                 {"evaluations", run.answers().size()},
                 {"stop_reason", run.reason()},
                 {"arms", arms_json(run)}};
  if (const auto verdict = verdict_of(run)) record["verdict"] = results::to_json(*verdict);
  record["best"] = plan.best ? design_values(study, *plan.best) : json(nullptr);
  record["best_design"] = plan.best ? json("best.toml") : json(nullptr);
  record["score"] = plan.best ? number(plan.best_score.value) : json(nullptr);
  record["plateau_stress"] = plan.best ? plateau_json(plan) : json(nullptr);
  const Candidate* start = plan.start.candidate;
  record["start"] = start ? design_values(study, *start) : json(nullptr);
  record["start_score"] = plan.start.detail.valid ? number(plan.start.score) : json(nullptr);
  record["finals"] = finals_json(plan);
  record.update(end_json(run));
  if (const auto troubles = run.troubles(); !troubles.empty()) record["troubles"] = troubles;
  if (plan.finished && study.keys.algorithm == "model") record["model"] = model_of(run);
  record["performance"] = performance_json(run);
  return record;
}

std::string best_toml(StudyRun& run) {
  const Plan& plan = run.plan();
  if (!plan.best) return {};
  const Study& study = run.study();
  const json plateau = plateau_json(plan);
  std::string text = fmt::format("# Best design of {} ({}, {} evaluations): {}\n", study.file.filename().string(),
                                 study.keys.algorithm, run.answers().size(), plan.best->label);
  text += fmt::format(
      "# search score {:.6g}; plateau {} {} (mean of {} runs{})\n", plan.best_score.value,
      io::quantity(plateau.at("mean").is_null() ? NAN : plateau.at("mean").get<double>(), io::Dimension::stress),
      window_text(study.start->design().measures), plateau.at("count").get<int>(),
      plateau.at("seeds") == "fresh" ? ", on fresh seeds" : "");
  if (const auto verdict = verdict_of(run)) text += "# " + verdict->text + "\n";
  const Finals& finals = plan.finals;
  if (finals.pairs > 1)
    text +=
        fmt::format("# On {} fresh seeds the score gained {:.4g} +- {:.2g} (95 %) over the start: {}\n", finals.pairs,
                    finals.gain, finals.gain_interval, finals.significant ? "a gain" : "it may be chance");
  return text + design_of(study, *plan.best).schema().to_toml();
}

std::string evaluations_csv(StudyRun& run) {
  const Study& study = run.study();
  std::string text = "stage,arm,number";
  for (const Variable& variable : study.variables) text += "," + variable.key;
  text += ",status,violation,score,wishes_not_kept,plateau_mean,plateau_std,undulation,first_peak_stress";
  const auto recorded = results::recorded_measures(study.target);
  for (const std::size_t k : further_columns(study)) text += std::string(",") + recorded[k]->key;
  text += ",replicates,failed\n";
  if (run.plan().start.candidate) text += csv_line(study, "start", "start", 0, run.plan().start);
  for (const Trace& trace : run.plan().traces)
    for (std::size_t k = 0; k < trace.visits.size(); ++k)
      text += csv_line(study, trace.refine ? "refine" : "search", study.arms[static_cast<std::size_t>(trace.arm)].name,
                       k + 1, trace.visits[k]);
  if (const auto best = best_beside_search(run.plan()))
    text += csv_line(study, "map", study.arms[static_cast<std::size_t>(best->candidate->arm)].name, 0, *best);
  return text;
}

void write_results(StudyRun& run) {
  const auto& folder = run.options().folder;
  const std::string best = best_toml(run);
  if (!best.empty()) io::write_file(folder / "best.toml", best);
  io::write_file(folder / "evaluations.csv", evaluations_csv(run));
  io::write_file(folder / "candidates.csv", candidates_csv(run));
  if (const auto map = run.map(); map && !map->designs.empty()) write_map(*map, folder);
  io::write_file(folder / "study.json", to_json(study_record(run)).dump() + "\n");
  io::write_file(folder / "result.json", to_json(run).dump(2) + "\n");
}

Evaluation evaluate_best(const StudyRun& run, EvaluateOptions options) {
  DesignFile design = design_of(run.study(), *run.plan().best);
  design.set_title("best design of " + run.study().title);
  options.run_file = run.options().folder / "best.h5";
  options.resume = true;
  const bool there = std::filesystem::exists(options.run_file);
  // An earlier best, before maxeval was raised.
  if (there && !same_configuration(io::Hdf5Reader(options.run_file).text("/config"), design)) {
    for (const char* name : {"best.part", "best.csv", "best.xdmf", "best.xdmf.h5", "best.png"})
      std::filesystem::remove_all(run.options().folder / name);
    std::filesystem::remove(options.run_file);  // last: a kill before leaves what tells that they are to go
  }
  return evaluate_design(design, options, 0);
}

}  // namespace perfora::optimize
