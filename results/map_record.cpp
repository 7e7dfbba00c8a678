// What is here: records of maps to and from their files, and what they say of wishes. What is not: how they are filled
// (optimize/search/map_result.cpp).
#include "results/map_record.h"

#include <fmt/format.h>

#include <cmath>

#include "io/csv.h"
#include "io/files.h"
#include "io/text.h"
#include "results/formats.h"
#include "results/json.h"
#include "results/record_reading.h"
#include "results/wish_record.h"

namespace perfora::results {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

double number_in(const json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? not_reached : found->get<double>();
}

MapRecord record_from_json(const json& object) {
  if (object.at("schema") != map_schema) throw std::invalid_argument("another schema");
  MapRecord record;
  record.title = object.at("title").get<std::string>();
  record.fidelity = object.at("fidelity").get<std::string>();
  record.replicates = object.at("replicates").get<int>();
  record.tried = object.at("tried").get<int>();
  record.variables = object.at("variables").get<std::vector<std::string>>();
  record.window = object.at("window").get<std::vector<double>>();
  record.wishes = wishes_from_json(object.at("wishes"));
  for (const json& one : object.at("designs")) {
    MapDesign& design = record.designs.emplace_back();
    design.number = one.at("number").get<int>();
    design.arm = one.at("arm").get<std::string>();
    design.label = one.at("label").get<std::string>();
    design.values = one.at("values").get<std::vector<double>>();
    design.completed = one.at("completed").get<int>();
    design.failed = one.at("failed").get<int>();
    design.reason = one.at("reason").get<std::string>();
    for (const auto& [key, of] : one.at("results").items()) {
      Statistic& statistic = design.results[key];
      statistic.name = key;
      statistic.count = of.at("count").get<int>();
      statistic.mean = number_in(of, "mean");
      statistic.standard_deviation = number_in(of, "standard_deviation");
      statistic.confidence_95 = number_in(of, "confidence_95");
      statistic.minimum = number_in(of, "minimum");
      statistic.maximum = number_in(of, "maximum");
    }
  }
  return record;
}

}  // namespace

json to_json(const MapRecord& record) {
  json designs = json::array();
  for (const MapDesign& one : record.designs) {
    json results = json::object();
    for (const auto& [key, of] : one.results)
      results[key] = {{"count", of.count},
                      {"mean", number(of.mean)},
                      {"standard_deviation", number(of.standard_deviation)},
                      {"confidence_95", number(of.confidence_95)},
                      {"minimum", number(of.minimum)},
                      {"maximum", number(of.maximum)}};
    designs.push_back({{"number", one.number},
                       {"arm", one.arm},
                       {"label", one.label},
                       {"values", one.values},
                       {"completed", one.completed},
                       {"failed", one.failed},
                       {"reason", one.reason},
                       {"results", results}});
  }
  return {{"schema", map_schema},
          {"status", "completed"},
          {"reason", ""},
          {"title", record.title},
          {"fidelity", record.fidelity},
          {"replicates", record.replicates},
          {"tried", record.tried},
          {"variables", record.variables},
          {"window", record.window},
          {"wishes", to_json(record.wishes)},
          {"out_of_reach", out_of_reach(record)},
          {"designs", designs}};
}

std::string map_csv(const MapRecord& record) {
  std::string text = "number,arm";
  for (const std::string& key : record.variables) text += "," + key;
  text += ",completed,failed";
  for (const Measure& measure : measures()) text += fmt::format(",{0},{0}_std", measure.key);
  text += ",reason\n";
  const auto add = [&](double value) { text += std::isfinite(value) ? fmt::format(",{}", value) : ","; };
  for (const MapDesign& one : record.designs) {
    text += fmt::format("{},{}", one.number, io::csv_quoted(one.arm));
    for (const double value : one.values) add(value);
    text += fmt::format(",{},{}", one.completed, one.failed);
    for (const Measure& measure : measures()) {
      const auto found = one.results.find(measure.key);
      add(found == one.results.end() ? not_reached : found->second.mean);
      add(found == one.results.end() ? not_reached : found->second.standard_deviation);
    }
    text += fmt::format(",{}\n", io::csv_quoted(one.reason));
  }
  return text;
}

MapRecord read_map_record(const fs::path& folder) {
  const fs::path file = folder / "map.json";
  return read_from(file, 0, "continue the map with --resume: it writes the file anew",
                   [&] { return record_from_json(json::parse(io::read_file(file))); });
}

SweepRecord as_sweep(const MapRecord& record, const fs::path& folder) {
  SweepRecord sweep;
  sweep.folder = folder;
  const fs::path whole = fs::absolute(folder).lexically_normal();
  sweep.name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  sweep.title = record.title;
  sweep.replicates = record.replicates;
  sweep.plateau_window = record.window;
  for (const MapDesign& one : record.designs) {
    SweepCase& made = sweep.cases.emplace_back();
    made.number = one.number;
    made.label = one.label;
    made.completed = one.completed;
    for (const auto& [key, of] : one.results) made.results[key] = {of.mean, of.confidence_95};
  }
  return sweep;
}

MappedRange mapped_range(const MapRecord& record, const Measure& measure) {
  MappedRange range;
  for (const MapDesign& one : record.designs) {
    const auto found = one.results.find(measure.key);
    if (found == one.results.end() || !std::isfinite(found->second.mean)) continue;
    const double mean = found->second.mean;
    range.low = range.designs == 0 ? mean : std::min(range.low, mean);
    range.high = range.designs == 0 ? mean : std::max(range.high, mean);
    ++range.designs;
  }
  return range;
}

std::vector<std::string> out_of_reach(const MapRecord& record) {
  std::vector<std::string> sentences;
  for (const Wish& wish : record.wishes) {
    const MappedRange range = mapped_range(record, *wish.measure);
    if (range.designs == 0 || (range.high >= wish.low && range.low <= wish.high)) continue;
    sentences.push_back(fmt::format(
        "out of the reachable range: {} wished {}, {} mapped with {} designs", name_of(*wish.measure), range_text(wish),
        io::quantities({range.low, range.high}, wish.measure->dimension, " to "), range.designs));
  }
  return sentences;
}

}  // namespace perfora::results
