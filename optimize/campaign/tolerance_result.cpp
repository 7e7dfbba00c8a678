// What is here: verdicts and paired changes of a tolerance analysis. What is not: its blocks.
#include "optimize/campaign/tolerance_result.h"

#include <fmt/format.h>

#include <cmath>

#include "io/csv.h"
#include "io/files.h"
#include "optimize/campaign/sweep_result.h"
#include "results/assurance.h"
#include "results/formats.h"
#include "results/verdict.h"
#include "results/wish_record.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

std::vector<const Evaluation*> blocks_of(const SweepRun& run, const SweepCase& one) {
  std::vector<const Evaluation*> blocks;
  for (int replicate = 0; replicate < run.sweep().keys.replicates; ++replicate)
    if (const Evaluation* known = run.known(one, replicate)) blocks.push_back(known);
  return blocks;
}

constexpr double last_digits = 1e-12;

/// Of a wish, block by block against the undisturbed block of the same seeds.
results::Statistic change_of(const SweepRun& run, const SweepCase& one, const results::Wish& wish) {
  std::vector<double> changes;
  for (int replicate = 0; replicate < run.sweep().keys.replicates; ++replicate) {
    const Evaluation* block = run.completed(one, replicate);
    const Evaluation* undisturbed = run.completed(run.sweep().cases.front(), replicate);
    if (!block || !undisturbed) continue;
    const double with = results::wished_value(*wish.measure, *block);
    const double without = results::wished_value(*wish.measure, *undisturbed);
    // Another grade leaves ratios of stresses as they are but for the last digits.
    const bool same = std::abs(with - without) <= last_digits * std::abs(without);
    changes.push_back(same ? 0.0 : with - without);
  }
  return results::statistic_of({}, changes);
}

json wish_json(const SweepRun& run, const SweepCase& one, const results::WishVerdict& verdict) {
  json record = results::to_json(verdict.wish);
  record.update({{"outcome", results::outcome_name(verdict.outcome)},
                 {"count", verdict.count},
                 {"mean", number(verdict.mean)},
                 {"interval", {number(verdict.interval.low), number(verdict.interval.high)}},
                 {"text", verdict.text}});
  if (one.number == 0) return record;
  const results::Statistic change = change_of(run, one, verdict.wish);
  record["change"] = {{"count", change.count},
                      {"mean", change.count > 0 ? number(change.mean) : json(nullptr)},
                      {"confidence_95", number(change.confidence_95)}};
  return record;
}

/// What is known of a case: outcome and wishes.
json judged(const SweepRun& run, const SweepCase& one) {
  const auto blocks = blocks_of(run, one);
  json record = {{"problem", one.problem.empty() ? json(nullptr) : json(one.problem)}, {"blocks", blocks.size()}};
  if (blocks.empty()) return record;
  const results::Verdict verdict = results::verdict_on(one.design->target, blocks);
  record["outcome"] = results::outcome_name(verdict.outcome);
  record["failed"] = verdict.failed;
  record["text"] = verdict.text;
  record["wishes"] = json::array();
  for (const results::WishVerdict& wish : verdict.wishes) record["wishes"].push_back(wish_json(run, one, wish));
  return record;
}

std::string csv_field(const json& value) {
  if (value.is_null()) return ",";
  if (value.is_string()) return fmt::format(",{}", io::csv_quoted(value.get<std::string>()));
  return fmt::format(",{:.12g}", value.get<double>());
}

void add_rows(std::string& text, const std::string& label, const json& record) {
  for (const json& wish : record.value("wishes", json::array())) {
    text += io::csv_quoted(label);
    for (const char* key : {"measure", "low", "high", "outcome", "count", "mean"}) text += csv_field(wish.at(key));
    for (const json& end : wish.at("interval")) text += csv_field(end);
    const json change = wish.value("change", json{{"mean", nullptr}, {"confidence_95", nullptr}});
    text += csv_field(change.at("mean")) + csv_field(change.at("confidence_95")) + "\n";
  }
}

}  // namespace

json to_json(const Tolerance& tolerance, const SweepRun& run) {
  const Sweep& sweep = run.sweep();
  json deviations = json::array();
  for (const ToleranceCase& one : tolerance.cases) {
    json record = {{"deviation", deviation_name(one.deviation)},
                   {"label", one.label},
                   {"amount", one.amount},
                   {"left_out", nullptr}};
    if (one.left_out.empty())
      record.update(judged(run, sweep.cases[static_cast<std::size_t>(one.number)]));
    else
      record["left_out"] = one.left_out;
    deviations.push_back(std::move(record));
  }
  json record = {
      {"schema", results::tolerance_schema},
      {"status", results::status_name(run.status())},
      {"reason", run.reason()},
      {"seeds", to_json(sweep.start->design().seeds.effective(0))},
      {"results_version", results_version},
      {"replicates", sweep.keys.replicates},
      {"undisturbed", judged(run, sweep.cases.front())},
      {"deviations", deviations},
      {"performance",
       {{"seconds", run.seconds()}, {"simulated_seconds", run.simulated_seconds()}, {"retries", run.retries()}}}};
  if (const auto troubles = run.troubles(); !troubles.empty()) record["troubles"] = troubles;
  return record;
}

std::string tolerance_csv(const json& record) {
  std::string text =
      "deviation,wish,range_low,range_high,outcome,blocks,mean,interval_low,interval_high,change,change_ci95\n";
  add_rows(text, "none", record.at("undisturbed"));
  for (const json& one : record.at("deviations")) add_rows(text, one.at("label").get<std::string>(), one);
  return text;
}

void write_results(const Tolerance& tolerance, const SweepRun& run) {
  const auto& folder = run.options().folder;
  const json record = to_json(tolerance, run);
  io::write_file(folder / "tolerance.csv", tolerance_csv(record));
  io::write_file(folder / "tolerance.json", record.dump(2) + "\n");
}

}  // namespace perfora::optimize
