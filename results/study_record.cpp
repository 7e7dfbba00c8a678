// What is here: records of studies to and from their files. What is not: how they are filled (optimize/search/).
#include "results/study_record.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/hole_row.h"
#include "io/csv.h"
#include "io/error.h"
#include "io/files.h"
#include "io/text.h"
#include "results/campaign_folder.h"
#include "results/formats.h"
#include "results/json.h"
#include "results/record_reading.h"

namespace perfora::results {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* schema = "perfora.study_picture/1";

json or_null(const std::optional<double>& value) {
  return value ? number(*value) : json(nullptr);
}

std::optional<double> optional_in(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

json curves_json(const std::vector<Curve>& curves) {
  json array = json::array();
  for (const Curve& curve : curves) {
    json one = {{"strain", curve.strain}, {"stress", curve.stress}};
    if (!curve.name.empty()) one["name"] = curve.name;
    array.push_back(std::move(one));
  }
  return array;
}

std::vector<Curve> curves_in(const json& array) {
  std::vector<Curve> curves;
  for (const json& one : array)
    curves.push_back({one.at("strain").get<std::vector<double>>(), one.at("stress").get<std::vector<double>>(),
                      one.value("name", "")});
  return curves;
}

json layout_json(const std::optional<geometry::PerforationLayout>& layout) {
  if (!layout) return nullptr;
  json holes = json::array();
  for (const geometry::Perforation& hole : layout->perforations) {
    const geometry::HoleRow row = geometry::hole_row(hole);
    holes.push_back({{"shape", row.shape}, {"numbers", row.numbers}});
  }
  return {{"width", layout->width}, {"height", layout->height}, {"holes", holes}};
}

std::optional<geometry::PerforationLayout> layout_in(const json& object) {
  if (object.is_null()) return std::nullopt;
  geometry::PerforationLayout layout{object.at("width").get<double>(), object.at("height").get<double>(), {}};
  for (const json& row : object.at("holes"))
    if (const auto hole =
            geometry::hole_of({row.at("shape").get<std::string>(), row.at("numbers").get<std::vector<double>>()}))
      layout.perforations.push_back(*hole);
  return layout;
}

/// A value of a design as result.json has it, for people.
std::string value_text(const json& object, const std::string& key) {
  if (!object.is_object() || !object.contains(key)) return {};
  const json& value = object.at(key);
  return value.is_string()   ? value.get<std::string>()
         : value.is_number() ? fmt::format("{:.4g}", value.get<double>())
                             : value.dump();
}

/// evaluations.csv: the points, and which of them is the best of result.json.
void add_points(StudyRecord& record, const fs::path& file, const json& result) {
  const io::TextTable table = io::read_text_table(file);
  const std::size_t stage = table.column("stage"), arm = table.column("arm"), status = table.column("status"),
                    score = table.column("score"), first = table.column("number") + 1;
  const json best = result.value("best", json());
  for (const std::vector<std::string>& row : table.rows) {
    if (row[stage] == "start" || row[status] == "open") continue;
    StudyPoint point;
    point.number = static_cast<int>(record.points.size()) + 1;
    point.arm = row[arm] + (row[stage] == "refine" ? " (refine)" : "");
    point.feasible = row[status] != "breaks a constraint";
    if (row[status] == "completed") point.score = io::number_in(row[score]);
    bool same = best.is_object() && point.score == result.value("score", double{NAN});
    for (std::size_t k = first; k < status; ++k) {
      point.values.push_back(io::number_in(row[k]));
      same = same && best.value(table.names[k], double{NAN}) == point.values.back();
    }
    if (same && record.best_number == 0) record.best_number = point.number;
    record.points.push_back(std::move(point));
  }
}

void read_window(const json& object, const char* key, StudyRecord& record) {
  const json window = object.value(key, json());
  if (!window.is_array() || window.size() != 2) return;
  if (window[0].is_number()) record.window_start = window[0].get<double>();
  if (window[1].is_number()) record.window_end = window[1].get<double>();
}

StudyRecord from_results(const fs::path& folder) {
  // Killed before its first results: what its table tells is shown.
  const bool any = fs::exists(folder / "result.json") || !fs::exists(folder / "evaluations.csv");
  const json result = any ? json::parse(io::read_file(folder / "result.json"), nullptr, false)
                          : json{{"schema", study_schema}, {"reason", "not finished"}};
  if (!result.is_object() || result.value("schema", "") != study_schema)
    throw io::InputError({(folder / "result.json").string(), 0, ""}, "this is not the result of a study", "",
                         "give the folder of a `perfora optimize`");
  StudyRecord record;
  record.title = campaign_title(folder);
  const int replicates = result.value("replicates", 1);
  record.subtitle =
      fmt::format("{}, {} replicate{} a candidate, {} evaluations; {}", result.value("algorithm", ""), replicates,
                  replicates == 1 ? "" : "s", result.value("evaluations", 0), result.value("reason", ""));
  record.target = optional_in(result, "target");
  read_window(result, "plateau_window", record);
  if (const auto verdict = result.find("verdict"); verdict != result.end()) {
    record.verdict = verdict->value("text", "");
    record.outcome = verdict->value("outcome", "");
  }
  const json plateau = result.value("plateau_stress", json());
  if (plateau.is_object()) {
    record.best_plateau = optional_in(plateau, "mean");
    record.best_plateau_deviation = optional_in(plateau, "standard_deviation");
  }
  const json best = result.value("best", json()), start = result.value("start", json());
  if (best.is_object())
    for (const auto& [key, value] : best.items())
      record.facts.push_back({io::after_section(key), value_text(best, key), value_text(start, key)});
  record.facts.push_back({"score", value_text(result, "score"), value_text(result, "start_score")});
  add_points(record, folder / "evaluations.csv", result);
  return record;
}

}  // namespace

json to_json(const StudyRecord& record) {
  json points = json::array(), facts = json::array();
  for (const StudyPoint& p : record.points)
    points.push_back({{"number", p.number},
                      {"arm", p.arm},
                      {"values", p.values},
                      {"score", number(p.score)},
                      {"feasible", p.feasible}});
  for (const StudyRecord::Fact& fact : record.facts)
    facts.push_back({{"name", fact.name}, {"best", fact.best}, {"start", fact.start}});
  return {{"schema", schema},
          {"title", record.title},
          {"subtitle", record.subtitle},
          {"score_label", record.score_label},
          {"points", points},
          {"best_number", record.best_number},
          {"best", curves_json(record.best)},
          {"start", curves_json(record.start)},
          {"measured", curves_json(record.measured)},
          {"best_plateau", or_null(record.best_plateau)},
          {"best_plateau_deviation", or_null(record.best_plateau_deviation)},
          {"start_plateau", or_null(record.start_plateau)},
          {"start_plateau_deviation", or_null(record.start_plateau_deviation)},
          {"target", or_null(record.target)},
          {"target_tolerance", or_null(record.target_tolerance)},
          {"target_curve", curves_json({record.target_curve}).front()},
          {"window", {or_null(record.window_start), or_null(record.window_end)}},
          {"caps", to_json(record.caps)},
          {"verdict", record.verdict},
          {"outcome", record.outcome},
          {"best_layout", layout_json(record.best_layout)},
          {"start_layout", layout_json(record.start_layout)},
          {"facts", facts}};
}

StudyRecord study_record_from_json(const json& object) {
  StudyRecord record;
  record.title = object.at("title").get<std::string>();
  record.subtitle = object.at("subtitle").get<std::string>();
  record.score_label = object.at("score_label").get<std::string>();
  for (const json& p : object.at("points")) {
    StudyPoint& point = record.points.emplace_back();
    point.number = p.at("number").get<int>();
    point.arm = p.at("arm").get<std::string>();
    point.values = p.at("values").get<std::vector<double>>();
    if (p.at("score").is_number()) point.score = p.at("score").get<double>();
    point.feasible = p.at("feasible").get<bool>();
  }
  record.best_number = object.at("best_number").get<int>();
  record.best = curves_in(object.at("best"));
  record.start = curves_in(object.at("start"));
  record.measured = curves_in(object.value("measured", json::array()));
  record.caps = stress_caps_from_json(object.value("caps", json::array()));
  record.best_plateau = optional_in(object, "best_plateau");
  record.best_plateau_deviation = optional_in(object, "best_plateau_deviation");
  record.start_plateau = optional_in(object, "start_plateau");
  record.start_plateau_deviation = optional_in(object, "start_plateau_deviation");
  record.target = optional_in(object, "target");
  record.target_tolerance = optional_in(object, "target_tolerance");
  if (const auto curve = object.find("target_curve"); curve != object.end())
    record.target_curve = curves_in(json::array({*curve})).front();
  read_window(object, "window", record);
  record.verdict = object.value("verdict", "");
  record.outcome = object.value("outcome", "");
  record.best_layout = layout_in(object.at("best_layout"));
  record.start_layout = layout_in(object.at("start_layout"));
  for (const json& fact : object.at("facts"))
    record.facts.push_back(
        {fact.at("name").get<std::string>(), fact.at("best").get<std::string>(), fact.at("start").get<std::string>()});
  return record;
}

StudyRecord read_study_record(const fs::path& folder) {
  const fs::path file = folder / "study.json";
  const char* remedy = "continue the study with --resume: it writes the file anew";
  if (!fs::exists(file)) return read_from(folder / "result.json", 0, remedy, [&] { return from_results(folder); });
  return read_from(file, 0, remedy, [&] { return study_record_from_json(json::parse(io::read_file(file))); });
}

}  // namespace perfora::results
