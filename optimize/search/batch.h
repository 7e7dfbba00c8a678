// What is here: designs that are asked together, as the journal keeps them. What is not: who chooses them (searcher.h,
// map_plan.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "optimize/search/study.h"

namespace perfora::optimize {

/// A point of an arm; coordinates are multiples of 1/4096 (on_grid()).
struct BatchPoint {
  int arm = 0;
  std::vector<double> point;
  bool operator==(const BatchPoint&) const = default;
};

/// Written to the journal before it is run, so that going on needs no choice to be made again, on whatever machine.
struct Batch {
  std::string stage;  ///< "map", "search", "refine", "rank"
  int number = 1;     ///< within the stage
  std::vector<BatchPoint> points;
  int tried = 0;  ///< points looked at for a map's; 0: not counted
  /// Instead of points, of the stage "rank": keys of the first replicates, best first, of as many designs as `number`
  /// says.
  std::vector<std::string> keys = {};
  bool operator==(const Batch&) const = default;
};

/// {"event": "batch", "stage", "number", "points": [{"arm": NAME, "point": [whole numbers over 4096]}]}
nlohmann::json to_json(const Batch& batch, const Study& study);
/// Of such an event; points of arms that the study does not have are left out. Throws nlohmann::json::exception.
Batch batch_from_json(const nlohmann::json& event, const Study& study);

}  // namespace perfora::optimize
