// What is here: outlines of polygons from text and files. What is not: shapes made of them (make_shape.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geometry/plane.h"

namespace perfora::geometry {

/// Corners of "POLYGON ((x y, x y, ...))" in turn, the repeated first one left out; or what is wrong with the text, as
/// a sentence without its full stop. Coordinates are plain numbers. Inner rings and third coordinates are refused.
std::variant<std::vector<Point>, std::string> parse_wkt_polygon(std::string_view text);

/// One ring of a WKT text.
struct WktPolygon {
  std::size_t offset = 0;  ///< where its POLYGON, or its brackets in a MULTIPOLYGON, begin in the text
  std::vector<Point> corners;
};
/// What is wrong with a WKT text, as a sentence without its full stop, and where.
struct WktProblem {
  std::size_t offset = 0;
  std::string text;
};
/// Every POLYGON, MULTIPOLYGON and GEOMETRYCOLLECTION of these that stand one after another in a text.
std::variant<std::vector<WktPolygon>, WktProblem> parse_wkt_polygons(std::string_view text);

/// Corners of an outline from a file: one WKT polygon, or CSV with columns x, y, a corner a line, in turn. In m where
/// the size is taken from them, else in any unit. Throws io::InputError with file and line.
std::vector<Point> read_outline(const std::filesystem::path& path);

}  // namespace perfora::geometry
