// What is here: a wish to and from the records that name it. What is not: wishes (target.h), verdicts (verdict.h).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "results/target.h"

namespace perfora::results {

/// {"measure": its key, "low", "high"}: SI, null where open.
nlohmann::json to_json(const Wish& wish);
nlohmann::json to_json(std::span<const Wish> wishes);
/// Reads what begins like that. Nothing for a measure of another version of the program. Throws
/// nlohmann::json::exception for anything else.
std::optional<Wish> wish_from_json(const nlohmann::json& object);
/// Those of a list that this version knows.
std::vector<Wish> wishes_from_json(const nlohmann::json& list);

}  // namespace perfora::results
