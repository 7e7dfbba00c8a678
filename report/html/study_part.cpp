// What is here: a study as facts: its candidates as a table, its curves, what failed, the layouts of the best. What is
// not: the search, other kinds of work (sweep_part.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/layout.h"
#include "io/csv.h"
#include "io/error.h"
#include "io/files.h"
#include "io/text.h"
#include "report/html/campaign_parts.h"
#include "report/html/layout_path.h"
#include "results/campaign_folder.h"
#include "results/json.h"
#include "results/measure_table.h"

namespace perfora::report {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// The candidates of evaluations.csv that were asked: what is shown of each, and how it ended.
struct Candidates {
  std::vector<std::string> variables, results;
  struct Row {
    int number = 0;  ///< 0: the start
    std::string arm, status;
    std::vector<double> values, results;
  };
  std::vector<Row> rows;
};

Candidates read_candidates(const fs::path& file) {
  Candidates candidates;
  if (!fs::exists(file)) return candidates;
  const io::TextTable table = io::read_text_table(file);
  const std::size_t stage = table.column("stage"), arm = table.column("arm"), first = table.column("number") + 1,
                    status = table.column("status");
  for (std::size_t k = first; k < status; ++k) candidates.variables.push_back(table.names[k]);
  for (std::size_t k = status + 1; k < table.names.size(); ++k) candidates.results.push_back(table.names[k]);
  int number = 0;
  for (const std::vector<std::string>& fields : table.rows) {
    if (fields[status] == "open") continue;
    Candidates::Row row;
    row.number = fields[stage] == "start" ? 0 : ++number;
    const std::string& of = fields[stage];
    row.arm = of == "start" ? of : fields[arm] + (of == "search" ? "" : " (" + of + ")");
    row.status = fields[status];
    for (std::size_t k = first; k < status; ++k) row.values.push_back(io::number_in(fields[k]));
    for (std::size_t k = status + 1; k < fields.size(); ++k) row.results.push_back(io::number_in(fields[k]));
    candidates.rows.push_back(std::move(row));
  }
  return candidates;
}

/// The measure that a column of evaluations.csv holds: "plateau_mean" is that of the plateau stress.
std::string measure_of(const std::string& column) {
  if (column == "plateau_mean" || column == "plateau_std") return "plateau_stress";
  return column;
}

double largest_of(const Candidates& candidates, bool result, std::size_t k) {
  double largest = 0.0;
  for (const Candidates::Row& row : candidates.rows)
    if (const double value = result ? row.results[k] : row.values[k]; std::isfinite(value))
      largest = std::max(largest, std::abs(value));
  return largest;
}

void add_candidates(const Candidates& candidates, json& facts) {
  json columns = json::array(), rows = json::array();
  for (std::size_t k = 0; k < candidates.variables.size(); ++k) {
    json column = column_facts(candidates.variables[k], largest_of(candidates, false, k));
    column["kind"] = "variable";
    columns.push_back(std::move(column));
  }
  for (std::size_t k = 0; k < candidates.results.size(); ++k) {
    json column = column_facts(measure_of(candidates.results[k]), largest_of(candidates, true, k));
    column["name"] = candidates.results[k];
    if (candidates.results[k] == "plateau_std") column["label"] = "scatter of the plateau stress";
    column["kind"] = candidates.results[k] == "score" ? "score" : "result";
    columns.push_back(std::move(column));
  }
  for (const Candidates::Row& row : candidates.rows) {
    json values = json::array();
    for (const double value : row.values) values.push_back(results::number(value));
    for (const double value : row.results) values.push_back(results::number(value));
    rows.push_back({{"number", row.number}, {"arm", row.arm}, {"status", row.status}, {"values", values}});
  }
  facts["columns"] = columns;
  facts["rows"] = rows;
}

/// An evaluation of the journal: its design and what became of it.
struct Evaluated {
  std::string label, design, status, reason;
  int replicate = 0;
  std::uint64_t layout_seed = 0;
};

std::vector<Evaluated> evaluated_in(const fs::path& folder) {
  std::vector<Evaluated> list;
  for (const json& event : results::journal_events(folder)) {
    const auto evaluation = event.find("evaluation"), request = event.find("request");
    if (evaluation == event.end() || !evaluation->is_object()) continue;
    Evaluated one;
    one.label = event.value("candidate", "");
    one.status = evaluation->value("status", "");
    one.reason = evaluation->value("reason", "");
    one.replicate = evaluation->value("replicate", 0);
    if (request != event.end() && request->is_object()) one.design = request->value("design", "");
    if (const auto seeds = evaluation->find("seeds"); seeds != evaluation->end() && seeds->is_object())
      one.layout_seed = seeds->value("layout", std::uint64_t{0});
    list.push_back(std::move(one));
  }
  return list;
}

/// Whether a configuration has the values of a candidate: its variables, and the choices "key=value" of its arm.
bool is_of(const Configured& keys, const Candidates& candidates, const Candidates::Row& row) {
  constexpr double equal = 1e-9;
  for (std::size_t k = 0; k < candidates.variables.size(); ++k) {
    const auto value = keys.number(candidates.variables[k]);
    if (!value || !(std::abs(*value - row.values[k]) <= equal * std::max(1e-12, std::abs(row.values[k])))) return false;
  }
  for (std::size_t at = 0; at < row.arm.size();) {
    const std::size_t end = std::min(row.arm.find(", ", at), row.arm.size()), equals = row.arm.find('=', at);
    if (equals < end) {
      const std::string wanted = row.arm.substr(equals + 1, row.arm.find(' ', equals) - equals - 1);
      const std::string text = keys.text("layout." + row.arm.substr(at, equals - at));
      if (!text.empty() && text != wanted.substr(0, wanted.find(','))) return false;
    }
    at = end == row.arm.size() ? end : end + 2;
  }
  return true;
}

/// The layouts of the candidates with the smallest scores.
json thumbnails(const Candidates& candidates, const std::vector<Evaluated>& evaluated) {
  constexpr std::size_t most = 6;
  const auto score = std::find(candidates.results.begin(), candidates.results.end(), "score");
  if (score == candidates.results.end()) return json::array();
  const auto at = static_cast<std::size_t>(score - candidates.results.begin());
  std::vector<const Candidates::Row*> order;
  for (const Candidates::Row& row : candidates.rows)
    if (row.status == "completed" && std::isfinite(row.results[at])) order.push_back(&row);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return a->results[at] < b->results[at]; });
  std::vector<std::pair<Configured, const Evaluated*>> designs;
  for (const Evaluated& one : evaluated)
    if (one.replicate == 0) designs.emplace_back(Configured(one.design), &one);
  json list = json::array();
  for (const Candidates::Row* row : order) {
    if (list.size() == most) break;
    const auto found = std::find_if(designs.begin(), designs.end(),
                                    [&](const auto& design) { return is_of(design.first, candidates, *row); });
    if (found == designs.end()) continue;
    const auto layout = layout_of(found->second->design, found->second->layout_seed);
    if (!layout) continue;
    list.push_back({{"number", row->number},
                    {"arm", row->arm},
                    {"score", io::number(row->results[at])},
                    {"layout", layout_facts(*layout)}});
  }
  return list;
}

