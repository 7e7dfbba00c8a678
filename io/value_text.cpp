// What is here: values as text. What is not: units, TOML files.
#include "io/value_text.h"

#include <fmt/format.h>

#include <cmath>

namespace perfora::io {
namespace {

constexpr std::size_t longest_shown = 60;

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

std::string in_quotes(std::string_view text) {
  if (text.size() <= longest_shown) return fmt::format("\"{}\"", text);
  std::size_t end = longest_shown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // never cut a UTF-8 character
  return fmt::format("\"{}...\"", text.substr(0, end));
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string shortest(double number) {
  return fmt::format("{}", number);
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

std::string toml_literal(const Value& value, Digits digits) {
  if (const auto* flag = std::get_if<bool>(&value.data)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return fmt::format("{}", *whole);
  if (const auto* number = std::get_if<double>(&value.data))
    return as_float(digits == Digits::all_17 ? fmt::format("{:.17g}", *number) : shortest(*number));
  if (const auto* text = std::get_if<std::string>(&value.data)) return fmt::format("\"{}\"", escaped(*text));
  return list_literal(std::get<ValueList>(value.data), digits);
}

}  // namespace perfora::io
