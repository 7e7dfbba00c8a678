// What is here: cases put into groups, places and series. What is not: drawing.
#include "report/sweep_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "results/statistic.h"

namespace perfora::report {
namespace {

/// Number of `text` in `list`, appended where it is new.
int place_of(std::vector<std::string>& list, const std::string& text) {
  const auto found = std::find(list.begin(), list.end(), text);
  if (found != list.end()) return static_cast<int>(found - list.begin());
  list.push_back(text);
  return static_cast<int>(list.size()) - 1;
}

SweepPoint point_of(const results::SweepRecord& record, const results::SweepCase& one) {
  SweepPoint point;
  for (const results::CaseRun& run : one.runs)
    if (run.completed) point.curves.push_back(run.curve);
  for (const std::string& name : record.measures) {
    SweepValue value;
    for (const results::CaseRun& run : one.runs)
      if (const auto found = run.results.find(name); run.completed && found != run.results.end())
        value.replicates.push_back(found->second);
    const results::Statistic statistic = results::statistic_of(name, value.replicates);
    value.mean = statistic.mean;
    value.half_interval = statistic.confidence_95;
    point.values.push_back(std::move(value));
  }
  return point;
}

}  // namespace

SweepPicture sweep_picture(const results::SweepRecord& record) {
  SweepPicture picture;
  picture.title = record.title;
  if (const auto verdict = record.judged.find("verdict"); verdict != record.judged.end() && verdict->is_object()) {
    picture.verdict = verdict->value("text", "");
    picture.outcome = verdict->value("outcome", "");
  }
  picture.measures = record.measures;
  picture.measured = record.measured;
  picture.wishes = record.wishes;
  std::vector<std::string> groups;
  for (const results::SweepCase& one : record.cases) {
    if (!one.can_run) continue;
    if (one.number == 0) {
      picture.base.push_back(point_of(record, one));
      continue;
    }
    const auto g = static_cast<std::size_t>(place_of(groups, one.group));
    if (g == picture.groups.size()) picture.groups.emplace_back();
    SweepGroup& group = picture.groups[g];
    group.label = one.axis;
    SweepPoint point = point_of(record, one);
    point.place = place_of(group.places, one.place);
    point.series = place_of(group.series, one.series);
    group.points.push_back(std::move(point));
  }
  const auto base =
      std::find_if(record.cases.begin(), record.cases.end(), [](const auto& one) { return one.number == 0; });
  picture.subtitle = fmt::format(
      "{} case{}, {} replicate{} each; {}. Large: mean and its 95 % interval; small: replicates{}", record.cases.size(),
      record.cases.size() == 1 ? "" : "s", record.replicates, record.replicates == 1 ? "" : "s", record.reason,
      base != record.cases.end() ? "; grey: the design itself" : "");
  return picture;
}

}  // namespace perfora::report