json failed_facts(const Candidates& candidates, const std::vector<Evaluated>& evaluated) {
  json list = json::array();
  for (const Candidates::Row& row : candidates.rows)
    if (row.status != "completed" && row.status != "failed")
      list.push_back({{"what", fmt::format("{} {}", row.arm, row.number)}, {"reason", row.status}});
  for (const Evaluated& one : evaluated)
    if (one.status == "failed")
      list.push_back({{"what", fmt::format("{}, replicate {}", one.label, one.replicate)}, {"reason", one.reason}});
  return list;
}

json wish_facts(const results::StudyRecord& record) {
  const auto or_null = [](const std::optional<double>& value) { return value ? json(*value) : json(); };
  json wish = {{"target", or_null(record.target)},
               {"tolerance", or_null(record.target_tolerance)},
               {"window", {or_null(record.window_start), or_null(record.window_end)}}};
  if (!record.target_curve.strain.empty())
    wish["curve"] = curve_facts(std::span<const results::Curve>(&record.target_curve, 1)).front();
  return wish;
}

}  // namespace

json result_of(const fs::path& folder) {
  for (const char* name : {"result.json", "ensemble.json"}) {
    if (!fs::exists(folder / name)) continue;
    json result = json::parse(io::read_file(folder / name), nullptr, false);
    if (result.is_object()) return result;
  }
  return nullptr;
}

json column_facts(const std::string& name, double largest) {
  const results::Measure* measure = results::measure_called(name);
  io::Dimension dimension = measure ? measure->dimension : io::Dimension::none;
  if (!measure) {
    geometry::LayoutOptions options;
    io::Schema schema;
    geometry::describe(schema, options);
    if (const io::Key* key = schema.find(name.substr(0, name.find('[')))) dimension = key->dimension;
  }
  const io::PrintUnit unit = io::unit_for(largest, dimension);
  std::string label = measure ? measure->label : io::after_section(name);
  std::replace(label.begin(), label.end(), '_', ' ');
  label.erase(0, label.find_first_not_of(' '));
  return {{"name", name}, {"label", label}, {"scale", io::scale_of(unit)}, {"unit", unit.name}};
}

Part study_part(const results::StudyRecord& record, const fs::path& folder) {
  Part part;
  const json result = result_of(folder);
  const Candidates candidates = read_candidates(folder / "evaluations.csv");
  const std::vector<Evaluated> evaluated = evaluated_in(folder);
  part.facts = {{"title", record.title},
                {"block", record.subtitle},
                {"verdict", verdict_facts(result)},
                {"best_number", record.best_number},
                {"score_label", record.score_label},
                {"best", curve_facts(record.best)},
                {"start", curve_facts(record.start)},
                {"measured", curve_facts(record.measured)},
                {"wish", wish_facts(record)},
                {"thumbnails", thumbnails(candidates, evaluated)},
                {"failed", failed_facts(candidates, evaluated)}};
  if (result.is_object()) {
    part.facts["model"] = result.value("model", json());
    part.facts["finals"] = result.value("finals", json());
    part.facts["pareto"] = result.value("pareto", json());
    part.facts["status"] = result.value("status", "");
    part.facts["reason"] = result.value("reason", "");
  }
  json facts = json::array();
  for (const results::StudyRecord::Fact& fact : record.facts) facts.push_back({fact.name, fact.best, fact.start});
  part.facts["facts"] = facts;
  if (record.best_layout) part.facts["best_layout"] = layout_facts(*record.best_layout);
  if (record.start_layout) part.facts["start_layout"] = layout_facts(*record.start_layout);
  add_candidates(candidates, part.facts);
  return part;
}

}  // namespace perfora::report
