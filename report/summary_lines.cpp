// What is here: the lines of JSON objects. What is not: files (text.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "report/canvas.h"
#include "report/text.h"

namespace perfora::report {
namespace {

constexpr int name_width = 38;
constexpr std::size_t longest_list = 6;

bool has(std::string_view key, std::string_view part) {
  return key.find(part) != std::string_view::npos;
}
bool ends(std::string_view key, std::string_view part) {
  return key.ends_with(part);
}

struct Unit {
  double factor;
  const char* name;
};

/// By the words of docs/user/formats.md: SI in the file, what people read here.
Unit unit_of(std::string_view key) {
  if (has(key, "ratio") || has(key, "per_") || has(key, "coordination") || ends(key, "_version") || ends(key, "_pair"))
    return {1.0, ""};
  if (has(key, "stress") && !has(key, "asymmetry")) return {1e-6, " MPa"};
  if (key == "target") return {1e-6, " MPa"};
  if (ends(key, "strain") || has(key, "fraction") || has(key, "porosity") || has(key, "undulation") ||
      ends(key, "share") || has(key, "energy_residual") || key == "plateau_window" || key == "plateau_start" ||
      key == "plateau_end" || has(key, "max_overlap_in_run"))
    return {100.0, " %"};
  if (ends(key, "diameter") || has(key, "thinnest_wall") || key == "width" || key == "height") return {1e3, " mm"};
  if (key == "time_step") return {1e6, " us"};
  if (ends(key, "rate")) return {1.0, " 1/s"};
  if (key == "seconds") return {1.0, " s"};
  if (key == "energy_absorbed") return {1e-3, " kJ/m3"};
  if (key == "peak_memory") return {1e-6, " MB"};
  return {1.0, ""};
}

std::string number_text(std::string_view key, const nlohmann::json& value) {
  const Unit unit = unit_of(key);
  if (value.is_number_integer() && *unit.name == '\0') {
    if (has(key, "seed") || ends(key, "_version") || ends(key, "_pair")) return value.dump();
    if (value.is_number_unsigned() && value.get<std::uint64_t>() > 999'999'999'999ull) return value.dump();
    return with_thousands(value.get<std::int64_t>());
  }
  const double number = value.get<double>() * unit.factor;
  if (number == std::round(number) && std::abs(number) < 1e6) return fmt::format("{:.0f}{}", number, unit.name);
  return short_number(number, 4) + unit.name;
}

std::string scalar_text(std::string_view key, const nlohmann::json& value) {
  if (value.is_null()) return "not reached";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_string()) return value.get<std::string>();
  return number_text(key, value);
}

std::string list_text(std::string_view key, const nlohmann::json& list) {
  const bool plain = std::none_of(list.begin(), list.end(), [](const auto& item) { return item.is_structured(); });
  if (!plain || list.size() > longest_list)
    return fmt::format("{} entries", with_thousands(static_cast<std::int64_t>(list.size())));
  std::string text;
  for (const auto& item : list) text += (text.empty() ? "" : ", ") + scalar_text(key, item);
  return text.empty() ? "none" : text;
}

std::string words(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

void add_lines(std::string& text, const nlohmann::json& object, const std::string& indent, bool in_seeds) {
  const int width = name_width - static_cast<int>(indent.size());
  for (const auto& [key, value] : object.items()) {
    if (value.is_object()) continue;
    std::string shown;
    if (value.is_array())
      shown = list_text(key, value);
    else
      shown = in_seeds && value.is_number() ? value.dump() : scalar_text(key, value);
    if (!shown.empty()) text += fmt::format("{}{:<{}}{}\n", indent, words(key), width, shown);
  }
  for (const auto& [key, value] : object.items()) {
    if (!value.is_object() || value.empty()) continue;
    text += fmt::format("{}{}\n", indent, words(key));
    add_lines(text, value, indent + "  ", key == "seeds");
  }
}

}  // namespace

std::string summary_lines(const nlohmann::json& object) {
  std::string text;
  add_lines(text, object, "  ", false);
  return text;
}

}  // namespace perfora::report
