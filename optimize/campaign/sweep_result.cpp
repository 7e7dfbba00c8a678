// What is here: the result files of a sweep. What is not: its runs.
#include "optimize/campaign/sweep_result.h"

#include <fmt/format.h>

#include <cmath>

#include "io/csv.h"
#include "io/files.h"
#include "optimize/campaign/value_json.h"
#include "results/formats.h"
#include "results/target.h"
#include "results/wish_record.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

std::string field(double value) {
  return std::isfinite(value) ? fmt::format(",{:.12g}", value) : std::string(",");
}

json value_of(const DesignFile& design, const std::string& key) {
  return value_json(design.schema().find(key)->get());
}

std::string case_columns(const SweepRun& run, const SweepCase& one) {
  std::string line = fmt::format("{},{}", one.number, io::csv_quoted(one.label));
  const DesignFile design(*one.design);
  for (const std::string& key : run.sweep().columns) {
    const json value = value_of(design, key);
    line += ',';
    if (value.is_string())
      line += io::csv_quoted(value.get<std::string>());
    else if (!value.is_null())
      line += value.dump();
  }
  return line;
}

std::string head_columns(const SweepRun& run) {
  std::string line = "case,label";
  for (const std::string& key : run.sweep().columns) line += "," + key;
  return line;
}

json statistic_json(const results::Statistic& s) {
  return {{"mean", number(s.mean)},
          {"standard_deviation", number(s.standard_deviation)},
          {"confidence_95", number(s.confidence_95)},
          {"count", s.count}};
}

json statistics_json(const std::vector<results::Statistic>& statistics) {
  json object = json::object();
  for (const results::Statistic& s : statistics) object[s.name] = statistic_json(s);
  return object;
}

}  // namespace

CaseResult case_result(const SweepRun& run, const SweepCase& one) {
  CaseResult result;
  const bool compared = run.sweep().keys.base && one.number != 0;
  const std::size_t count = sweep_measures().size();
  std::vector<std::vector<double>> values(count), changes(count);  // by measure
  std::vector<const Evaluation*> judged;
  for (int replicate = 0; replicate < run.sweep().keys.replicates; ++replicate) {
    const Evaluation* evaluation = run.completed(one, replicate);
    result.failed += !evaluation && run.known(one, replicate);
    if (const Evaluation* known = run.known(one, replicate)) judged.push_back(known);
    if (!evaluation) continue;
    ++result.completed;
    const std::vector<double> reached = measures_of(*evaluation);
    for (std::size_t k = 0; k < count; ++k) values[k].push_back(reached[k]);
    const Evaluation* base = compared ? run.completed(run.sweep().cases.front(), replicate) : nullptr;
    if (!base) continue;
    const std::vector<double> of_base = measures_of(*base);
    for (std::size_t k = 0; k < count; ++k) changes[k].push_back(reached[k] - of_base[k]);
  }
  result.judgement = results::judgement_on(one.design->target, judged);
  for (std::size_t k = 0; k < count; ++k) {
    result.statistics.push_back(results::statistic_of(sweep_measures()[k], values[k]));
    if (compared) result.changes.push_back(results::statistic_of(sweep_measures()[k], changes[k]));
  }
  return result;
}

json to_json(const SweepRun& run) {
  json cases = json::array();
  for (const SweepCase& one : run.sweep().cases) {
    const CaseResult result = case_result(run, one);
    json settings = json::object();
    const DesignFile design(*one.design);
    for (const std::string& key : run.sweep().columns) settings[key] = value_of(design, key);
    json record = {{"case", one.number},
                   {"label", one.label},
                   {"settings", settings},
                   {"problem", one.problem.empty() ? json(nullptr) : json(one.problem)},
                   {"completed", result.completed},
                   {"failed", result.failed},
                   {"statistics", statistics_json(result.statistics)}};
    if (result.judgement) record.update(results::to_json(*result.judgement));
    if (!result.changes.empty()) record["changes"] = statistics_json(result.changes);
    cases.push_back(std::move(record));
  }
  const Design& start = run.sweep().start->design();
  json record = {
      {"schema", results::sweep_schema},
      {"status", results::status_name(run.status())},
      {"reason", run.reason()},
      {"seeds", to_json(start.seeds.effective(0))},
      {"results_version", results_version},
      {"replicates", run.sweep().keys.replicates},
      {"runs", run.sweep().runs()},
      {"left_out", run.sweep().left_out},
      {"measures", run.sweep().measures},
      {"plateau_window", window_json(results::with_window_of(start.target, start.measures))},
      {"cases", cases},
      {"performance",
       {{"seconds", run.seconds()}, {"simulated_seconds", run.simulated_seconds()}, {"retries", run.retries()}}}};
  if (const auto wishes = results::wishes(start.target); !wishes.empty()) record["wishes"] = results::to_json(wishes);
  if (const auto troubles = run.troubles(); !troubles.empty()) record["troubles"] = troubles;
  return record;
}

