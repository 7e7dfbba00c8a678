// What is here: what the map of a study tells, as plain data with its file map.json: designs, what each reached, what
// is wished. What is not: which designs there are (optimize/search/), drawing (report/).
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "results/statistic.h"
#include "results/sweep_record.h"
#include "results/target.h"

namespace perfora::results {

/// A design of the map with what its replicates gave.
struct MapDesign {
  int number = 0;  ///< from 1
  std::string arm, label;
  std::vector<double> values;                     ///< of the variables, SI
  int completed = 0, failed = 0;                  ///< replicates
  std::string reason;                             ///< of the first failure
  std::map<std::string, Statistic> results = {};  ///< by key of the measure; those that a replicate reached
};

struct MapRecord {
  std::string title;
  std::string fidelity;                ///< name; "": the design as it stands
  int replicates = 1;                  ///< of each design
  int tried = 0;                       ///< points looked at, most of them refused before a run; 0: not known
  std::vector<std::string> variables;  ///< keys
  std::vector<MapDesign> designs;
  std::vector<double> window;  ///< strain, of the plateau; empty: each curve has its own
  std::vector<Wish> wishes;
};

/// schema "perfora.map/1".
nlohmann::json to_json(const MapRecord& record);
/// A row a design: number, arm, variables, runs, then mean and standard deviation of every measure, reason of failure.
std::string map_csv(const MapRecord& record);
/// Reads DIR/map.json. Throws io::InputError.
MapRecord read_map_record(const std::filesystem::path& folder);
/// Its designs as the cases of a sweep, so that two maps are compared as sweeps are.
SweepRecord as_sweep(const MapRecord& record, const std::filesystem::path& folder);

/// Smallest and largest mean of a measure over the designs that completed; count 0: none reached it.
struct MappedRange {
  int designs = 0;
  double low = 0.0, high = 0.0;
};
MappedRange mapped_range(const MapRecord& record, const Measure& measure);

/// A sentence for each wish that no mapped design comes near: "out of the reachable range: plateau stress wished 1.2 to
/// 1.8 MPa, 0.03 to 0.4 MPa mapped with 96 designs". A wish that the range holds may be out of reach all the same,
/// beside the others.
std::vector<std::string> out_of_reach(const MapRecord& record);

}  // namespace perfora::results
