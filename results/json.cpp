// What is here: evaluations and their parts turned into JSON and back. What is not: files, requests
// (optimize/evaluate/request.cpp), records of studies and sweeps.
#include "results/json.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "results/formats.h"
#include "results/measure_table.h"
#include "results/provenance.h"

namespace perfora::results {

using nlohmann::json;

json number(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

namespace {

double number_from(const json& record, const char* key) {
  const auto it = record.find(key);
  if (it == record.end() || it->is_null()) return std::numeric_limits<double>::quiet_NaN();
  return it->get<double>();
}

json numbers(const std::vector<double>& values) {
  json array = json::array();
  for (const double value : values) array.push_back(number(value));
  return array;
}

std::vector<double> numbers_from(const json& array) {
  std::vector<double> values;
  values.reserve(array.size());
  for (const json& value : array)
    values.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>());
  return values;
}

RunStatus status_from(const std::string& name) {
  if (const auto status = status_called(name)) return *status;
  throw std::invalid_argument("unknown status \"" + name + "\"");
}

/// Sets what a measure's member holds from a record; functions have none.
struct Setter {
  const json& record;
  const char* key;
  PackSummary& pack;
  Summary& summary;
  void operator()(double PackSummary::*member) const { pack.*member = number_from(record, key); }
  void operator()(double Summary::*member) const { summary.*member = number_from(record, key); }
  void operator()(std::int64_t PackSummary::*member) const { pack.*member = record.value(key, std::int64_t{0}); }
  void operator()(std::int64_t Summary::*member) const { summary.*member = record.value(key, std::int64_t{0}); }
  void operator()(double (*)(const PackSummary&)) const {}
};

/// The measures of the packing, or those of the run.
json measures_json(bool of_packing, const PackSummary& pack, const Summary& summary) {
  struct Getter {
    const PackSummary& pack;
    const Summary& summary;
    json operator()(std::int64_t PackSummary::*member) const { return pack.*member; }
    json operator()(std::int64_t Summary::*member) const { return summary.*member; }
    json operator()(double PackSummary::*member) const { return number(pack.*member); }
    json operator()(double Summary::*member) const { return number(summary.*member); }
    json operator()(double (*function)(const PackSummary&)) const { return number(function(pack)); }
  };
  json record = json::object();
  for (const Measure& measure : measures())
    if (measure.of_packing() == of_packing) record[measure.key] = std::visit(Getter{pack, summary}, measure.member);
  return record;
}

void read_thinnest_wall(const json& record, geometry::ThinnestWall& thinnest) {
  const json& wall = record.at("thinnest_wall");
  thinnest.thickness = wall.is_null() ? std::numeric_limits<double>::infinity() : wall.get<double>();
  const json& pair = record.at("thinnest_wall_pair");
  if (pair.is_null()) return;
  thinnest.first = pair.at(0).get<int>();
  thinnest.second = pair.at(1).get<int>();
}

void read_measures(const json& record, PackSummary& pack, Summary& summary) {
  pack = pack_summary_from_json(record);
  for (const Measure& measure : measures())
    if (!measure.of_packing()) std::visit(Setter{record, measure.key, pack, summary}, measure.member);
  for (const json& peak : record.value("peaks", json::array()))
    summary.peaks.push_back({peak.at(0).get<double>(), peak.at(1).get<double>()});
  summary.measured = record.value("measured", "");
  const auto strain_in = [&](std::size_t k) {
    const json& window = record.at("plateau_window");
    return window.at(k).is_null() ? not_reached : window.at(k).get<double>();
  };
  summary.plateau_start = strain_in(0);
  summary.plateau_end = strain_in(1);
}

Performance performance_from(const json& record) {
  Performance performance;
  performance.seconds = number_from(record, "seconds");
  performance.steps_per_second = number_from(record, "steps_per_second");
  performance.ns_per_bond_step = number_from(record, "ns_per_bond_step");
  performance.threads = record.at("threads").get<int>();
  performance.simd = record.at("simd").is_null() ? std::string() : record.at("simd").get<std::string>();
  performance.peak_memory = number_from(record, "peak_memory");
  return performance;
}

}  // namespace

json record_head(const char* schema, RunStatus status, const std::string& reason, const EffectiveSeeds& seeds) {
  return {{"schema", schema},
          {"status", status_name(status)},
          {"reason", reason},
          {"seeds", to_json(seeds)},
          {"results_version", results_version}};
}

json to_json(const PackSummary& summary) {
  json record = measures_json(true, summary, {});
  const geometry::ThinnestWall& wall = summary.thinnest_wall;
  record["thinnest_wall_pair"] = wall.first < 0 ? json(nullptr) : json::array({wall.first, wall.second});
  return record;
}

json to_json(const Summary& summary) {
  json record = measures_json(false, {}, summary);
  json peaks = json::array();
  for (const CurvePeak& peak : summary.peaks) peaks.push_back({peak.strain, peak.stress});
  record["peaks"] = peaks;
  record["measured"] = summary.measured;
  record["plateau_window"] = {number(summary.plateau_start), number(summary.plateau_end)};
  return record;
}

json to_json(const Performance& performance) {
  // A packing has no steps: zero rates are "not reached".
  auto rate = [](double value) { return value > 0.0 ? number(value) : json(nullptr); };
  return {{"seconds", number(performance.seconds)},
          {"steps_per_second", rate(performance.steps_per_second)},
          {"ns_per_bond_step", rate(performance.ns_per_bond_step)},
          {"threads", performance.threads},
          {"simd", performance.simd.empty() ? json(nullptr) : json(performance.simd)},
          {"peak_memory", rate(performance.peak_memory)}};
}

json to_json(const EffectiveSeeds& seeds) {
  return {{"packing", seeds.packing}, {"noise", seeds.noise}, {"layout", seeds.layout}, {"search", seeds.search}};
}

json to_json(const Evaluation& evaluation, bool with_curve) {
  json record = record_head(evaluation_schema, evaluation.status, evaluation.reason, evaluation.seeds);
  record["replicate"] = evaluation.replicate;
  record["grade"] = number(evaluation.grade);
  record.update(to_json(evaluation.pack));
  record.update(to_json(evaluation.summary));
  record["performance"] = to_json(evaluation.performance);
  if (with_curve) {
    json curve = json::object();
    for (const History::Column& column : History::columns()) {
      const std::vector<double>& values = evaluation.curve.*column.values;
      const bool always = column.values == &History::strain_yy || column.values == &History::stress_yy;
      if (always || !values.empty()) curve[column.name] = numbers(values);
    }
    record["curve"] = curve;
  }
  return record;
}

Evaluation evaluation_from_json(const json& record) {
  Evaluation evaluation;
  evaluation.status = status_from(record.at("status").get<std::string>());
  evaluation.reason = record.at("reason").get<std::string>();
  const json& seeds = record.at("seeds");
  evaluation.seeds.packing = seeds.at("packing").get<std::uint64_t>();
  evaluation.seeds.noise = seeds.at("noise").get<std::uint64_t>();
  evaluation.seeds.layout = seeds.at("layout").get<std::uint64_t>();
  evaluation.seeds.search = seeds.at("search").get<std::uint64_t>();
  evaluation.replicate = record.at("replicate").get<int>();
  evaluation.grade = record.value("grade", 1.0);
  read_measures(record, evaluation.pack, evaluation.summary);
  evaluation.summary.status = evaluation.status;
  evaluation.summary.reason = evaluation.reason;
  evaluation.performance = performance_from(record.at("performance"));
  if (const auto curve = record.find("curve"); curve != record.end())
    for (const History::Column& column : History::columns())
      if (const auto values = curve->find(column.name); values != curve->end())
        evaluation.curve.*column.values = numbers_from(*values);
  return evaluation;
}

PackSummary pack_summary_from_json(const json& record) {
  PackSummary pack;
  Summary none;
  for (const Measure& measure : measures())
    if (measure.of_packing()) std::visit(Setter{record, measure.key, pack, none}, measure.member);
  read_thinnest_wall(record, pack.thinnest_wall);
  return pack;
}

}  // namespace perfora::results
