// What is here: what a tolerance analysis leaves behind beside the tables of its sweep: per deviation and wish the
// change and whether the wish still holds. What is not: its words (results/summary_tables.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "optimize/campaign/sweep_run.h"
#include "optimize/campaign/tolerance.h"

namespace perfora::optimize {

/// schema "perfora.tolerance/1". SI; null for what is not known. A change is that of a block to the undisturbed one of
/// the same seeds; its interval is Student's t over the blocks, 95 %.
nlohmann::json to_json(const Tolerance& tolerance, const SweepRun& run);

/// A row a deviation and wish: outcome, mean and interval of the wished measure, change and half width of its interval.
std::string tolerance_csv(const nlohmann::json& record);

/// Writes tolerance.json and tolerance.csv into the folder of the run, each whole.
void write_results(const Tolerance& tolerance, const SweepRun& run);

}  // namespace perfora::optimize
