// What is here: the summaries that are tables: replicates of an ensemble, cases of a sweep, targets of a calibration,
// the stiffness of a block. What is not: summaries of a number a line (summary_text.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace perfora::results {

/// A line a measure, with its scatter over the replicates. `statistics` of perfora.ensemble/1.
std::string statistics_table(const nlohmann::json& statistics);
/// A line a case: number, label, completed runs, the results that the sweep shows with half of their 95 % interval and,
/// where there is a case 0, their change to it. `sweep` is perfora.sweep/1.
std::string sweep_table(const nlohmann::json& sweep);
/// A line a deviation and wish: outcome, mean with its interval, paired change. perfora.tolerance/1.
std::string tolerance_table(const nlohmann::json& tolerance);
/// What was wanted of a material, and what was reached. `targets` of perfora.calibrate/1.
std::string targets_table(const nlohmann::json& targets);
/// The stiffness as three lines of a matrix, in one unit; nothing where it is not known. `stiffness` of
/// perfora.elastic/1.
std::string stiffness_table(const nlohmann::json& stiffness);

}  // namespace perfora::results
