// What is here: curves, marks and provenance of a run as facts. What is not: its frames (frames_part.cpp).
#include "report/html/run_part.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "io/text.h"
#include "report/html/packed.h"
#include "results/json.h"
#include "results/summary.h"
#include "results/summary_numbers.h"

namespace perfora::report {

using nlohmann::json;
using results::RunResult;

namespace {

std::string block_line(const RunResult& run) {
  const std::size_t holes = run.layout.perforations.size();
  return fmt::format("{} block, {} hole{}, {} discs of {} mean diameter, {} bonds",
                     io::quantities({run.width, run.height}, io::Dimension::length, " x "), holes,
                     holes == 1 ? "" : "s", io::count(run.clipped.size()),
                     io::quantity(run.mean_diameter, io::Dimension::length), io::count(run.bonds.size()));
}

/// Columns of the history that the page draws or hands out, with a row for every 1/2000 of the strains at most.
json history_facts(const RunResult& run, Part& part) {
  constexpr std::size_t most_rows = 4000;
  const std::size_t rows = run.history.rows(), stride = std::max<std::size_t>(1, (rows + most_rows - 1) / most_rows);
  std::vector<std::vector<double>> columns;
  json names = json::array();
  const auto add = [&](const char* name, const char* units, const std::vector<double>& values) {
    if (values.size() != rows || rows == 0) return;
    std::vector<double>& column = columns.emplace_back();
    for (std::size_t row = 0; row < rows; row += stride) column.push_back(values[row]);
    if ((rows - 1) % stride != 0) column.push_back(values.back());
    names.push_back({{"name", name}, {"units", units}});
  };
  for (const results::History::Column& column : results::History::columns())
    if (!column.internal || column.values == &results::History::broken_in_tension)
      add(column.name, column.units, run.history.*column.values);
  part.numbers["history"] = packed(floats(columns));
  return {{"columns", names}, {"rows", columns.empty() ? 0 : columns.front().size()}, {"every", stride}};
}

json marks_facts(const json& summary) {
  json marks = json::object();
  for (const char* key : {"first_peak_strain", "first_peak_stress", "plateau_stress", "found_plateau_start",
                          "found_plateau_end", "found_plateau_stress", "densification_strain", "densification_onset"}) {
    const auto value = results::summary_number(summary, key);
    marks[key] = value ? json(*value) : json();
  }
  const auto window = results::plateau_window(summary);
  marks["window"] = window ? json{window->first, window->second} : json();
  return marks;
}

/// Where the cracks run: broken bonds by the angle of the crack (across the bond) to the direction of loading, in
/// twelve classes of 15 degrees from -90 to 90, by mode.
json crack_facts(const RunResult& run) {
  constexpr std::size_t classes = 12;
  std::array<std::array<int, classes>, 2> counts{};
  for (const results::BreakEvent& event : run.events) {
    const auto i = static_cast<std::size_t>(event.i), j = static_cast<std::size_t>(event.j);
    if (std::max(i, j) >= run.clipped.x.size()) continue;
    double dx = run.clipped.x[j] - run.clipped.x[i], dy = run.clipped.y[j] - run.clipped.y[i];
    if (!run.edges.open_x()) dx -= run.width * std::round(dx / run.width);
    if (!run.edges.platens) dy -= run.height * std::round(dy / run.height);
    if (dx == 0.0 && dy == 0.0) continue;
    // The crack is at right angles to the bond: its angle to the vertical is that of the bond to the horizontal.
    double angle = std::atan2(dy, dx);
    if (angle > 0.5 * std::numbers::pi) angle -= std::numbers::pi;
    if (angle < -0.5 * std::numbers::pi) angle += std::numbers::pi;
    const double place = (angle / std::numbers::pi + 0.5) * static_cast<double>(classes);
    counts[event.mode == results::BreakMode::shear ? 1 : 0]
          [std::min(classes - 1, static_cast<std::size_t>(std::max(0.0, place)))]++;
  }
  return {{"tension", counts[0]}, {"shear", counts[1]}};
}

}  // namespace

json validity_facts(const json& summary, double mean_diameter, const Configured& keys) {
  json rows = json::array();
  const auto row = [&](const char* key, const char* name, io::Dimension dimension, const std::string& guide,
                       const auto& good) {
    const auto value = results::summary_number(summary, key);
    if (!value) return;
    rows.push_back(
        {{"name", name}, {"value", io::quantity(*value, dimension)}, {"guide", guide}, {"good", good(*value)}});
  };
  const double wanted_transits = keys.number("loading.transits").value_or(15.0);
  const double horizon = keys.number("material.horizon").value_or(3.0);
  // The limits are those of the warnings at the end of a run.
  const auto at_most = [&](const char* key, const char* name, double limit, const char* what = "") {
    row(key, name, io::Dimension::ratio, "at most " + io::quantity(limit, io::Dimension::ratio) + what,
        [limit](double x) { return x <= limit; });
  };
  at_most("energy_residual", "work that the energies do not account for", results::small_energy_residual);
  at_most("kinetic_ratio_at_peak", "kinetic over elastic energy at the first peak", results::small_kinetic_ratio);
  row("transits_before_peak", "wave transits before the first peak", io::Dimension::none,
      fmt::format("at least {}", io::number(wanted_transits)), [&](double x) { return x >= wanted_transits; });
  row("step_margin", "critical time step over the step taken", io::Dimension::none, "above 1",
      [](double x) { return x > 1.0; });
  at_most("impact_ratio", "impact stress over plateau stress", results::honest_impact_ratio, " for claims");
  at_most("max_overlap_in_run", "largest overlap over mean diameter", results::small_overlap);
  const auto wall = results::summary_number(summary, "thinnest_wall");
  if (wall && mean_diameter > 0.0)
    rows.push_back({{"name", "discs across the thinnest wall"},
                    {"value", io::number(*wall / mean_diameter)},
                    {"guide", fmt::format("above {}, two horizons (above {}, the rule)", io::number(2.0 * horizon),
                                          io::number(horizon))},
                    {"good", *wall / mean_diameter > 2.0 * horizon}});
  return rows;
}

Part run_part(const RunResult& run, const RunPartOptions& options) {
  Part part;
  part.facts = {{"block", block_line(run)},
                {"status", run.status},
                {"reason", run.reason},
                {"verdict", verdict_facts(run.summary)},
                {"tables", measure_tables(run.summary)},
                {"history", history_facts(run, part)},
                {"marks", marks_facts(run.summary)},
                {"measured", curve_facts(options.measured)},
                {"cracks", crack_facts(run)},
                {"validity", validity_facts(run.summary, run.mean_diameter, Configured(run.provenance.config))},
                {"warnings", run.summary.value("warnings", json::array())},
                {"command", run.provenance.command_line},
                {"config", run.provenance.config},
                {"program", fmt::format("perfora {} ({}), results_version {}", run.provenance.program_version,
                                        run.provenance.git_revision, run.provenance.results_version)},
                {"seeds", run.provenance.seeds}};
  add_frames(run, options.most_bytes, part);
  return part;
}

}  // namespace perfora::report
