// What is here: WKT polygons and CSV files of corners. What is not: whether the outline crosses itself
// (make_shape.cpp).
#include "geometry/outline_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "io/csv.h"
#include "io/error.h"
#include "io/files.h"

namespace perfora::geometry {
namespace {

constexpr std::size_t most_read_corners = 10000;
constexpr std::string_view word = "POLYGON";

/// Reads one WKT text from its front.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  /// Whether the next sign that is no blank is `sign`; takes it then.
  bool take(char sign) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != sign) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool take_word() {
    skip_blanks();
    if (!starts_with_word(rest_)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  bool take(double& number) {
    skip_blanks();
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (error != std::errc{} || !std::isfinite(number)) return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return true;
  }
  bool at_end() {
    skip_blanks();
    return rest_.empty();
  }
  static bool starts_with_word(std::string_view text) {
    return text.size() >= word.size() && std::equal(word.begin(), word.end(), text.begin(), [](char a, char b) {
             return a == static_cast<char>(std::toupper(static_cast<unsigned char>(b)));
           });
  }

 private:
  void skip_blanks() {
    const std::size_t first = rest_.find_first_not_of(" \t\r\n\v\f");
    rest_.remove_prefix(std::min(first, rest_.size()));
  }
  std::string_view rest_;
};

}  // namespace

std::variant<std::vector<Point>, std::string> parse_wkt_polygon(std::string_view text) {
  Scanner scanner(text);
  if (!scanner.take_word() || !scanner.take('(') || !scanner.take('('))
    return std::string("this is no text of the form POLYGON ((x y, x y, ...))");
  std::vector<Point> corners;
  do {
    Point corner;
    if (!scanner.take(corner.x) || !scanner.take(corner.y))
      return "corner " + std::to_string(corners.size() + 1) + " has no two numbers";
    if (corners.size() == most_read_corners) return std::string("there are too many corners");
    corners.push_back(corner);
  } while (scanner.take(','));
  if (!scanner.take(')'))
    return "corner " + std::to_string(corners.size()) + " is not followed by a comma or a closing bracket";
  if (scanner.take(',')) return std::string("the polygon has an inner ring, which would be an island in the hole");
  if (!scanner.take(')') || !scanner.at_end()) return std::string("something follows the outer ring");
  if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

std::vector<Point> read_outline(const std::filesystem::path& path) {
  constexpr std::size_t largest_file = std::size_t{1} << 24;
  const std::string text = io::read_file(path, largest_file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && Scanner::starts_with_word(std::string_view(text).substr(first))) {
    auto read = parse_wkt_polygon(text);
    if (const auto* problem = std::get_if<std::string>(&read))
      throw io::InputError({path.string(), 0, ""}, *problem, "one POLYGON of one ring", "correct the text");
    return std::get<std::vector<Point>>(std::move(read));
  }
  const io::CsvTable table = io::parse_csv(text, path.string(), {"x", "y"}, most_read_corners);
  std::vector<Point> corners;
  for (std::size_t k = 0; k < table.rows(); ++k) corners.push_back({table.columns[0][k], table.columns[1][k]});
  if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

}  // namespace perfora::geometry
