// What is here: evaluations and their parts as JSON: SI, engineering strain, null for what was not reached, never NaN.
// What is not: requests (optimize/evaluate/), records of studies and sweeps.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "results/evaluation.h"

namespace perfora::results {

/// A JSON number, null where it was not reached (NaN or infinite).
nlohmann::json number(double value);

/// schema, status, reason, seeds, results_version: how every record begins.
nlohmann::json record_head(const char* schema, RunStatus status, const std::string& reason,
                           const EffectiveSeeds& seeds);
nlohmann::json to_json(const PackSummary& summary);
nlohmann::json to_json(const Summary& summary);
nlohmann::json to_json(const Performance& performance);
nlohmann::json to_json(const EffectiveSeeds& seeds);
/// schema "perfora.evaluate/1"; `with_curve` adds the columns of its curve that are filled, as arrays.
nlohmann::json to_json(const Evaluation& evaluation, bool with_curve);
/// Throws nlohmann::json::exception or std::invalid_argument for anything but such a record.
Evaluation evaluation_from_json(const nlohmann::json& record);
/// Of the record of a packing or an evaluation; throws alike.
PackSummary pack_summary_from_json(const nlohmann::json& record);

}  // namespace perfora::results
