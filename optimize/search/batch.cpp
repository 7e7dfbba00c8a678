// What is here: batches to and from the journal. What is not: the journal (io/journal.h).
#include "optimize/search/batch.h"

#include <algorithm>
#include <cmath>

namespace perfora::optimize {

using nlohmann::json;

namespace {

constexpr double steps = 4096.0;

}  // namespace

json to_json(const Batch& batch, const Study& study) {
  json points = json::array();
  for (const BatchPoint& one : batch.points) {
    std::vector<int> whole;
    for (const double x : one.point) whole.push_back(static_cast<int>(std::lround(x * steps)));
    points.push_back({{"arm", study.arms[static_cast<std::size_t>(one.arm)].name}, {"point", whole}});
  }
  json event = {{"event", "batch"}, {"stage", batch.stage}, {"number", batch.number}, {"points", points}};
  if (batch.tried > 0) event["tried"] = batch.tried;
  if (!batch.keys.empty()) event["keys"] = batch.keys;
  return event;
}

Batch batch_from_json(const json& event, const Study& study) {
  Batch batch{event.at("stage").get<std::string>(),
              event.at("number").get<int>(),
              {},
              event.value("tried", 0),
              event.value("keys", std::vector<std::string>())};
  for (const json& one : event.at("points")) {
    const auto name = one.at("arm").get<std::string>();
    const auto arm = std::find_if(study.arms.begin(), study.arms.end(), [&](const Arm& a) { return a.name == name; });
    const auto whole = one.at("point").get<std::vector<int>>();
    if (arm == study.arms.end() || whole.size() != study.variables.size()) continue;
    BatchPoint& point = batch.points.emplace_back();
    point.arm = static_cast<int>(arm - study.arms.begin());
    for (const int x : whole) point.point.push_back(x / steps);
  }
  return batch;
}

}  // namespace perfora::optimize
