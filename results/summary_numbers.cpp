// What is here: looking numbers up in a JSON summary. What is not: its keys (measure_table.h).
#include "results/summary_numbers.h"

#include <string>

namespace perfora::results {

std::optional<double> summary_number(const nlohmann::json& summary, std::string_view key) {
  if (!summary.is_object()) return std::nullopt;
  const auto found = summary.find(std::string(key));
  if (found != summary.end()) return found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
  for (const char* part : {"summary", "pack"})
    if (const auto inner = summary.find(part); inner != summary.end())
      if (const auto value = summary_number(*inner, key)) return value;
  return std::nullopt;
}

std::optional<std::pair<double, double>> plateau_window(const nlohmann::json& summary) {
  if (!summary.is_object()) return std::nullopt;
  const auto start = summary_number(summary, "plateau_start");
  const auto end = summary_number(summary, "plateau_end");
  if (start && end) return std::pair(*start, *end);
  for (const nlohmann::json& place : {summary, summary.value("summary", nlohmann::json::object())}) {
    const auto window = place.find("plateau_window");
    if (window != place.end() && window->is_array() && window->size() == 2 && (*window)[0].is_number() &&
        (*window)[1].is_number())
      return std::pair((*window)[0].get<double>(), (*window)[1].get<double>());
  }
  return std::nullopt;
}

}  // namespace perfora::results
