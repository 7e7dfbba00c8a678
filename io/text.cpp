// What is here: numbers with their unit, values with as many digits as they need. What is not: layout of tables.
#include "io/text.h"

#include <fmt/format.h>

#include <cmath>
#include <variant>

namespace perfora::io {
namespace {

constexpr int kept_digits = 12;

}  // namespace

std::string value_text(const Value& value) {
  struct Visitor {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
    std::string operator()(double number) const { return fmt::format("{:.17g}", number); }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const ValueList& list) const {
      std::string text = "[";
      for (const Value& item : list) text += (text.size() > 1 ? ", " : "") + std::visit(*this, item.data);
      return text + "]";
    }
  };
  return std::visit(Visitor{}, value.data);
}

double rounded(double value) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  return std::stod(fmt::format("{:.{}e}", value, kept_digits - 1));
}

std::string readable(double value, Dimension dimension) {
  switch (dimension) {
    case Dimension::length:
      return fmt::format("{:.5g} mm", 1e3 * value);
    case Dimension::stress:
      return fmt::format("{:.4g} MPa", 1e-6 * value);
    default:
      return fmt::format("{:.5g}", value);
  }
}

std::string readable_stress(double stress) {
  return std::isfinite(stress) ? readable(stress, Dimension::stress) : "none";
}

std::string after_section(const std::string& key) {
  return key.substr(key.find('.') + 1);
}

std::string readable(const Value& value) {
  if (const auto* real = std::get_if<double>(&value.data)) return fmt::format("{:g}", *real);
  const auto* list = std::get_if<ValueList>(&value.data);
  if (!list) return value_text(value);
  std::string text;
  for (const Value& item : *list) text += (text.empty() ? "" : ", ") + readable(item);
  return fmt::format("[{}]", text);
}

}  // namespace perfora::io
