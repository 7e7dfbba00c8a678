// What is here: ranges in words, the resolved configuration as TOML, the printed reference.
// What is not: setting values (schema_keys.cpp).
#include <fmt/format.h>

#include <cmath>

#include "io/schema.h"
#include "io/text.h"
#include "io/units.h"

namespace perfora::io {
namespace {

std::string type_text(const Key& key) {
  const std::string unit(si_unit(key.dimension));
  const std::string in_unit = unit.empty() ? "" : fmt::format(", {}", unit);
  switch (key.type) {
    case KeyType::real:
      return (key.dimension == Dimension::ratio ? "ratio" : "number") + in_unit;
    case KeyType::integer:
      return "whole number";
    case KeyType::boolean:
      return "true or false";
    case KeyType::text:
      return "text";
    case KeyType::choice:
      return "choice";
    case KeyType::path:
      return "path";
    case KeyType::real_list:
      return "list of numbers" + in_unit;
    case KeyType::real_rows:
      return "list of rows of numbers" + in_unit;
  }
  return {};
}

std::string allowed_text(const Key& key) {
  if (key.type == KeyType::choice) return fmt::format("`{}`", fmt::join(key.choices, "`, `"));
  const bool bounded = std::isfinite(key.range.low) || std::isfinite(key.range.high);
  return bounded ? key.range.text() : "";
}

std::string table_cell(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += c == '\n' ? ' ' : c;
  }
  return cell;
}

}  // namespace

bool Range::contains(double value) const {
  if (std::isnan(value)) return false;
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return above && below;
}

std::string Range::text() const {
  const bool bounded_below = std::isfinite(low), bounded_above = std::isfinite(high);
  if (!bounded_below && !bounded_above) return "any finite number";
  if (bounded_below && bounded_above && !low_open && !high_open)
    return fmt::format("{} to {}", shortest(low), shortest(high));
  std::string words;
  if (bounded_below) words = fmt::format("{} {}", low_open ? "greater than" : "at least", shortest(low));
  if (bounded_above)
    words += fmt::format("{}{} {}", words.empty() ? "" : " and ", high_open ? "less than" : "at most", shortest(high));
  return words;
}

bool Key::at_default() const {
  return toml_literal(get(), Digits::shortest) == default_text;
}

std::string Schema::toml(Names names, bool changed_only) const {
  // What identities are made of stays as it always was written; people and files get the shortest form.
  const Digits digits = names == Names::first ? Digits::all_17 : Digits::shortest;
  std::string text, section;
  for (const auto& [name, help] : sections_)
    for (const Key& key : keys_) {
      if (key.section != name || ((changed_only || key.only_where_set) && key.at_default())) continue;
      const std::string written = names == Names::first ? first_name(key.full_name()) : key.full_name();
      const std::size_t dot = written.rfind('.');
      if (text.empty() || written.substr(0, dot) != section) {
        section = written.substr(0, dot);
        text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", section);
      }
      text += fmt::format("{} = {}\n", written.substr(dot + 1), toml_literal(key.get(), digits));
    }
  return text;
}

std::string Schema::to_toml(Names names) const {
  return toml(names, false);
}

std::string Schema::changed_toml(Names names) const {
  return toml(names, true);
}

std::string Schema::reference() const {
  std::string text;
  for (const auto& [section, help] : sections_) {
    text +=
        fmt::format("{}## [{}]\n\n{}\n\n| key | type, SI unit | default | allowed | what |\n|---|---|---|---|---|\n",
                    text.empty() ? "" : "\n", section, help);
    for (const Key& key : keys_) {
      if (key.section != section) continue;
      text += fmt::format("| `{}` | {} | `{}` | {} | {} |\n", key.name, type_text(key), table_cell(key.default_text),
                          table_cell(allowed_text(key)), table_cell(key.help));
    }
  }
  return text;
}

}  // namespace perfora::io
