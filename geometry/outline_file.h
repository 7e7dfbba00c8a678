// What is here: outlines of polygons from text and files. What is not: shapes made of them (make_shape.h).
#pragma once

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

/// Corners of an outline from a file: one WKT polygon, or CSV with columns x, y, a corner a line, in turn. In m where
/// the size is taken from them, else in any unit. Throws io::InputError with file and line.
std::vector<Point> read_outline(const std::filesystem::path& path);

}  // namespace perfora::geometry
