// What is here: numbers with their unit, values with as many digits as they need. What is not: layout of tables.
#include "io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <variant>

#include "io/numbers.h"
#include "io/units.h"

namespace perfora::io {
namespace {

constexpr int significant_digits = 4;
constexpr int kept_digits = 12;
constexpr std::size_t longest_shown = 60;
/// From here on a plain number has its thousands separated, from there on an exponent.
constexpr double four_digits = 1e4, too_long = 1e6;

/// Powers of ten a dimension is printed with: SI prefixes from `lowest` to `highest`.
struct Prefixes {
  int lowest = 0, highest = 0;
};

Prefixes prefixes_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::length:
    case Dimension::time:
      return {-9, 0};
    case Dimension::stress:
    case Dimension::stiffness:
    case Dimension::energy_density:
      return {0, 9};
    case Dimension::surface_energy:
      return {-3, 6};
    case Dimension::memory:
      return {0, 12};
    default:
      return {};
  }
}

std::string_view prefix_name(int exponent) {
  switch (exponent) {
    case -9:
      return "n";
    case -6:
      return "u";
    case -3:
      return "m";
    case 3:
      return "k";
    case 6:
      return "M";
    case 9:
      return "G";
    case 12:
      return "T";
    default:
      return "";
  }
}

/// A finite number rounded to four significant digits, in decimal: its power of ten is known without a logarithm.
struct Rounded {
  std::string mantissa;  ///< "-1.234"
  int exponent = 0;

  explicit Rounded(double value) {
    const std::string text = fmt::format("{:.{}e}", value, significant_digits - 1);
    const std::size_t e = text.find('e');
    mantissa = text.substr(0, e);
    exponent = std::atoi(text.c_str() + e + 1);
  }
  /// The number times 10^-unit, nearest double.
  double in(int unit) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return number_from(fmt::format("{}e{}", mantissa, exponent - unit)).value_or(exponent > unit ? infinity : 0.0);
  }
};

std::string infinity_text(double value) {
  return value > 0.0 ? "infinity" : "-infinity";
}

/// Without unit: a number that has four significant digits already.
std::string plain(double value) {
  if (std::abs(value) >= four_digits && std::abs(value) < too_long) return count(value);
  return fmt::format("{:.{}g}", value == 0.0 ? 0.0 : value, significant_digits);  // no "-0"
}

std::string without_name(double value, int exponent, std::string_view none) {
  if (std::isnan(value)) return std::string(none);
  if (std::isinf(value)) return infinity_text(value);
  return plain(Rounded(value).in(exponent));
}

std::string with_name(std::string number, const PrintUnit& unit) {
  return unit.name.empty() ? number : std::move(number) + " " + unit.name;
}

constexpr std::string_view degrees = "deg";

/// Angles are stored in radians and read in degrees, the only unit that is no power of ten.
double as_printed(double value, const PrintUnit& unit) {
  return unit.name == degrees ? value * 180.0 / std::numbers::pi : value;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (code < 0x20 || code == 0x7f)
      result += fmt::format("\\u{:04X}", code);
    else
      result += c;
  }
  return result;
}

/// TOML tells a float from a whole number by its point or exponent.
std::string as_float(std::string text) {
  return text.find_first_of(".eEn") == std::string::npos ? text + ".0" : text;
}

bool is_rows(const ValueList& list) {
  return list.size() > 1 && std::holds_alternative<ValueList>(list.front().data);
}

std::string list_literal(const ValueList& list, Digits digits) {
  const bool rows = is_rows(list);
  std::string text = rows ? "[\n" : "[";
  for (std::size_t k = 0; k < list.size(); ++k) {
    text += (rows ? "  " : "") + toml_literal(list[k], digits);
    if (k + 1 < list.size() || rows) text += rows ? ",\n" : ", ";
  }
  return text + "]";
}

}  // namespace

PrintUnit unit_for(double largest, Dimension dimension) {
  if (dimension == Dimension::ratio) return {"%", -2};
  if (dimension == Dimension::angle) return {std::string(degrees), 0};
  const Prefixes prefixes = prefixes_of(dimension);
  const bool sized = std::isfinite(largest) && largest != 0.0;
  const int power = sized ? Rounded(largest).exponent : 0;
  if (dimension == Dimension::area && sized && power < 0) return {"mm2", -6};
  int exponent = prefixes.lowest;
  while (exponent + 3 <= std::min(power, prefixes.highest)) exponent += 3;
  return {fmt::format("{}{}", prefix_name(exponent), si_unit(dimension)), exponent};
}

std::string in_unit(double value, const PrintUnit& unit, std::string_view none) {
  std::string text = without_name(as_printed(value, unit), unit.exponent, none);
  return std::isfinite(value) ? with_name(std::move(text), unit) : text;
}

