// What is here: the units of each dimension and how "20 mm" becomes 0.02.
// What is not: the keys that have a dimension (each room's own options).
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>

#include "io/letters.h"
#include "io/schema.h"
#include "io/text.h"
#include "io/units.h"

namespace perfora::io {
namespace {

/// SI value = number x 10^exponent x factor. The power of ten goes into the decimal text before it is rounded,
/// so that "5.04 mm" and 5.04e-3 have the same bits.
struct Unit {
  std::string_view name;
  int exponent = 0;
  double factor = 1.0;
  bool listed = true;  ///< false: accepted, but left out of messages
};

constexpr Unit ratio_units[] = {{"%", -2}};
constexpr Unit length_units[] = {{"m", 0}, {"cm", -2}, {"mm", -3}, {"um", -6}, {"nm", -9}, {"in", -3, 25.4, false}};
constexpr Unit area_units[] = {{"m2", 0}, {"cm2", -4}, {"mm2", -6}};
constexpr Unit stress_units[] = {
    {"Pa", 0},
    {"kPa", 3},
    {"MPa", 6},
    {"GPa", 9},
    {"N/m2", 0, 1.0, false},
    {"N/mm2", 6, 1.0, false},
    {"bar", 5, 1.0, false},
    {"psi", 0, 6894.757293168361, false}};  // 1 lbf/in2: 0.45359237 kg x 9.80665 m/s2 / (25.4 mm)2
constexpr Unit stiffness_units[] = {{"N/m", 0}, {"kN/m", 3}, {"MN/m", 6}, {"N/mm", 3}, {"kN/mm", 6, 1.0, false}};
constexpr Unit density_units[] = {{"kg/m3", 0}, {"g/cm3", 3}, {"t/m3", 3}};
constexpr Unit time_units[] = {{"s", 0}, {"ms", -3}, {"us", -6}, {"min", 0, 60.0}, {"h", 0, 3600.0}};
constexpr Unit rate_units[] = {{"1/s", 0},
                               {"/s", 0},
                               {"%/s", -2},
                               {"1/min", 0, 1.0 / 60.0},
                               {"/min", 0, 1.0 / 60.0, false},
                               {"s-1", 0, 1.0, false}};
constexpr Unit angle_units[] = {
    {"rad", 0}, {"deg", 0, std::numbers::pi / 180.0}, {"\u00b0", 0, std::numbers::pi / 180.0, false}};
constexpr Unit energy_density_units[] = {{"J/m3", 0}, {"kJ/m3", 3}, {"MJ/m3", 6}, {"GJ/m3", 9}};
constexpr Unit surface_energy_units[] = {{"mJ/m2", -3}, {"J/m2", 0}, {"kJ/m2", 3}, {"MJ/m2", 6}};
constexpr Unit memory_units[] = {{"B", 0}, {"kB", 3}, {"MB", 6}, {"GB", 9}, {"TB", 12}};

struct DimensionFacts {
  std::string_view name;  ///< "a length"
  std::string_view si;
  std::string_view example;
  std::span<const Unit> units;
};

DimensionFacts facts(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return {"a plain number", "", "", {}};
    case Dimension::ratio:
      return {"a ratio", "", "25 %", ratio_units};
    case Dimension::length:
      return {"a length", "m", "20 mm", length_units};
    case Dimension::area:
      return {"an area", "m2", "400 mm2", area_units};
    case Dimension::stress:
      return {"a stress", "Pa", "2 MPa", stress_units};
    case Dimension::stiffness:
      return {"a stiffness", "N/m", "2.195e7 N/m", stiffness_units};
    case Dimension::density:
      return {"a density", "kg/m3", "2200 kg/m3", density_units};
    case Dimension::time:
      return {"a time", "s", "5 ms", time_units};
    case Dimension::rate:
      return {"a rate", "1/s", "0.5 1/s", rate_units};
    case Dimension::angle:
      return {"an angle", "rad", "30 deg", angle_units};
    case Dimension::count:
      return {"a count", "", "", {}};
    case Dimension::energy_density:
      return {"an energy density", "J/m3", "7 kJ/m3", energy_density_units};
    case Dimension::surface_energy:
      return {"an energy per area", "J/m2", "60 J/m2", surface_energy_units};
    case Dimension::memory:
      return {"a memory", "B", "25 MB", memory_units};
  }
  return {};
}

/// One spelling for m^2, m² and "m 2"; micro sign and Greek mu both become u.
std::string plain_unit(std::string_view written) {
  constexpr std::pair<std::string_view, std::string_view> spellings[] = {
      {" ", ""}, {"\t", ""}, {"^", ""}, {"\u00b2", "2"}, {"\u00b3", "3"}, {"\u00b5", "u"}, {"\u03bc", "u"}};
  std::string unit;
  while (!written.empty()) {
    std::string_view from = written.substr(0, 1), to = from;
    for (const auto& [other, plain] : spellings)
      if (written.substr(0, other.size()) == other) {
        from = other;
        to = plain;
      }
    unit.append(to);
    written.remove_prefix(from.size());
  }
  return unit;
}

/// A decimal number at the front of a text, cut in its parts.
struct Decimal {
  std::string mantissa;  ///< sign and digits as std::from_chars takes them
  int exponent = 0;
  std::size_t length = 0;  ///< characters used; 0: there is no number
  bool exponent_too_large = false;
};

std::size_t skip_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
  return at;
}

