// What is here: WKT polygons and CSV files of corners. What is not: whether the outline crosses itself
// (make_shape.cpp).
#include "geometry/outline_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include "io/csv.h"
#include "io/error.h"
#include "io/numbers.h"
#include "io/text_file.h"

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
  /// A word in any case.
  bool take_word(std::string_view wanted) {
    skip_blanks();
    if (!starts_with_word(rest_, wanted)) return false;
    rest_.remove_prefix(wanted.size());
    return true;
  }
  std::size_t left() const { return rest_.size(); }
  bool take(double& number) {
    skip_blanks();
    const std::optional<double> taken = io::take_number(rest_);
    number = taken.value_or(0.0);
    return taken && std::isfinite(number);
  }
  bool at_end() {
    skip_blanks();
    return rest_.empty();
  }
  static bool starts_with_word(std::string_view text, std::string_view wanted) {
    return text.size() >= wanted.size() && std::equal(wanted.begin(), wanted.end(), text.begin(), [](char a, char b) {
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

/// "((x y, x y, ...))" into `corners`; what is wrong with it, or nothing.
std::string take_rings(Scanner& scanner, std::vector<Point>& corners) {
  if (!scanner.take('(') || !scanner.take('(')) return "this is no text of the form POLYGON ((x y, x y, ...))";
  do {
    Point corner;
    if (!scanner.take(corner.x) || !scanner.take(corner.y))
      return "corner " + std::to_string(corners.size() + 1) + " has no two numbers";
    if (corners.size() == most_read_corners) return "there are too many corners";
    corners.push_back(corner);
  } while (scanner.take(','));
  if (!scanner.take(')'))
    return "corner " + std::to_string(corners.size()) + " is not followed by a comma or a closing bracket";
  if (scanner.take(',')) return "the polygon has an inner ring, which would be an island in the hole";
  if (!scanner.take(')')) return "something follows the outer ring";
  if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return {};
}

/// Reads WKT texts one after another.
class WktReader {
 public:
  explicit WktReader(std::string_view text) : whole_(text.size()), scanner_(text) {}

  std::variant<std::vector<WktPolygon>, WktProblem> read() {
    while (!scanner_.at_end() && problem_.empty()) {
      take_geometry(0);
      while (scanner_.take(';')) continue;
    }
    if (problem_.empty() && polygons_.empty()) problem_ = "there is no POLYGON";
    if (!problem_.empty()) return WktProblem{place(), problem_};
    return std::move(polygons_);
  }

 private:
  std::size_t place() const { return whole_ - scanner_.left(); }

  void take_polygon() {
    static_cast<void>(scanner_.at_end());  // goes on to the first sign
    WktPolygon polygon{place(), {}};
    problem_ = take_rings(scanner_, polygon.corners);
    polygons_.push_back(std::move(polygon));
  }
  void take_list(const std::function<void()>& one) {
    if (!scanner_.take('(')) {
      problem_ = "a list in brackets is wanted here";
      return;
    }
    do one();
    while (problem_.empty() && scanner_.take(','));
    if (problem_.empty() && !scanner_.take(')')) problem_ = "the list does not end";
  }
  void take_geometry(int depth) {
    constexpr int deepest = 100;
    if (depth > deepest)
      problem_ = "collections stand too deep within each other";
    else if (scanner_.take_word("MULTIPOLYGON"))
      take_list([this] { take_polygon(); });
    else if (scanner_.take_word("GEOMETRYCOLLECTION"))
      take_list([this, depth] { take_geometry(depth + 1); });
    else if (scanner_.take_word(word))
      take_polygon();
    else
      problem_ = "no POLYGON, MULTIPOLYGON or GEOMETRYCOLLECTION begins here";
  }

  std::size_t whole_;
  Scanner scanner_;
  std::vector<WktPolygon> polygons_;
  std::string problem_;
};

}  // namespace

std::variant<std::vector<Point>, std::string> parse_wkt_polygon(std::string_view text) {
  Scanner scanner(text);
  std::vector<Point> corners;
  if (!scanner.take_word(word)) return std::string("this is no text of the form POLYGON ((x y, x y, ...))");
  const std::string problem = take_rings(scanner, corners);
  if (!problem.empty()) return problem;
  if (!scanner.at_end()) return std::string("something follows the outer ring");
  return corners;
}

std::variant<std::vector<WktPolygon>, WktProblem> parse_wkt_polygons(std::string_view text) {
  return WktReader(text).read();
}

std::vector<Point> read_outline(const std::filesystem::path& path) {
  constexpr std::size_t largest_file = std::size_t{1} << 24;
  const std::string text = io::read_text_file(path, largest_file, "an outline (WKT or CSV)");
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && Scanner::starts_with_word(std::string_view(text).substr(first), word)) {
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
