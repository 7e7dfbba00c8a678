// What is here: which lines the summary of each schema has. What is not: their labels (summary_labels.cpp), tables
// (summary_tables.cpp).
#include "results/summary_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/error.h"
#include "io/text.h"
#include "results/formats.h"
#include "results/measure_table.h"
#include "results/summary_labels.h"
#include "results/summary_parts.h"
#include "results/summary_tables.h"

namespace perfora::results {

using nlohmann::json;

namespace {

using io::Dimension;

/// What the user reads first, with a line a wish below it.
std::string verdict_text(const json& object) {
  const json& verdict = object_in(object, "verdict");
  if (verdict.empty()) return {};
  std::string text = fmt::format("Verdict: {}\n", text_in(verdict, "text"));
  for (const json& wish : list_in(verdict, "wishes"))
    text += line_text(text_in(wish, "outcome"), text_in(wish, "text"));
  return text + line_text("note", text_in(verdict, "note"));
}

std::string head_text(const json& object) {
  std::string text = verdict_text(object);
  const std::string reason = text_in(object, "reason");
  text += fmt::format("{}{}{}\n", text_in(object, "status", "?"), reason.empty() ? "" : ": ", reason);
  std::string seeds;
  for (const auto& [name, value] : object_in(object, "seeds").items())
    if (value.is_number()) seeds += fmt::format("{}{} {}", seeds.empty() ? "" : ", ", name, value.dump());
  return seeds.empty() ? text : text + line_text("seeds", seeds);
}

/// "3 min 05 s on 2 threads"
std::string time_on_threads(const json& object) {
  const double threads = number_in(object, "threads");
  std::string time = io::duration(number_in(object, "seconds"));
  if (!std::isfinite(threads)) return time;
  return fmt::format("{} on {} thread{}", time, io::count(threads), threads == 1.0 ? "" : "s");
}

std::string performance_text(const json& object) {
  const json& performance = object_in(object, "performance");
  if (performance.empty()) return {};
  const auto number = [&](const char* key) { return number_in(performance, key); };
  std::string text = "Performance\n";
  // Studies and sweeps go on over several calls; what they cost is the sum over their simulations.
  if (const double all = number("simulated_seconds"); std::isfinite(all)) {
    text += line_text("time of the last call", io::duration(number("seconds")));
    text += line_text("sum of all simulations", io::duration(all));
  } else {
    text += line_text("time", time_on_threads(performance));
  }
  const auto add = [&](const char* label, double value, Dimension dimension) {
    if (std::isfinite(value)) text += line_text(label, io::quantity(value, dimension));
  };
  if (const double solving = number("solution_seconds"); std::isfinite(solving))
    text += line_text("  of it for the solution", io::duration(solving));
  add("steps per second", number("steps_per_second"), Dimension::none);
  add("time per bond and step", 1e-9 * number("ns_per_bond_step"), Dimension::time);
  add("largest memory", number("peak_memory"), Dimension::memory);
  return text;
}

std::string window_text(const json& object) {
  const Pair window = pair_in(object, "plateau_window");
  if (!window.known()) return {};
  return line_text("plateau window",
                   io::quantities({window.first, window.second}, Dimension::ratio, " to ") + " strain");
}

std::string pack_text(const json& object) {
  return lines_text("Packing", object, packing_labels()) + performance_text(object);
}

std::string evaluate_text(const json& object) {
  return lines_text("Packing", object, packing_labels()) + lines_text("Curve", object, curve_labels()) +
         window_text(object) + lines_text("Breakage at the end", object, damage_labels()) +
         lines_text("Run", object, run_labels()) + performance_text(object);
}

std::string elastic_text(const json& object) {
  std::string text = lines_text("Packing", object, packing_labels()) +
                     lines_text("Elastic response", object, elastic_labels()) +
                     stiffness_table(list_in(object, "stiffness")) +
                     lines_text("First yield, compression along y at fixed width", object, first_yield_labels());
  const Pair place = pair_in(object, "first_yield_place");
  if (place.known())
    text += line_text("place of the first bond (x, y)",
                      io::quantities({place.first, place.second}, Dimension::length, ", "));
  return text + lines_text("Solution", object, solution_labels()) + performance_text(object);
}

/// The value of a key of a design file.
std::string key_value_text(const std::string& key, const json& value, const KeyDimension& key_dimension) {
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) return io::quantity(value.get<double>(), key_dimension(key));
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  return value.is_string() ? value.get<std::string>() : std::string("none");
}

/// Best and start design on seeds that the search did not use. `same`: the start is what is recommended.
std::string finals_text(const json& finals, bool same) {
  const double pairs = number_in(finals, "pairs");
  if (!(pairs > 0.0)) {
    const std::string why = text_in(finals, "not_compared");
    return fmt::format("Best and start were not compared on fresh seeds{}{}\n", why.empty() ? "" : ": ", why);
  }
  std::string text = fmt::format("On {} fresh seeds\n", io::count(pairs));
  for (const char* whose : {"best", "start"}) {
    if (same && std::string_view(whose) == "best") continue;
    const json& score = object_in(finals, whose);
    const double mean = number_in(score, "mean"), deviation = number_in(score, "standard_deviation");
    const double broken = number_in(score, "wishes_not_kept");
    text += line_text(
        std::string("plateau of the ") + whose,
        io::quantity(mean, Dimension::stress) +
            (std::isfinite(deviation) ? fmt::format(" (deviation {})", io::quantity(deviation, Dimension::stress))
                                      : std::string()) +
            (broken > 0.0 ? fmt::format(", {} wish{} not kept", io::count(broken), broken == 1.0 ? "" : "es")
                          : std::string()));
  }
  if (same) return text;
  const double gain = number_in(finals, "gain"), interval = number_in(finals, "gain_confidence_95");
  const double error = number_in(finals, "gain_standard_error");  // all that an older program left
  const auto significant = finals.find("significant");
  const bool is_significant = significant != finals.end() && *significant == true;
  if (!std::isfinite(interval) && std::isfinite(error)) {
    text += line_text("gain in score over the start",
                      io::quantities({gain, error}, Dimension::none, " +- ") + " (standard error)");
    return text + line_text("", is_significant ? "more than two standard errors"
                                               : "not more than two standard errors, so it may be chance");
  }
  if (!std::isfinite(interval)) return text;
  text += line_text("gain in score over the start",
                    io::quantities({gain, interval}, Dimension::none, " +- ") + " (95 %, paired)");
  return text + line_text("", is_significant ? "a gain beyond its interval" : "it may be chance");
}

/// A sentence a line, below a title; nothing where there is none.
std::string sentences_text(std::string_view title, const json& sentences) {
  std::string text;
  for (const json& one : sentences)
    if (one.is_string()) text += "  " + one.get<std::string>() + "\n";
  return text.empty() ? text : std::string(title) + "\n" + text;
}

/// How far the designs of a map reached, a line a measure.
std::string map_text(const json& object) {
  const json& designs = required_list(object, "designs");
  std::string text = sentences_text("Wishes", list_in(object, "out_of_reach"));
  const double replicates = number_in(object, "replicates");
  text += fmt::format("Map: {} designs, {} replicate{} of each\n", designs.size(), io::count(replicates),
                      replicates == 1.0 ? "" : "s");
  for (const char* key : {"plateau_stress", "cap_ratio", "undulation", "densification_strain", "first_peak_stress"}) {
    const Measure& measure = *measure_called(key);
    double low = not_reached, high = not_reached;
    int reached = 0;
    for (const json& one : designs) {
      const double mean = number_in(object_in(object_in(one, "results"), key), "mean");
      if (!std::isfinite(mean)) continue;
      low = std::fmin(low, mean);
      high = std::fmax(high, mean);
      ++reached;
    }
    text += line_text(
        measure.label,
        reached == 0 ? std::string("not reached by any design")
                     : fmt::format("{}, {} designs", io::quantities({low, high}, measure.dimension, " to "), reached));
  }
  return text;
}

/// The designs that were verified, the recommended one first to be seen.
std::string verified_text(const json& designs) {
  std::string text;
  for (const json& one : designs)
    text += line_text(text_in(object_in(one, "verdict"), "outcome", "verified"),
                      text_in(one, "label") + (one.value("recommended", false) ? " (recommended)" : ""));
  return text.empty() ? text : "Verified designs\n" + text;
}

/// How many single blocks keep every wish, and where the next one will lie.
std::string single_blocks_text(const json& object) {
  const std::string blocks = text_in(object_in(object, "single_blocks"), "text");
  return blocks.empty() ? blocks : "Single blocks\n  " + blocks + "\n";
}

/// How many designs no other beats in all that is weighed, and how many of them were verified.
std::string pareto_text(const json& set) {
  const json& designs = list_in(set, "designs");
  if (designs.empty()) return {};
  const auto verified = std::count_if(designs.begin(), designs.end(),
                                      [](const json& one) { return one.is_object() && one.value("verified", false); });
  std::string names;
  for (const json& key : list_in(set, "objectives"))
    if (const Measure* measure = key.is_string() ? measure_called(key.get<std::string>()) : nullptr)
      names += (names.empty() ? "" : ", ") + std::string(measure->label);
  return line_text("Pareto set", fmt::format("{} design{}, {} verified ({})", designs.size(),
                                             designs.size() == 1 ? "" : "s", verified, names));
}

std::string optimize_text(const json& object, const KeyDimension& key_dimension) {
  const json& map = object_in(object, "map");
  std::string text = sentences_text("Map", list_in(map, "out_of_reach"));
  text += lines_text("Search", object, search_labels());
  text += pareto_text(object_in(object, "pareto"));
  const json& best = object_in(object, "best");
  if (!best.empty()) text += "Best design\n";
  for (const auto& [key, value] : best.items()) text += line_text(key, key_value_text(key, value, key_dimension));
  if (!best.empty() && text_in(object, "status") == "completed")
    text += finals_text(object_in(object, "finals"), best == object_in(object, "start"));
  text += verified_text(list_in(object, "verified"));
  text += single_blocks_text(object);
  text += sentences_text("Remarks", list_in(object, "remarks"));
  text += sentences_text("What more would buy", list_in(object, "what_more_would_buy"));
  return text + performance_text(object);
}

std::string calibrate_text(const json& object, const KeyDimension& key_dimension) {
  std::string text = "Bond parameters found\n";
  for (const auto& [name, value] : required_object(object, "found").items()) {
    // perfora.calibrate/1 has the name that this key had first.
    const std::string key = "material." + (name == "critical_normal_stretch" ? "critical_normal_displacement" : name);
    text += line_text(key, key_value_text(key, value, key_dimension));
  }
  return text + targets_table(required_list(object, "targets")) + performance_text(object);
}

/// One line a number, with its scatter over the samples.
std::string material_text(const json& object) {
  const json& tested = required_object(object, "material");
  std::string text = "Material\n";
  for (const Label& label : material_labels()) {
    const json& statistic = object_in(tested, std::string(label.key));
    const double mean = number_in(statistic, "mean"), deviation = number_in(statistic, "standard_deviation");
    if (!std::isfinite(mean)) continue;
    std::string value = io::quantity(mean, label.dimension);
    if (std::isfinite(deviation))
      value += fmt::format(" (deviation {}, {} samples)", io::quantity(deviation, label.dimension),
                           io::count(number_in(statistic, "count")));
    text += line_text(label.label, value);
  }
  return text + performance_text(object);
}

}  // namespace

