// What is here: see sweep_text.h. What is not: units of pictures (report/).
#include "app/sweep_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace perfora::app {

namespace {

using nlohmann::json;

double number_in(const json& object, const char* name, const char* key) {
  const json statistic = object.value(name, json::object());
  const auto found = statistic.find(key);
  return found != statistic.end() && found->is_number() ? found->get<double>() : std::nan("");
}

/// One result as people read it, with half of its 95 % interval, and its change to case 0 in per cent of that.
std::string value_text(const json& one, const std::string& name) {
  const json statistics = one.value("statistics", json::object()), changes = one.value("changes", json::object());
  const double mean = number_in(statistics, name.c_str(), "mean");
  const double half = number_in(statistics, name.c_str(), "confidence_95");
  const double change = number_in(changes, name.c_str(), "mean");
  if (!std::isfinite(mean)) return "-";
  const bool stress = name.ends_with("_stress") || name.ends_with("_in_window");
  const bool share = name.ends_with("_strain");
  const double scale = stress ? 1e-3 : share ? 100.0 : 1.0;
  std::string text = fmt::format("{:.4g}", scale * mean);
  if (std::isfinite(half)) text += fmt::format(" +- {:.2g}", scale * half);
  text += stress ? " kPa" : share ? " %" : "";
  if (std::isfinite(change) && mean != change) text += fmt::format(" ({:+.3g} %)", 100.0 * change / (mean - change));
  return text;
}

}  // namespace

std::string sweep_table_text(const json& record) {
  constexpr std::size_t widest_label = 44;
  const json cases = record.value("cases", json::array());
  const auto measures = record.value("measures", std::vector<std::string>{"first_peak_stress", "plateau_stress"});
  std::size_t label_width = 5;
  bool compared = false;
  for (const json& one : cases) {
    label_width = std::max(label_width, std::min(one.value("label", "").size(), widest_label));
    compared = compared || one.contains("changes");
  }
  std::string text = fmt::format("{:>4}  {:<{}}  {:>4}", "case", "label", label_width, "runs");
  for (const std::string& name : measures) text += fmt::format("  {:>28}", name);
  text += "\n";
  for (const json& one : cases) {
    text += fmt::format("{:>4}  {:<{}}  ", one.value("case", 0), one.value("label", "").substr(0, widest_label),
                        label_width);
    if (!one.value("problem", json()).is_null()) {
      text += "cannot be run\n";
      continue;
    }
    text += fmt::format("{:>4}", one.value("completed", 0));
    for (const std::string& name : measures) text += fmt::format("  {:>28}", value_text(one, name));
    text += one.value("failed", 0) > 0 ? fmt::format("  {} failed\n", one.value("failed", 0)) : "\n";
  }
  text += "+- half of the 95 % interval of the mean";
  return text + (compared ? "; in brackets the change to case 0\n" : "\n");
}

}  // namespace perfora::app
