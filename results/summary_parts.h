// What is here: what the summary of every schema is put together from: reading JSON that may be damaged, aligned lines.
// What is not: the summaries (summary_text.h).
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>

#include "results/summary_labels.h"

namespace perfora::results {

/// A JSON object lacks what its schema has; caught by summary_text(), which knows the file.
struct DamagedSummary : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A number of an object; NaN where there is none.
double number_in(const nlohmann::json& object, const std::string& key);
/// A text of an object; `otherwise` where there is none.
std::string text_in(const nlohmann::json& object, const std::string& key, const std::string& otherwise = "");
/// An object or a list within an object, an empty one where there is none or null. Throws DamagedSummary where it is
/// something else.
const nlohmann::json& object_in(const nlohmann::json& object, const std::string& key);
const nlohmann::json& list_in(const nlohmann::json& object, const std::string& key);
/// The same of parts without which there is nothing to show: also throws where they are missing.
const nlohmann::json& required_object(const nlohmann::json& object, const std::string& key);
const nlohmann::json& required_list(const nlohmann::json& object, const std::string& key);
/// A list of two numbers within an object; NaN where there is none.
struct Pair {
  double first, second;
  bool known() const;
};
Pair pair_in(const nlohmann::json& object, const std::string& key);

/// Whether a strain of largest efficiency (a measure, or its mean over runs) lies at the end of the run: efficiency
/// still grows there, and summaries read "not reached".
bool still_grows(std::string_view key, double value, double final_strain);

/// "  label      value\n".
std::string line_text(std::string_view label, const std::string& value);
/// One line for each key that the object has, below a title; nothing where it has none. null reads "not reached".
std::string lines_text(std::string_view title, const nlohmann::json& object, std::span<const Label> labels);

}  // namespace perfora::results
