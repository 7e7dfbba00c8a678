// What is here: labels of cases taken apart. What is not: how labels are made (optimize/campaign/sweep.h).
#include "results/sweep_places.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "io/text.h"
#include "results/campaign_folder.h"
#include "results/sweep_record.h"

namespace perfora::results {
namespace {

using nlohmann::json;

/// What is known of a sweep's table.
struct Table {
  std::string grid_key;                           ///< that runs along x; empty without a grid
  std::vector<std::pair<std::string, int>> each;  ///< keys of [each] and how many values they have; the last cases
  bool known = false;
};

/// Parts of a label: "short name value, short name value"; commas within brackets belong to a value.
std::vector<std::string> parts_of(const std::string& label) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (std::size_t k = 0; k < label.size(); ++k) {
    depth += label[k] == '[' ? 1 : label[k] == ']' ? -1 : 0;
    if (depth == 0 && label.compare(k, 2, ", ") == 0) {
      parts.emplace_back();
      ++k;
    } else {
      parts.back() += label[k];
    }
  }
  return parts;
}

/// The value in a part that begins with the name of `key`.
std::optional<std::string> value_in(const std::string& part, const std::string& key) {
  const std::string start = io::after_section(key) + " ";
  if (!part.starts_with(start)) return std::nullopt;
  return part.substr(start.size());
}

/// The key that a part names.
std::string key_of(const std::string& part, const std::vector<std::string>& columns) {
  for (const std::string& key : columns)
    if (value_in(part, key)) return key;
  return {};
}

Table table_of_journal(const SweepRecord& record) {
  Table table;
  for (const json& event : journal_events(record.folder)) {
    if (event.value("event", "") != "sweep" || !event.contains("grid_key")) continue;
    table.grid_key = event.at("grid_key").get<std::string>();
    table.each = event.at("each").get<std::vector<std::pair<std::string, int>>>();
    table.known = true;
  }
  return table;
}

void place_on_grid(SweepCase& one, const std::string& key) {
  std::vector<std::string> parts = parts_of(one.label);
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    const std::optional<std::string> value = value_in(*part, key);
    if (!value) continue;
    one.axis = key;
    one.place = *value;
    parts.erase(std::next(part).base());
    one.series.clear();
    for (const std::string& rest : parts) one.series += (one.series.empty() ? "" : ", ") + rest;
    return;
  }
  one.place = one.label;
}

void place_in_group(SweepCase& one, const std::string& key) {
  one.group = one.axis = key;
  one.place = value_in(one.label, key).value_or(one.label);
}

/// Cases whose label is one value of one key count as [each]; where labels end in a value of one key and some differ in
/// nothing else, that key is a grid's.
Table guessed(const SweepRecord& record, const std::vector<std::string>& columns) {
  Table table;
  std::map<std::string, std::map<std::string, int>> series;  // by last key: how often the rest of a label appears
  for (const SweepCase& one : record.cases) {
    const std::vector<std::string> parts = parts_of(one.label);
    const std::string key = key_of(parts.back(), columns);
    if (one.number == 0 || parts.size() < 2 || key.empty()) continue;
    ++series[key][one.label.substr(0, one.label.size() - parts.back().size())];
  }
  for (const auto& [key, rests] : series)
    if (std::any_of(rests.begin(), rests.end(), [](const auto& rest) { return rest.second > 1; })) table.grid_key = key;
  return table;
}

}  // namespace

void place_cases(SweepRecord& record, const std::vector<std::string>& columns) {
  Table table = table_of_journal(record);
  const bool told = table.known;
  if (!told) table = guessed(record, columns);
  int last = 0, of_each = 0;
  for (const SweepCase& one : record.cases) last = std::max(last, one.number);
  for (const auto& [key, count] : table.each) of_each += count;
  for (SweepCase& one : record.cases) {
    one.group.clear();
    if (one.number == 0) continue;
    std::string of_group;
    int place = one.number - (last - of_each);  // among those of [each], from 1
    for (const auto& [key, count] : table.each) {
      if (place > 0 && place <= count) of_group = key;
      place -= count;
    }
    if (!told && parts_of(one.label).size() == 1) of_group = key_of(one.label, columns);
    if (!of_group.empty())
      place_in_group(one, of_group);
    else if (!table.grid_key.empty())
      place_on_grid(one, table.grid_key);
    else
      one.place = one.label;
  }
}

}  // namespace perfora::results
