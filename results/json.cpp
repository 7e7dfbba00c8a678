// What is here: evaluations and their parts turned into JSON and back. What is not: files, requests
// (optimize/evaluate/request.cpp), records of studies and sweeps.
#include "results/json.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "results/formats.h"
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

struct SummaryNumber {
  const char* name;
  double Summary::*value;
};
/// Real results; null where not reached.
constexpr SummaryNumber summary_numbers[] = {
    {"time_step", &Summary::time_step},
    {"rate", &Summary::rate},
    {"smallest_rate", &Summary::smallest_rate},
    {"largest_rate", &Summary::largest_rate},
    {"final_strain", &Summary::final_strain},
    {"first_peak_stress", &Summary::first_peak_stress},
    {"first_peak_strain", &Summary::first_peak_strain},
    {"stress_drop_ratio", &Summary::stress_drop_ratio},
    {"plateau_stress", &Summary::plateau_stress},
    {"minimum_stress_in_window", &Summary::minimum_stress_in_window},
    {"undulation", &Summary::undulation},
    {"densification_strain", &Summary::densification_strain},
    {"efficiency_strain", &Summary::efficiency_strain},
    {"only_rising_strain", &Summary::only_rising_strain},
    {"recovery_strain", &Summary::recovery_strain},
    {"intermediate_peaks", &Summary::intermediate_peaks},
    {"energy_absorbed", &Summary::energy_absorbed},
    {"cundall_share", &Summary::cundall_share},
    {"largest_fragment_fraction", &Summary::largest_fragment_fraction},
    {"max_overlap_in_run", &Summary::max_overlap_in_run},
    {"energy_residual", &Summary::energy_residual},
    {"stress_asymmetry", &Summary::stress_asymmetry},
    {"transits_before_peak", &Summary::transits_before_peak},
    {"kinetic_ratio_at_peak", &Summary::kinetic_ratio_at_peak},
    {"step_margin", &Summary::step_margin},
    {"noise_mean", &Summary::noise_mean},
    {"noise_std", &Summary::noise_std},
    {"noise_min", &Summary::noise_min},
    {"noise_max", &Summary::noise_max},
};

struct SummaryCount {
  const char* name;
  std::int64_t Summary::*value;
};
constexpr SummaryCount summary_counts[] = {
    {"steps", &Summary::steps},
    {"broken_bonds", &Summary::broken_bonds},
    {"broken_in_tension", &Summary::broken_in_tension},
    {"broken_in_shear", &Summary::broken_in_shear},
    {"fragments", &Summary::fragments},
};

struct PackNumber {
  const char* name;
  double PackSummary::*value;
};
constexpr PackNumber pack_numbers[] = {
    {"mean_diameter", &PackSummary::mean_diameter},
    {"solid_fraction", &PackSummary::solid_fraction},
    {"porosity", &PackSummary::porosity},
    {"bonds_per_disc", &PackSummary::bonds_per_disc},
    {"thinnest_wall_discretised", &PackSummary::thinnest_wall_discretised},
    {"max_overlap_ratio", &PackSummary::max_overlap_ratio},
    {"coordination_number", &PackSummary::coordination_number},
    {"rattler_fraction", &PackSummary::rattler_fraction},
};

PackSummary pack_from(const json& record) {
  PackSummary pack;
  pack.discs = record.at("discs").get<std::int64_t>();
  pack.perforations = record.at("perforations").get<std::int64_t>();
  for (const PackNumber& entry : pack_numbers) pack.*entry.value = number_from(record, entry.name);
  const json& wall = record.at("thinnest_wall");
  pack.thinnest_wall.thickness = wall.is_null() ? std::numeric_limits<double>::infinity() : wall.get<double>();
  const json& pair = record.at("thinnest_wall_pair");
  if (!pair.is_null()) {
    pack.thinnest_wall.first = pair.at(0).get<int>();
    pack.thinnest_wall.second = pair.at(1).get<int>();
  }
  return pack;
}

Summary summary_from(const json& record) {
  Summary summary;
  for (const SummaryNumber& entry : summary_numbers) summary.*entry.value = number_from(record, entry.name);
  for (const SummaryCount& entry : summary_counts) summary.*entry.value = record.at(entry.name).get<std::int64_t>();
  for (const json& peak : record.value("peaks", json::array()))
    summary.peaks.push_back({peak.at(0).get<double>(), peak.at(1).get<double>()});
  summary.plateau_start = record.at("plateau_window").at(0).get<double>();
  summary.plateau_end = record.at("plateau_window").at(1).get<double>();
  return summary;
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
  json record = {{"discs", summary.discs}, {"perforations", summary.perforations}};
  for (const PackNumber& entry : pack_numbers) record[entry.name] = number(summary.*entry.value);
  const geometry::ThinnestWall& wall = summary.thinnest_wall;
  record["thinnest_wall"] = number(wall.first < 0 ? std::numeric_limits<double>::infinity() : wall.thickness);
  record["thinnest_wall_pair"] = wall.first < 0 ? json(nullptr) : json::array({wall.first, wall.second});
  return record;
}

json to_json(const Summary& summary) {
  json record = json::object();
  for (const SummaryNumber& entry : summary_numbers) record[entry.name] = number(summary.*entry.value);
  for (const SummaryCount& entry : summary_counts) record[entry.name] = summary.*entry.value;
  json peaks = json::array();
  for (const CurvePeak& peak : summary.peaks) peaks.push_back({peak.strain, peak.stress});
  record["peaks"] = peaks;
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
  record.update(to_json(evaluation.pack));
  record.update(to_json(evaluation.summary));
  record["performance"] = to_json(evaluation.performance);
  if (with_curve)
    record["curve"] = {{"strain_yy", numbers(evaluation.curve.strain_yy)},
                       {"stress_yy", numbers(evaluation.curve.stress_yy)}};
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
  evaluation.pack = pack_from(record);
  evaluation.summary = summary_from(record);
  evaluation.summary.status = evaluation.status;
  evaluation.summary.reason = evaluation.reason;
  evaluation.performance = performance_from(record.at("performance"));
  if (const auto curve = record.find("curve"); curve != record.end()) {
    evaluation.curve.strain_yy = numbers_from(curve->at("strain_yy"));
    evaluation.curve.stress_yy = numbers_from(curve->at("stress_yy"));
  }
  return evaluation;
}

}  // namespace perfora::results