Decimal leading_decimal(std::string_view text) {
  Decimal result;
  std::size_t start = 0;
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) start = 1;
  std::size_t end = skip_digits(text, start);
  std::size_t digits = end - start;
  if (end < text.size() && text[end] == '.') {
    const std::size_t after = skip_digits(text, end + 1);
    digits += after - end - 1;
    end = after;
  }
  if (digits == 0) return result;
  result.mantissa = text.substr(text[0] == '+' ? 1 : 0, end - (text[0] == '+' ? 1 : 0));
  result.length = end;
  if (end >= text.size() || (text[end] != 'e' && text[end] != 'E')) return result;
  std::size_t sign = end + 1;
  if (sign < text.size() && (text[sign] == '+' || text[sign] == '-')) ++sign;
  const std::size_t stop = skip_digits(text, sign);
  if (stop == sign) return result;
  const std::size_t first = text[end + 1] == '+' ? end + 2 : end + 1;
  const auto [end_of_number, error] = std::from_chars(text.data() + first, text.data() + stop, result.exponent);
  (void)end_of_number;
  result.exponent_too_large = error != std::errc{} || std::abs(result.exponent) > 100000;
  result.length = stop;
  return result;
}

[[noreturn]] void refuse_number(const std::string& what, const Origin& origin) {
  throw InputError(origin, what, "a finite number up to about 1e308 in size is wanted", "correct the value");
}

double scaled(const Decimal& decimal, const Unit& unit, std::string_view written, const Origin& origin) {
  double number = 0.0;
  std::errc error = std::errc::result_out_of_range;
  if (!decimal.exponent_too_large) {
    const std::string text = fmt::format("{}e{}", decimal.mantissa, decimal.exponent + unit.exponent);
    error = std::from_chars(text.data(), text.data() + text.size(), number).ec;
  }
  number *= unit.factor;
  if (error != std::errc{} || !std::isfinite(number))
    refuse_number(in_quotes(written) + " is too large or too small for a number", origin);
  return number;
}

std::string wanted(const DimensionFacts& dimension) {
  if (dimension.units.empty()) return "a plain number is wanted";
  return fmt::format("{} is wanted: a number{} or a text such as \"{}\"", dimension.name,
                     dimension.si.empty() ? "" : fmt::format(" in {}", dimension.si), dimension.example);
}

double parse_text(const std::string& written, Dimension dimension, const Origin& origin) {
  const DimensionFacts known = facts(dimension);
  const std::string_view text = trimmed(written);
  const Decimal decimal = leading_decimal(text);
  if (decimal.length == 0 || known.units.empty())
    throw InputError(origin, fmt::format("found the text {}", in_quotes(written)), wanted(known),
                     known.units.empty() ? "write the number without quotes" : "");
  const std::string unit = plain_unit(text.substr(decimal.length));
  if (unit.empty()) {
    if (dimension == Dimension::ratio) return scaled(decimal, {}, text, origin);
    throw InputError(origin, fmt::format("the text {} has no unit", in_quotes(written)),
                     fmt::format("units of {} are {}", known.name, accepted_units(dimension)),
                     fmt::format("add one, or write the number without quotes for {}", known.si));
  }
  for (const Unit& candidate : known.units)
    if (candidate.name == unit) return scaled(decimal, candidate, text, origin);
  if (unit.front() == ',')
    throw InputError(origin, fmt::format("{} has a comma", in_quotes(written)), "",
                     text.find_first_not_of("0123456789.,+-eE ") == std::string_view::npos
                         ? fmt::format("write a decimal point, or a list in brackets: [{}]", text)
                         : "write a decimal point");
  if (unit.find(',') != std::string::npos)
    throw InputError(origin, fmt::format("{} has a comma", in_quotes(written)), "",
                     "a list stands in brackets, its texts in quotes: [\"5 mm\", \"3 mm\"]");
  std::vector<std::string> names;
  for (const Unit& candidate : known.units) names.emplace_back(candidate.name);
  const std::string nearest = nearest_name(unit, names);
  throw InputError(
      origin,
      fmt::format("{} in {} is no unit of {}", in_quotes(trimmed(text.substr(decimal.length))), in_quotes(written),
                  known.name),
      fmt::format("accepted are {}{}", accepted_units(dimension), dimension == Dimension::ratio ? " or no unit" : ""),
      nearest.empty() ? "" : fmt::format("did you mean \"{}\"?", nearest));
}

}  // namespace

double parse_quantity(const Value& value, Dimension dimension, const Origin& origin) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value.data)) {
    if (!std::isfinite(*number)) refuse_number("is " + shortest(*number), origin);
    return *number;
  }
  if (const auto* text = std::get_if<std::string>(&value.data)) return parse_text(*text, dimension, origin);
  throw InputError(origin, "found " + describe_value(value), wanted(facts(dimension)));
}

std::string_view si_unit(Dimension dimension) {
  return facts(dimension).si;
}

std::string_view dimension_name(Dimension dimension) {
  if (dimension == Dimension::none) return "";
  const std::string_view with_article = facts(dimension).name;
  return with_article.substr(with_article.find(' ') + 1);
}

std::string_view example_of(Dimension dimension) {
  return facts(dimension).example;
}

bool is_unit(std::string_view unit, Dimension dimension) {
  const std::string plain = plain_unit(unit);
  const std::span<const Unit> units = facts(dimension).units;
  return std::any_of(units.begin(), units.end(), [&plain](const Unit& known) { return known.name == plain; });
}

std::string accepted_units(Dimension dimension) {
  std::vector<std::string> names;
  for (const Unit& unit : facts(dimension).units)
    if (unit.listed) names.emplace_back(unit.name);
  return joined(names);
}

}  // namespace perfora::io
