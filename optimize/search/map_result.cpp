// What is here: maps put into records. What is not: the driver that asks for them.
#include "optimize/search/map_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/files.h"
#include "io/text.h"

namespace perfora::optimize {
namespace {

void add_results(const std::vector<const Evaluation*>& runs, results::MapDesign& design) {
  std::vector<const Evaluation*> completed;
  for (const Evaluation* run : runs) {
    if (run->status == results::RunStatus::completed) {
      completed.push_back(run);
      continue;
    }
    if (design.failed++ == 0) design.reason = run->reason;
  }
  design.completed = static_cast<int>(completed.size());
  if (completed.empty()) return;
  for (const results::Measure& measure : results::measures()) {
    std::vector<double> values;
    for (const Evaluation* run : completed) values.push_back(results::value_of(measure, *run));
    results::Statistic statistic = results::statistic_of(measure.key, values);
    if (statistic.count > 0 && std::isfinite(statistic.mean)) design.results[measure.key] = std::move(statistic);
  }
}

}  // namespace

results::MapRecord map_record(const Study& study, CandidateBook& book, const Answers& answers, const Plan& plan) {
  const CandidateStore store(study, book, answers);
  results::MapRecord record;
  record.title = study.title;
  record.fidelity = study.fidelities[study.map_fidelity].name;
  record.replicates = study.keys.map.replicates;
  record.tried = plan.map_tried;
  for (const Variable& variable : study.variables) record.variables.push_back(variable.key);
  const results::MeasureOptions& measures = study.start->design().measures;
  if (measures.plateau == results::PlateauPlace::window) record.window = {measures.plateau_start, measures.plateau_end};
  record.wishes = results::wishes(study.target);
  for (const Visit& visit : plan.map) {
    if (!visit.answered) continue;
    results::MapDesign& design = record.designs.emplace_back();
    design.number = static_cast<int>(record.designs.size());
    design.arm = study.arms[static_cast<std::size_t>(visit.candidate->arm)].name;
    design.label = visit.candidate->label;
    design.values = visit.candidate->values;
    auto runs = store.evaluations(*visit.candidate, 0, study.keys.map.replicates, study.map_fidelity);
    std::erase(runs, nullptr);
    add_results(runs, design);
  }
  return record;
}

void write_map(const results::MapRecord& record, const std::filesystem::path& folder) {
  io::write_file(folder / "map.csv", results::map_csv(record));
  io::write_file(folder / "map.json", to_json(record).dump() + "\n");
}

namespace {

/// By the score; nullptr where nothing is wished or usable.
const Visit* best_visit(const Study& study, const Plan& plan) {
  const Visit* best = nullptr;
  if (!results::is_given(study.target)) return best;
  for (const Visit& visit : plan.map)
    if (visit.answered && visit.detail.valid && (!best || visit.score < best->score)) best = &visit;
  return best;
}

}  // namespace

std::string standing_of_map(const Study& study, const Plan& plan) {
  const Visit* best = best_visit(study, plan);
  if (!best) return "map";
  return fmt::format("map, best so far: score {:.4g}{}, {}", best->score, wishes_text(best->detail),
                     best->candidate->label);
}

std::string best_of_map_text(const Study& study, const Plan& plan) {
  const Visit* best = best_visit(study, plan);
  if (!best) return {};
  const int seeds = best->detail.replicates;
  return fmt::format("best of the {} mapped designs: {}, plateau {}, score {:.4g} over {} seed{} that chose it",
                     plan.map.size(), best->candidate->label,
                     io::quantity(best->detail.plateau_mean, io::Dimension::stress), best->score, seeds,
                     seeds == 1 ? "" : "s");
}

}  // namespace perfora::optimize
