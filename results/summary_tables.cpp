// What is here: the tables of ensembles, sweeps, calibrations and elastic responses. What is not: reading JSON
// (summary_parts.cpp).
#include "results/summary_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text.h"
#include "results/interval.h"
#include "results/summary_parts.h"

namespace perfora::results {

using nlohmann::json;

namespace {

constexpr std::size_t widest_label = 44;

const json& entry(const json& list_item) {
  if (!list_item.is_object()) throw DamagedSummary("an entry of a list is no object");
  return list_item;
}

/// One result with half of its 95 % interval, and its change to case 0 in per cent of that.
std::string case_value(const json& one, const std::string& name) {
  const json& statistic = object_in(object_in(one, "statistics"), name);
  const double mean = number_in(statistic, "mean"), half = number_in(statistic, "confidence_95");
  const double change = number_in(object_in(object_in(one, "changes"), name), "mean");
  if (!std::isfinite(mean)) return std::string(io::no_value);
  if (still_grows(name, mean, number_in(object_in(object_in(one, "statistics"), "final_strain"), "mean")))
    return "not reached";
  const io::Dimension dimension = dimension_of(name);
  std::string text =
      std::isfinite(half) ? io::quantities({mean, half}, dimension, " +- ") : io::quantity(mean, dimension);
  if (!std::isfinite(change) || mean == change) return text;
  const double relative = change / (mean - change);
  return text + fmt::format(" ({}{})", relative >= 0.0 ? "+" : "", io::quantity(relative, io::Dimension::ratio));
}

std::vector<std::string> measures_of(const json& sweep) {
  std::vector<std::string> measures;
  for (const json& name : list_in(sweep, "measures"))
    if (name.is_string()) measures.push_back(name.get<std::string>());
  return measures;
}

}  // namespace

std::string statistics_table(const json& statistics) {
  constexpr const char* columns[] = {"mean", "confidence_95", "standard_deviation", "minimum", "maximum"};
  const double final_strain = number_in(object_in(statistics, "final_strain"), "mean");
  std::string text = fmt::format("  {:<26} {:>14} {:>14} {:>14} {:>14} {:>14} {:>5}\n", "over the replicates", "mean",
                                 "+- (95 %)", "deviation", "smallest", "largest", "n");
  for (const auto& [name, statistic] : statistics.items()) {
    text += fmt::format("  {:<26}", name);
    for (const char* column : columns) {
      const double value = number_in(entry(statistic), column);
      text += fmt::format(
          " {:>14}", still_grows(name, value, final_strain) ? "not reached" : io::quantity(value, dimension_of(name)));
    }
    text += fmt::format(" {:>5}\n", io::count(number_in(statistic, "count")));
  }
  return text;
}

std::string sweep_table(const json& sweep) {
  const json& cases = required_list(sweep, "cases");
  const std::vector<std::string> measures = measures_of(sweep);
  std::size_t label_width = 5;
  bool compared = false;
  for (const json& one : cases) {
    label_width = std::max(label_width, std::min(text_in(entry(one), "label").size(), widest_label));
    compared = compared || one.contains("changes");
  }
  std::string text = fmt::format("{:>4}  {:<{}}  {:>4}", "case", "label", label_width, "runs");
  for (const std::string& name : measures) text += fmt::format("  {:>34}", name);
  text += "\n";
  for (const json& one : cases) {
    text += fmt::format("{:>4}  {:<{}}  ", io::count(number_in(one, "case")),
                        io::beginning(text_in(one, "label"), widest_label), label_width);
    if (!text_in(one, "problem").empty()) {
      text += "cannot be run\n";
      continue;
    }
    text += fmt::format("{:>4}", io::count(number_in(one, "completed")));
    for (const std::string& name : measures) text += fmt::format("  {:>34}", case_value(one, name));
    const double failed = number_in(one, "failed");
    if (failed > 0.0) text += fmt::format("  {} failed", io::count(failed));
    const std::string outcome = text_in(object_in(one, "verdict"), "outcome");
    if (!outcome.empty()) text += "  wishes: " + outcome;
    text += "\n";
  }
  for (const json& one : cases)
    for (const char* key : {"verdict", "single_blocks"})
      if (const std::string said = text_in(object_in(one, key), "text"); !said.empty())
        text += fmt::format("case {}: {}\n", io::count(number_in(one, "case")), said);
  text += "+- half of the 95 % interval of the mean";
  return text + (compared ? "; in brackets the change to case 0\n" : "\n");
}

std::string tolerance_table(const json& tolerance) {
  std::string text;
  const auto add = [&](const std::string& label, const json& one) {
    const std::string left_out = text_in(one, "left_out"), problem = text_in(one, "problem");
    const std::string outcome = !left_out.empty()  ? "left out: " + left_out
                                : !problem.empty() ? "cannot be run: " + problem
                                                   : text_in(one, "outcome", "not run yet");
    const double failed = number_in(one, "failed");
    text += fmt::format(
        "{}: {}{}\n", label, outcome,
        failed > 0.0 ? fmt::format(" ({} of {} blocks failed)", io::count(failed), io::count(number_in(one, "blocks")))
                     : "");
    for (const json& wish : list_in(one, "wishes")) {
      const io::Dimension dimension = dimension_of(text_in(entry(wish), "measure"));
      const json& change = object_in(wish, "change");
      const double mean = number_in(change, "mean"), half = number_in(change, "confidence_95");
      std::string value = text_in(wish, "text");
      if (std::isfinite(mean))
        value += "; change " + (std::isfinite(half) ? io::quantities({mean, half}, dimension, " +- ")
                                                    : io::quantity(mean, dimension));
      text += line_text(text_in(wish, "outcome"), value);
    }
  };
  add("undisturbed", required_object(tolerance, "undisturbed"));
  for (const json& one : required_list(tolerance, "deviations")) add(text_in(entry(one), "label"), one);
  const double blocks = number_in(required_object(tolerance, "undisturbed"), "blocks");
  if (blocks < fewest_replicates)
    text += fmt::format("{} block{} of each: nothing is shown with fewer than {}; raise the replicates\n",
                        io::count(blocks), blocks == 1.0 ? "" : "s", fewest_replicates);
  return text + "change: to the undisturbed block of the same seeds, mean +- half of its 95 % interval\n";
}

std::string targets_table(const json& targets) {
  if (targets.empty()) return {};
  std::string text = fmt::format("  {:<26} {:>14} {:>14} {:>10}\n", "", "wanted", "reached", "");
  for (const json& target : targets) {
    const std::string name = text_in(entry(target), "name");
    const auto value = [&](const char* key) { return io::quantity(number_in(target, key), dimension_of(name)); };
    const auto met = target.find("met");
    text += fmt::format("  {:<26} {:>14} {:>14} {:>10}\n", name, value("wanted"), value("reached"),
                        met != target.end() && *met == true ? "met" : "NOT MET");
  }
  return text;
}

std::string stiffness_table(const json& stiffness) {
  std::vector<std::vector<double>> rows;
  double largest = 0.0;
  for (const json& row : stiffness) {
    if (!row.is_array()) throw DamagedSummary("a row of its key `stiffness` is no list");
    rows.emplace_back();
    for (const json& value : row) {
      rows.back().push_back(value.is_number() ? value.get<double>() : std::nan(""));
      if (std::isfinite(rows.back().back())) largest = std::max(largest, std::abs(rows.back().back()));
    }
  }
  if (rows.empty()) return {};
  const io::PrintUnit unit = io::unit_for(largest, io::Dimension::stress);
  std::string text = fmt::format("Stiffness ({}): xx, yy, xy with engineering shear\n", unit.name);
  for (const std::vector<double>& row : rows) {
    text += " ";
    for (const double value : row) text += fmt::format(" {:>12}", io::in_unit(value, {"", unit.exponent}));
    text += "\n";
  }
  return text;
}

}  // namespace perfora::results
