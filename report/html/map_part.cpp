// What is here: a map as facts: its designs as a table, what they reach, what is wished. What is not: studies, which
// hold candidates (study_part.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text.h"
#include "report/html/campaign_parts.h"
#include "results/json.h"
#include "results/measure_table.h"
#include "results/wish_record.h"

namespace perfora::report {

using nlohmann::json;

namespace {

/// Measures of a design that are shown, beside those that are wished.
constexpr const char* shown_of_maps[] = {
    "plateau_stress",       "cap_ratio",           "undulation", "smallest_over_mean", "slope", "first_peak_stress",
    "found_plateau_length", "densification_onset", "porosity",   "thinnest_wall"};

std::vector<const results::Measure*> measures_of(const results::MapRecord& record) {
  std::vector<const results::Measure*> list;
  for (const char* key : shown_of_maps) list.push_back(results::measure_called(key));
  for (const results::Wish& wish : record.wishes)
    if (std::find(list.begin(), list.end(), wish.measure) == list.end()) list.push_back(wish.measure);
  std::erase_if(list,
                [&](const results::Measure* one) { return !one || results::mapped_range(record, *one).designs == 0; });
  return list;
}

json column_of(const std::string& name, const char* kind, double largest) {
  json column = column_facts(name, largest);
  column["kind"] = kind;
  return column;
}

}  // namespace

Part map_part(const results::MapRecord& record) {
  Part part;
  const std::vector<const results::Measure*> measures = measures_of(record);
  json columns = json::array(), rows = json::array(), failed = json::array(), ranges = json::array();
  for (std::size_t k = 0; k < record.variables.size(); ++k) {
    double largest = 0.0;
    for (const results::MapDesign& design : record.designs) largest = std::max(largest, std::abs(design.values[k]));
    columns.push_back(column_of(record.variables[k], "variable", largest));
  }
  for (const results::Measure* measure : measures) {
    const results::MappedRange range = results::mapped_range(record, *measure);
    json column = column_of(measure->key, "result", std::max(std::abs(range.low), std::abs(range.high)));
    column["label"] = results::name_of(*measure);
    columns.push_back(std::move(column));
    ranges.push_back({results::name_of(*measure), io::quantities({range.low, range.high}, measure->dimension, " to "),
                      range.designs});
  }
  for (const results::MapDesign& design : record.designs) {
    json values = json::array();
    for (const double value : design.values) values.push_back(results::number(value));
    for (const results::Measure* measure : measures) {
      const auto found = design.results.find(measure->key);
      values.push_back(found == design.results.end() ? json() : results::number(found->second.mean));
    }
    const char* status = design.completed > 0 ? "completed" : design.failed > 0 ? "failed" : "open";
    rows.push_back({{"number", design.number}, {"arm", design.arm}, {"status", status}, {"values", values}});
    if (design.failed > 0) failed.push_back({{"what", design.label}, {"reason", design.reason}});
  }
  part.facts = {{"title", record.title},
                {"block", fmt::format("{} designs, {} replicate{} each{}", record.designs.size(), record.replicates,
                                      record.replicates == 1 ? "" : "s",
                                      record.fidelity.empty() ? "" : ", fidelity " + record.fidelity)},
                {"columns", columns},
                {"rows", rows},
                {"failed", failed},
                {"ranges", ranges},
                {"wishes", results::to_json(record.wishes)},
                {"out_of_reach", results::out_of_reach(record)}};
  return part;
}

}  // namespace perfora::report
