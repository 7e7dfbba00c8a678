// What is here: numbers read by std::from_chars, which knows no locale. What is not: their units (units.cpp).
#include "io/numbers.h"

#include <charconv>

namespace perfora::io {

std::optional<double> take_number(std::string_view& text) {
  std::string_view digits = text;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{}) return std::nullopt;
  text = digits.substr(static_cast<std::size_t>(end - digits.data()));
  return number;
}

std::optional<double> number_from(std::string_view text) {
  const std::optional<double> number = take_number(text);
  return text.empty() ? number : std::nullopt;
}

}  // namespace perfora::io
