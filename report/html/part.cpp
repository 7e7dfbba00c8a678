// What is here: facts that several parts of a page share. What is not: the parts.
#include "report/html/part.h"

#include <fmt/format.h>

#include <cmath>

#include "io/numbers.h"
#include "io/text.h"
#include "io/toml.h"
#include "results/json.h"
#include "results/measure_table.h"
#include "results/summary_numbers.h"
#include "results/summary_parts.h"

namespace perfora::report {

using nlohmann::json;

namespace {

json text_or_empty(const json& object, const char* key) {
  if (!object.is_object()) return "";
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? *found : json("");
}

/// Six significant digits: more than a screen shows.
double short_number(double value) {
  return io::number_from(fmt::format("{:.6g}", value)).value_or(NAN);
}

json table_of(const json& summary, results::MeasureGroup group, const char* title) {
  json rows = json::array();
  const double final_strain = results::summary_number(summary, "final_strain").value_or(NAN);
  for (const results::Measure& measure : results::measures()) {
    if (measure.group != group) continue;
    const auto value = results::summary_number(summary, measure.key);
    const json& holder = summary.contains(measure.key) ? summary : summary.value("summary", json::object());
    if (!value && !holder.contains(measure.key)) continue;
    const bool reached = value && !results::still_grows(measure.key, *value, final_strain);
    rows.push_back({measure.label, reached ? io::quantity(*value, measure.dimension) : "not reached", measure.help});
  }
  return {{"title", title}, {"rows", rows}};
}

}  // namespace

json verdict_facts(const json& summary) {
  if (!summary.is_object() || !summary.contains("verdict") || !summary.at("verdict").is_object()) return nullptr;
  const json& verdict = summary.at("verdict");
  json wishes = json::array();
  for (const json& wish : verdict.value("wishes", json::array()))
    if (wish.is_object())
      wishes.push_back({{"outcome", text_or_empty(wish, "outcome")},
                        {"text", text_or_empty(wish, "text")},
                        {"measure", text_or_empty(wish, "measure")},
                        {"low", wish.value("low", json())},
                        {"high", wish.value("high", json())}});
  return {{"outcome", text_or_empty(verdict, "outcome")},
          {"text", text_or_empty(verdict, "text")},
          {"note", text_or_empty(verdict, "note")},
          {"blocks", text_or_empty(summary.value("single_blocks", json::object()), "text")},
          {"wishes", wishes}};
}

json measure_tables(const json& summary) {
  json tables = json::array();
  using enum results::MeasureGroup;
  for (const auto& [group, title] :
       {std::pair(curve, "Curve"), {breakage, "Breakage"}, {packing, "Packing"}, {run, "Run"}})
    if (json table = table_of(summary, group, title); !table.at("rows").empty()) tables.push_back(std::move(table));
  return tables;
}

Configured::Configured(const std::string& toml) {
  try {
    for (io::Entry& entry : io::parse_toml(toml, "configuration")) values_[entry.key] = std::move(entry.value);
  } catch (const io::InputError&) {
    values_.clear();
  }
}

std::optional<double> Configured::number(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) return std::nullopt;
  if (const double* real = std::get_if<double>(&found->second.data)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&found->second.data)) return static_cast<double>(*whole);
  return std::nullopt;
}

std::string Configured::text(const std::string& key) const {
  const auto found = values_.find(key);
  const std::string* text = found == values_.end() ? nullptr : std::get_if<std::string>(&found->second.data);
  return text ? *text : std::string();
}

json numbers_or_null(std::span<const double> values) {
  json array = json::array();
  for (const double value : values) array.push_back(results::number(value));
  return array;
}

json curve_facts(std::span<const results::Curve> curves) {
  json array = json::array();
  for (const results::Curve& curve : curves) {
    json strain = json::array(), stress = json::array();
    for (std::size_t k = 0; k < std::min(curve.strain.size(), curve.stress.size()); ++k) {
      if (!std::isfinite(curve.strain[k]) || !std::isfinite(curve.stress[k])) continue;
      strain.push_back(short_number(curve.strain[k]));
      stress.push_back(short_number(curve.stress[k]));
    }
    array.push_back({{"name", curve.name}, {"strain", strain}, {"stress", stress}});
  }
  return array;
}

}  // namespace perfora::report
