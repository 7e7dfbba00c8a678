// What is here: sweeps and ensembles from result.json, their tables and journals. What is not: where a picture puts a
// case (sweep_places.cpp).
#include "results/sweep_record.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/csv.h"
#include "io/error.h"
#include "io/files.h"
#include "results/campaign_folder.h"
#include "results/formats.h"
#include "results/record_reading.h"
#include "results/statistic.h"
#include "results/sweep_places.h"
#include "results/wish_record.h"

namespace perfora::results {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

double number_or_nan(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : missing;
}

std::string name_of(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

/// SweepRecord::judged of what has them.
json judged_in(const json& object) {
  json judged = json::object();
  for (const char* key : {"verdict", "single_blocks"})
    if (const auto found = object.find(key); found != object.end()) judged[key] = *found;
  return judged;
}

SweepCase* case_numbered(SweepRecord& record, const std::string& number) {
  for (SweepCase& one : record.cases)
    if (std::to_string(one.number) == number) return &one;
  return nullptr;
}

SweepRecord from_object(const json& object, const fs::path& file) {
  SweepRecord record;
  record.folder = fs::absolute(file).parent_path();
  record.name = name_of(record.folder);
  record.title = campaign_title(record.folder);
  record.reason = object.value("reason", "");
  record.replicates = object.value("replicates", 0);
  // Older files do not say which: the two that every sweep is made for.
  record.measures = object.value("measures", std::vector<std::string>{"first_peak_stress", "plateau_stress"});
  if (const json window = object.value("plateau_window", json()); window.is_array())
    record.plateau_window = window.get<std::vector<double>>();
  record.wishes = wishes_from_json(object.value("wishes", json::array()));
  std::vector<std::string> columns;
  for (const json& one : object.at("cases")) {
    SweepCase& added = record.cases.emplace_back();
    added.number = one.value("case", 0);
    added.label = one.value("label", "");
    added.can_run = one.value("problem", json()).is_null();
    added.completed = one.value("completed", 0);
    for (const auto& [name, statistic] : one.at("statistics").items())
      added.results[name] = {number_or_nan(statistic, "mean"), number_or_nan(statistic, "confidence_95")};
    if (object.at("cases").size() == 1) record.judged = judged_in(one);
    if (!columns.empty() || !one.contains("settings")) continue;
    for (const auto& setting : one.at("settings").items()) columns.push_back(setting.key());
  }
  place_cases(record, columns);
  return record;
}

}  // namespace

SweepRecord read_sweep_record(const fs::path& path) {
  const fs::path file = fs::is_directory(path) ? path / "result.json" : path;
  const char* remedy = "give the folder of a `perfora sweep`";
  const auto refuse = [&](const std::string& problem) {
    return io::InputError({file.string(), 0, ""}, problem, "", remedy);
  };
  if (!fs::exists(path)) throw refuse("there is no such file or folder");
  if (!fs::exists(file))
    throw refuse("this folder holds no result of a sweep (a sweep writes it when it ends or is stopped)");
  const json object = json::parse(io::read_file(file), nullptr, false);
  if (!object.is_object() || !object.contains("schema") || object.at("schema") != sweep_schema ||
      !object.contains("cases"))
    throw refuse("this is not the result of a sweep");
  return read_from(file, 0, remedy, [&] { return from_object(object, file); });
}

void read_sweep_runs(SweepRecord& record) {
  const io::TextTable runs = io::read_text_table(record.folder / "runs.csv");
  const std::size_t number = runs.column("case"), replicate = runs.column("replicate"), status = runs.column("status"),
                    file = runs.column("run_file");
  for (const std::vector<std::string>& row : runs.rows) {
    SweepCase* one = case_numbered(record, row[number]);
    if (!one) continue;
    CaseRun& run = one->runs.emplace_back();
    run.replicate = static_cast<int>(io::number_in(row[replicate]));
    run.completed = row[status] == "completed";
    if (!row[file].empty()) run.run_file = record.folder / row[file];
    for (std::size_t k = status + 1; k < row.size(); ++k) run.results[runs.names[k]] = io::number_in(row[k]);
  }
  const io::TextTable points = io::read_text_table(record.folder / "curves.csv");
  const std::size_t of = points.column("case"), among = points.column("replicate"), strain = points.column("strain_yy"),
                    stress = points.column("stress_yy");
  SweepCase* one = nullptr;
  for (const std::vector<std::string>& row : points.rows) {
    if (!one || std::to_string(one->number) != row[of]) one = case_numbered(record, row[of]);
    if (!one) continue;
    for (CaseRun& run : one->runs) {
      if (std::to_string(run.replicate) != row[among]) continue;
      run.curve.strain.push_back(io::number_in(row[strain]));
      run.curve.stress.push_back(io::number_in(row[stress]));
    }
  }
}

namespace {

SweepRecord ensemble_in(const fs::path& folder) {
  SweepRecord record;
  record.folder = folder;
  record.name = record.title = name_of(folder);
  record.measures = {"first_peak_stress", "plateau_stress", "densification_strain"};
  SweepCase& only = record.cases.emplace_back();
  only.number = 1;
  only.label = only.place = record.name;
  if (fs::exists(folder / "ensemble.json")) {
    const json result = json::parse(io::read_file(folder / "ensemble.json"), nullptr, false);
    if (result.is_object()) record.judged = judged_in(result);
  }
  std::map<int, json> evaluations;  // by replicate
  for (const json& event : journal_events(folder))
    if (event.contains("evaluation")) {
      evaluations[event.at("evaluation").value("replicate", 0)] = event.at("evaluation");
      if (event.contains("request")) record.design = event.at("request").value("design", "");
    }
  if (evaluations.empty())
    throw io::InputError({folder.string(), 0, ""}, "no replicate of an ensemble is finished here", "",
                         "give the folder of a `perfora evaluate --replicates`");
  std::map<std::string, std::vector<double>> values;
  for (const auto& [replicate, evaluation] : evaluations) {
    if (evaluation.value("status", "") != "completed") continue;
    CaseRun& run = only.runs.emplace_back();
    run.replicate = replicate;
    run.completed = true;
    for (const auto& [name, value] : evaluation.items())
      if (value.is_number() || value.is_null()) {
        run.results[name] = value.is_number() ? value.get<double>() : missing;
        values[name].push_back(run.results[name]);
      }
    const json curve = evaluation.value("curve", json::object());
    run.curve = {curve.value("strain_yy", std::vector<double>()), curve.value("stress_yy", std::vector<double>())};
  }
  only.completed = static_cast<int>(only.runs.size());
  for (const auto& [name, list] : values) {
    const Statistic statistic = statistic_of(name, list);
    only.results[name] = {statistic.mean, statistic.confidence_95};
  }
  record.replicates = static_cast<int>(evaluations.size());
  record.reason = fmt::format("{} of {} replicates completed", only.completed, record.replicates);
  if (fs::exists(folder / "ensemble.json")) {
    const json result = json::parse(io::read_file(folder / "ensemble.json"), nullptr, false);
    if (result.is_object()) {
      record.replicates = result.value("replicates", record.replicates);
      record.reason = result.value("reason", record.reason);
    }
  }
  return record;
}

}  // namespace

SweepRecord read_ensemble_record(const fs::path& folder) {
  return read_from(folder / "journal.jsonl", 0, "give the folder of a `perfora evaluate --replicates`",
                   [&] { return ensemble_in(folder); });
}

}  // namespace perfora::results
