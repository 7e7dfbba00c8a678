// What is here: one screen about one evaluation. What is not: the curve's characters (report/text_chart.h).
#include "app/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "io/text.h"
#include "report/text_chart.h"
#include "results/measure_table.h"
#include "results/summary_numbers.h"
#include "results/summary_parts.h"

namespace perfora::app {

namespace {

using nlohmann::json;

constexpr const char* shown_measures[] = {
    "first_peak_stress", "plateau_stress", "undulation",      "smallest_over_mean", "cap_ratio", "densification_strain",
    "energy_absorbed",   "impact_ratio",   "energy_residual", "broken_bonds",       "fragments", "final_strain"};

/// Whether the terminal shows UTF-8, as far as its settings tell.
bool shows_unicode() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') continue;
    std::string text = value;
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text.find("utf-8") != std::string::npos || text.find("utf8") != std::string::npos;
  }
  return false;
}

std::string verdict_lines(const json& record) {
  constexpr std::size_t most_wishes = 8;
  const json& verdict = results::object_in(record, "verdict");
  if (verdict.empty()) return {};
  std::string text = fmt::format("Verdict: {}\n", results::text_in(verdict, "outcome"));
  const json& wishes = results::list_in(verdict, "wishes");
  for (std::size_t k = 0; k < std::min(most_wishes, wishes.size()); ++k)
    text += results::line_text(results::text_in(wishes[k], "outcome"), results::text_in(wishes[k], "text"));
  return text;
}

}  // namespace

bool on_terminal() {
  return ::isatty(STDOUT_FILENO) == 1;
}

std::string screen_text(const json& record, const results::History& curve, const std::string& run_file) {
  std::string text = verdict_lines(record);
  text += fmt::format("{}: {}\n", results::text_in(record, "status", "?"), results::text_in(record, "reason"));
  for (const char* key : shown_measures) {
    const results::Measure* measure = results::measure_called(key);
    if (measure == nullptr) continue;
    const auto value = results::summary_number(record, key);
    std::string_view label = measure->label;
    label.remove_prefix(std::min(label.find_first_not_of(' '), label.size()));
    text += results::line_text(label, value ? io::quantity(*value, measure->dimension) : "not reached");
  }
  // The first peak or thrice the plateau, so that the last percent of strain do not hide the rest.
  constexpr double plateaus = 3.0;
  const double peak = results::summary_number(record, "first_peak_stress").value_or(0.0);
  const double plateau = results::summary_number(record, "plateau_stress").value_or(0.0);
  text += report::text_chart(curve.strain_yy, curve.stress_yy,
                             {.stress_at_top = std::max(peak, plateaus * plateau), .unicode = shows_unicode()});
  return text + fmt::format("All numbers: perfora show {}\n", run_file);
}

}  // namespace perfora::app
