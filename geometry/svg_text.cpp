// What is here: numbers, lengths and transforms of SVG. What is not: path data (svg_path.cpp).
#include "geometry/svg_text.h"

#include <cmath>
#include <numbers>

#include "io/numbers.h"

namespace perfora::geometry {

void SvgScanner::skip() {
  const std::size_t first = rest_.find_first_not_of(" \t\r\n\f,");
  rest_ = first == std::string_view::npos ? std::string_view{} : rest_.substr(first);
}

bool SvgScanner::at_end() {
  skip();
  return rest_.empty();
}

std::optional<double> SvgScanner::number() {
  skip();
  const std::optional<double> value = io::take_number(rest_);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<bool> SvgScanner::flag() {
  skip();
  if (rest_.empty() || (rest_.front() != '0' && rest_.front() != '1')) return std::nullopt;
  const bool set = rest_.front() == '1';
  rest_.remove_prefix(1);
  return set;
}

char SvgScanner::peek() {
  skip();
  return rest_.empty() ? '\0' : rest_.front();
}

char SvgScanner::sign() {
  const char next = peek();
  if (next != '\0') rest_.remove_prefix(1);
  return next;
}

std::string_view SvgScanner::word() {
  skip();
  std::size_t length = 0;
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%'; };
  while (length < rest_.size() && letter(rest_[length])) ++length;
  const std::string_view found = rest_.substr(0, length);
  rest_.remove_prefix(length);
  return found;
}

double SvgLength::metres() const {
  constexpr double inch = 0.0254;
  if (unit == "mm") return value * 1e-3;
  if (unit == "cm") return value * 1e-2;
  if (unit == "m") return value;
  if (unit == "in") return value * inch;
  if (unit == "pt") return value * inch / 72.0;
  if (unit == "pc") return value * inch / 6.0;
  return 0.0;
}

std::optional<SvgLength> svg_length(std::string_view text) {
  SvgScanner scanner(text);
  const auto value = scanner.number();
  if (!value) return std::nullopt;
  SvgLength length{*value, std::string(scanner.word())};
  if (!scanner.at_end()) return std::nullopt;
  return length;
}

namespace {

std::optional<Affine> one_transform(std::string_view name, const std::vector<double>& n) {
  const auto is = [&](std::string_view wanted, std::size_t fewest, std::size_t most) {
    return name == wanted && n.size() >= fewest && n.size() <= most;
  };
  constexpr double degree = std::numbers::pi / 180.0;
  if (is("matrix", 6, 6)) return Affine{n[0], n[1], n[2], n[3], n[4], n[5]};
  if (is("translate", 1, 2)) return Affine{1, 0, 0, 1, n[0], n.size() > 1 ? n[1] : 0.0};
  if (is("scale", 1, 2)) return Affine{n[0], 0, 0, n.size() > 1 ? n[1] : n[0], 0, 0};
  if (is("skewX", 1, 1)) return Affine{1, 0, std::tan(n[0] * degree), 1, 0, 0};
  if (is("skewY", 1, 1)) return Affine{1, std::tan(n[0] * degree), 0, 1, 0, 0};
  if (is("rotate", 1, 3) && n.size() != 2) {
    const double c = std::cos(n[0] * degree), s = std::sin(n[0] * degree);
    const Affine turn{c, s, -s, c, 0, 0};
    if (n.size() == 1) return turn;
    return Affine{1, 0, 0, 1, n[1], n[2]}.after(turn).after({1, 0, 0, 1, -n[1], -n[2]});
  }
  return std::nullopt;
}

}  // namespace

std::optional<Affine> svg_transform(std::string_view text) {
  SvgScanner scanner(text);
  Affine whole;
  while (!scanner.at_end()) {
    const std::string_view name = scanner.word();
    if (scanner.sign() != '(') return std::nullopt;
    std::vector<double> numbers;
    constexpr std::size_t most = 6;
    while (scanner.peek() != ')') {
      const auto number = scanner.number();
      if (!number || numbers.size() == most) return std::nullopt;
      numbers.push_back(*number);
    }
    scanner.sign();
    const auto one = one_transform(name, numbers);
    if (!one) return std::nullopt;
    whole = whole.after(*one);
  }
  return whole;
}

}  // namespace perfora::geometry
