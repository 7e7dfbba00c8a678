// What is here: sweeps, ensembles and calibrations as facts. What is not: studies (study_part.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text.h"
#include "report/html/campaign_parts.h"
#include "report/sweep_picture.h"
#include "results/json.h"
#include "results/measure_table.h"
#include "results/summary_parts.h"

namespace perfora::report {

using nlohmann::json;

namespace {

json value_facts(const SweepValue& value) {
  return {{"replicates", numbers_or_null(value.replicates)},
          {"mean", results::number(value.mean)},
          {"half", results::number(value.half_interval)}};
}

json point_facts(const SweepPoint& point) {
  json values = json::array();
  for (const SweepValue& value : point.values) values.push_back(value_facts(value));
  return {{"place", point.place}, {"series", point.series}, {"curves", curve_facts(point.curves)}, {"values", values}};
}

/// A row a case: its label, how many runs it has, its measures with half of their intervals, as read.
json case_rows(const results::SweepRecord& record) {
  json rows = json::array();
  for (const results::SweepCase& one : record.cases) {
    json cells = json::array();
    const auto end = one.results.find("final_strain");
    const double final_strain = end == one.results.end() ? NAN : end->second.mean;
    for (const std::string& name : record.measures) {
      const auto found = one.results.find(name);
      const results::Measure* measure = results::measure_called(name);
      const io::Dimension dimension = measure ? measure->dimension : io::Dimension::none;
      const double mean = found == one.results.end() ? NAN : found->second.mean;
      const double half = found == one.results.end() ? NAN : found->second.half_interval;
      const bool reached = !results::still_grows(name, mean, final_strain);
      std::string text = io::quantity(reached ? mean : NAN, dimension, "not reached");
      if (reached && std::isfinite(mean) && std::isfinite(half)) text += " +- " + io::quantity(half, dimension);
      cells.push_back({{"text", text}, {"value", results::number(mean)}});
    }
    rows.push_back({{"label", one.label}, {"can_run", one.can_run}, {"completed", one.completed}, {"results", cells}});
  }
  return rows;
}

double largest_of(const SweepPicture& picture, std::size_t measure) {
  double largest = 0.0;
  const auto look = [&](const SweepPoint& point) {
    if (measure >= point.values.size()) return;
    for (const double value : point.values[measure].replicates)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  };
  for (const SweepGroup& group : picture.groups) std::for_each(group.points.begin(), group.points.end(), look);
  std::for_each(picture.base.begin(), picture.base.end(), look);
  return largest;
}

}  // namespace

Part sweep_part(const results::SweepRecord& record) {
  const SweepPicture picture = sweep_picture(record);
  Part part;
  json measures = json::array(), groups = json::array(), base = json::array();
  for (std::size_t k = 0; k < picture.measures.size(); ++k)
    measures.push_back(column_facts(picture.measures[k], largest_of(picture, k)));
  for (const SweepGroup& group : picture.groups) {
    json points = json::array();
    for (const SweepPoint& point : group.points) points.push_back(point_facts(point));
    groups.push_back({{"label", group.label}, {"places", group.places}, {"series", group.series}, {"points", points}});
  }
  for (const SweepPoint& point : picture.base) base.push_back(point_facts(point));
  part.facts = {{"block", fmt::format("{} case{}, {} replicate{} each; {}", record.cases.size(),
                                      record.cases.size() == 1 ? "" : "s", record.replicates,
                                      record.replicates == 1 ? "" : "s", record.reason)},
                {"measures", measures},
                {"groups", groups},
                {"base", base},
                {"measured", curve_facts(record.measured)},
                {"window", numbers_or_null(record.plateau_window)},
                {"cases", case_rows(record)},
                {"verdict", verdict_facts(record.judged)}};
  return part;
}

Part calibration_part(const results::CalibrationRecord& record) {
  Part part;
  json points = json::array();
  for (const results::CalibrationRecord::Point& point : record.points)
    points.push_back({{"delay", point.rupture_delay},
                      {"shear", point.shear_ratio},
                      {"ratio", results::number(point.strength_ratio)},
                      {"chart", point.of_chart}});
  part.facts = {{"points", points},
                {"wanted", record.wanted ? json(*record.wanted) : json()},
                {"found", record.found ? json(*record.found) : json()}};
  return part;
}

}  // namespace perfora::report
