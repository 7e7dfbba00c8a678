// What is here: what every part of a report's page is made of: facts as JSON, packed numbers by name, and the words
// that several parts share. What is not: the parts (run_part.h, campaign_parts.h), the page (page.h).
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/schema.h"
#include "results/curve.h"

namespace perfora::report {

/// Facts that the page shows, and numbers under the names by which the facts refer to them (packed.h).
struct Part {
  nlohmann::json facts = nlohmann::json::object();
  std::map<std::string, std::string> numbers;
};

/// {outcome, text, note, blocks (how many single blocks keep every wish, in words; empty of one run), wishes:
/// [{outcome, text, measure, low, high}]} of a summary; null where nothing is wished.
nlohmann::json verdict_facts(const nlohmann::json& summary);
/// Rows [label, value] of the measures that the summary holds, by their group: {title, rows}.
nlohmann::json measure_tables(const nlohmann::json& summary);
/// {name, strain, stress} each; not finite numbers are left out.
nlohmann::json curve_facts(std::span<const results::Curve> curves);
/// A list of numbers, null where they are not finite.
nlohmann::json numbers_or_null(std::span<const double> values);

/// Numbers and texts of a resolved configuration (TOML) by their keys; nothing where it has none, or cannot be read.
class Configured {
 public:
  explicit Configured(const std::string& toml);
  std::optional<double> number(const std::string& key) const;
  std::string text(const std::string& key) const;

 private:
  std::map<std::string, io::Value> values_;
};

}  // namespace perfora::report