double scale_of(const PrintUnit& unit) {
  return as_printed(number_from(fmt::format("1e{}", -unit.exponent)).value(), unit);
}

std::string quantity(double value, Dimension dimension, std::string_view none) {
  if (dimension == Dimension::count) return count(value, none);
  return in_unit(value, unit_for(value, dimension), none);
}

std::string quantities(const std::vector<double>& values, Dimension dimension, std::string_view between,
                       std::string_view none) {
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  const PrintUnit unit = unit_for(largest, dimension);
  std::string text;
  bool any = false;
  for (const double& value : values) {
    if (&value != values.data()) text += between;
    text += without_name(as_printed(value, unit), unit.exponent, none);
    any = any || std::isfinite(value);
  }
  return any ? with_name(std::move(text), unit) : text;
}

std::string number(double value, std::string_view none) {
  return without_name(value, 0, none);
}

std::string count(double value, std::string_view none) {
  if (std::isnan(value)) return std::string(none);
  if (std::isinf(value)) return infinity_text(value);
  std::string digits = fmt::format("{:.0f}", std::abs(value));
  const bool negative = value < 0.0 && digits != "0";
  for (auto k = static_cast<std::ptrdiff_t>(digits.size()) - 3; k > 0; k -= 3)
    digits.insert(static_cast<std::size_t>(k), 1, ',');
  return negative ? "-" + digits : digits;
}

std::string duration(double seconds) {
  constexpr long long minute = 60, hour = 60 * minute, day = 24 * hour;
  constexpr double in_words = 10.0, year = 365.0 * static_cast<double>(day);
  if (!(seconds >= 0.0)) return "unknown time";
  if (seconds > year) return "more than a year";  // an estimate that long says no more
  if (seconds < in_words)                         // times are measured and estimated to two digits at best
    return quantity(number_from(fmt::format("{:.1e}", seconds)).value_or(0.0), Dimension::time);
  const long long whole = std::llround(seconds);
  if (whole < minute) return fmt::format("{} s", whole);
  if (whole < hour) return fmt::format("{} min {:02} s", whole / minute, whole % minute);
  if (whole < day) return fmt::format("{} h {:02} min", whole / hour, whole % hour / minute);
  return fmt::format("{} d {} h", whole / day, whole % day / hour);
}

std::string readable(const Value& value, std::size_t most_items) {
  if (const auto* real = std::get_if<double>(&value.data)) return fmt::format("{:g}", *real);
  const auto* list = std::get_if<ValueList>(&value.data);
  if (!list) return value_text(value);
  if (list->size() > most_items) return fmt::format("[{} values]", list->size());
  std::string text;
  for (const Value& item : *list) text += (text.empty() ? "" : ", ") + readable(item, most_items);
  return fmt::format("[{}]", text);
}

double rounded(double value) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  return number_from(fmt::format("{:.{}e}", value, kept_digits - 1)).value_or(value);
}

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

std::string shortest(double number) {
  return fmt::format("{}", number);
}

std::string toml_literal(const Value& value, Digits digits) {
  if (const auto* flag = std::get_if<bool>(&value.data)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return fmt::format("{}", *whole);
  if (const auto* number = std::get_if<double>(&value.data))
    return as_float(digits == Digits::all_17 ? fmt::format("{:.17g}", *number) : shortest(*number));
  if (const auto* text = std::get_if<std::string>(&value.data)) return fmt::format("\"{}\"", escaped(*text));
  return list_literal(std::get<ValueList>(value.data), digits);
}

std::string describe_value(const Value& value) {
  if (const auto* flag = std::get_if<bool>(&value.data))
    return *flag ? "the truth value true" : "the truth value false";
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return fmt::format("the whole number {}", *whole);
  if (const auto* number = std::get_if<double>(&value.data)) return "the number " + shortest(*number);
  if (const auto* text = std::get_if<std::string>(&value.data)) return "the text " + in_quotes(*text);
  const std::size_t size = std::get<ValueList>(value.data).size();
  if (size == 0) return "an empty list";
  return fmt::format("a list of {} {}", size, size == 1 ? "value" : "values");
}

std::string in_quotes(std::string_view text) {
  if (text.size() <= longest_shown) return fmt::format("\"{}\"", text);
  return fmt::format("\"{}...\"", beginning(text, longest_shown));
}

std::string_view beginning(std::string_view text, std::size_t most_bytes) {
  if (text.size() <= most_bytes) return text;
  std::size_t end = most_bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end);
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string after_section(const std::string& key) {
  return key.substr(key.find('.') + 1);
}

}  // namespace perfora::io
