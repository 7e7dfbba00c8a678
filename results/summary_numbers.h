// What is here: single numbers of the JSON summary that a file holds. What is not: the whole summary (json.h).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

namespace perfora::results {

/// A number of a summary (also of its objects `summary` and `pack`), std::nullopt where the key is missing or null (not
/// reached).
std::optional<double> summary_number(const nlohmann::json& summary, std::string_view key);

/// The plateau window (start, end; engineering strain), std::nullopt where the summary has none.
std::optional<std::pair<double, double>> plateau_window(const nlohmann::json& summary);

}  // namespace perfora::results
