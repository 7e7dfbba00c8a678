// What is here: reading JSON that may be damaged, aligned lines. What is not: which lines (summary_labels.cpp).
#include "results/summary_parts.h"

#include <fmt/format.h>

#include <cmath>

#include "io/text.h"

namespace perfora::results {

using nlohmann::json;

namespace {

constexpr int label_width = 38;

const json& part_in(const json& object, const std::string& key, bool required, bool list) {
  static const json no_object = json::object(), no_list = json::array();
  const auto found = object.find(key);
  if (found != object.end() && (list ? found->is_array() : found->is_object())) return *found;
  if (!required && (found == object.end() || found->is_null())) return list ? no_list : no_object;
  throw DamagedSummary(
      fmt::format("its key `{}` is {}", key, found == object.end() ? "missing" : (list ? "no list" : "no object")));
}

/// "1 and 2": people count holes from 1.
std::string wall_pair_text(const json& object) {
  const Pair pair = pair_in(object, "thinnest_wall_pair");
  if (!pair.known()) return {};
  const std::string first = io::count(pair.first + 1.0), second = io::count(pair.second + 1.0);
  return line_text("  between holes", first == second ? first + " and its periodic image" : first + " and " + second);
}

/// Whether nothing was asked where a measure is missing: there is no wall, no cap, no target.
bool only_where_asked(std::string_view key) {
  return key.starts_with("thinnest_wall") || key == "stroke_at_cap" || key == "stress_until" ||
         key == "target_distance";
}

/// What to print for a key; empty: nothing.
std::string entry_text(const Label& label, const json& value, const json& object) {
  if (value.is_number() && still_grows(label.key, value.get<double>(), number_in(object, "final_strain")))
    return "not reached";
  if (value.is_number()) return io::quantity(value.get<double>(), label.dimension);
  if (value.is_string()) return value.get<std::string>();
  return only_where_asked(label.key) ? "" : "not reached";
}

}  // namespace

double number_in(const json& object, const std::string& key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : std::nan("");
}

std::string text_in(const json& object, const std::string& key, const std::string& otherwise) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

const json& object_in(const json& object, const std::string& key) {
  return part_in(object, key, false, false);
}
const json& list_in(const json& object, const std::string& key) {
  return part_in(object, key, false, true);
}
const json& required_object(const json& object, const std::string& key) {
  return part_in(object, key, true, false);
}
const json& required_list(const json& object, const std::string& key) {
  return part_in(object, key, true, true);
}

bool Pair::known() const {
  return std::isfinite(first) && std::isfinite(second);
}

Pair pair_in(const json& object, const std::string& key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != 2 || !found->at(0).is_number() ||
      !found->at(1).is_number())
    return {std::nan(""), std::nan("")};
  return {found->at(0).get<double>(), found->at(1).get<double>()};
}

bool still_grows(std::string_view key, double value, double final_strain) {
  constexpr double smoothing = 0.005;
  return (key == "efficiency_strain" || key == "densification_onset") && value >= final_strain - smoothing;
}

std::string line_text(std::string_view label, const std::string& value) {
  return fmt::format("  {:<{}} {}\n", label, label_width, value);
}

std::string lines_text(std::string_view title, const json& object, std::span<const Label> labels) {
  std::string text;
  for (const Label& label : labels) {
    const auto found = object.find(label.key);
    if (found == object.end()) continue;
    const std::string value = entry_text(label, *found, object);
    if (!value.empty()) text += line_text(label.label, value);
    if (label.key == "thinnest_wall") text += wall_pair_text(object);
  }
  return text.empty() ? text : fmt::format("{}\n{}", title, text);
}

}  // namespace perfora::results