std::string summary_text(const json& object, const KeyDimension& key_dimension, const std::string& source) {
  using Printer = std::function<std::string(const json&)>;
  const std::map<std::string, Printer> printers = {
      {pack_format, pack_text},
      {evaluation_schema, evaluate_text},
      {elastic_format, elastic_text},
      {ensemble_schema,
       [](const json& o) { return single_blocks_text(o) + statistics_table(required_object(o, "statistics")); }},
      {sweep_schema, [](const json& o) { return performance_text(o) + sweep_table(o); }},
      {tolerance_schema, [](const json& o) { return performance_text(o) + tolerance_table(o); }},
      {study_schema, [&](const json& o) { return optimize_text(o, key_dimension); }},
      {map_schema, map_text},
      {calibration_schema, [&](const json& o) { return calibrate_text(o, key_dimension); }},
      {material_format, material_text},
      {check_schema, [](const json& o) { return estimate_text(o); }}};
  const std::string schema = object.is_object() ? text_in(object, "schema") : "";
  const auto printer = printers.find(schema);
  if (printer == printers.end())
    throw io::InputError(
        {source, 0, ""},
        schema.empty() ? "holds no result of perfora" : "has no summary: its schema is " + io::in_quotes(schema),
        "results of pack, evaluate, sweep, tolerance, optimize, calibrate, test and check can be shown");
  try {
    return head_text(object) + printer->second(object);
  } catch (const DamagedSummary& damaged) {
    throw io::InputError({source, 0, ""}, fmt::format("is damaged: {}", damaged.what()), "",
                         "make the result again, or restore the file");
  }
}

std::string estimate_text(const json& object, const std::string& whose) {
  std::string text = lines_text(fmt::format("One evaluation{} (estimated from counts; no disc was placed)", whose),
                                object, estimate_labels());
  const double seconds = number_in(object, "seconds");
  return std::isfinite(seconds) ? text + line_text("time, roughly", time_on_threads(object)) : text;
}

}  // namespace perfora::results