std::string cases_csv(const SweepRun& run) {
  const bool compared = run.sweep().keys.base, wished = !results::wishes(run.sweep().start->design().target).empty();
  std::string text = head_columns(run) + ",completed,failed,problem" + (wished ? ",outcome" : "");
  for (const std::string& name : sweep_measures()) {
    text += fmt::format(",{0},{0}_std,{0}_ci95", name);
    if (compared) text += fmt::format(",{0}_change,{0}_change_ci95", name);
  }
  text += "\n";
  for (const SweepCase& one : run.sweep().cases) {
    const CaseResult result = case_result(run, one);
    text += case_columns(run, one) + fmt::format(",{},{},{}", result.completed, result.failed,
                                                 one.problem.empty() ? "" : io::csv_quoted(one.problem));
    if (wished)
      text += std::string(",") + (result.judgement ? results::outcome_name(result.judgement->verdict.outcome) : "");
    for (std::size_t k = 0; k < result.statistics.size(); ++k) {
      const results::Statistic& s = result.statistics[k];
      text += field(s.mean) + field(s.standard_deviation) + field(s.confidence_95);
      if (!compared) continue;
      text += result.changes.empty() ? ",," : field(result.changes[k].mean) + field(result.changes[k].confidence_95);
    }
    text += "\n";
  }
  return text;
}

std::string runs_csv(const SweepRun& run) {
  std::string text = head_columns(run) + ",replicate,status,packing_seed,noise_seed";
  for (const std::string& name : sweep_measures()) text += "," + name;
  text += ",seconds,simd,run_file\n";
  for (const SweepCase& one : run.sweep().cases)
    for (int replicate = 0; replicate < run.sweep().keys.replicates; ++replicate) {
      const Evaluation* evaluation = run.known(one, replicate);
      if (!evaluation) continue;
      text += case_columns(run, one) + fmt::format(",{},{},{},{}", replicate, results::status_name(evaluation->status),
                                                   evaluation->seeds.packing, evaluation->seeds.noise);
      for (const double value : measures_of(*evaluation)) text += field(value);
      text += field(evaluation->performance.seconds) + "," + evaluation->performance.simd + ",";
      const auto file = EvaluationQueue::run_file(one.request(replicate));
      if (std::filesystem::exists(run.options().folder / file)) text += file.string();
      text += "\n";
    }
  return text;
}

std::string curves_csv(const SweepRun& run) {
  std::string text = "case,replicate,strain_yy,stress_yy\n";
  for (const SweepCase& one : run.sweep().cases)
    for (int replicate = 0; replicate < run.sweep().keys.replicates; ++replicate) {
      const Evaluation* evaluation = run.completed(one, replicate);
      if (!evaluation) continue;
      const results::History& curve = evaluation->curve;
      for (std::size_t k = 0; k < curve.rows(); ++k)
        text += fmt::format("{},{},{:.6g},{:.6g}\n", one.number, replicate, curve.strain_yy[k], curve.stress_yy[k]);
    }
  return text;
}

void write_results(const SweepRun& run) {
  const auto& folder = run.options().folder;
  io::write_file(folder / "cases.csv", cases_csv(run));
  io::write_file(folder / "runs.csv", runs_csv(run));
  io::write_file(folder / "curves.csv", curves_csv(run));
  io::write_file(folder / "result.json", to_json(run).dump(2) + "\n");
}

}  // namespace perfora::optimize
