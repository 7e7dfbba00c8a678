// What is here: shapes to and from rows of numbers. What is not: their geometry (shapes.cpp).
#include "geometry/hole_row.h"

namespace perfora::geometry {
namespace {

HoleRow row_of(const Circle& circle, const Perforation& hole) {
  return {"circle", {hole.x, hole.y, circle.diameter}};
}

HoleRow row_of(const RoundedPolygon& polygon, const Perforation& hole) {
  HoleRow row{"polygon", {hole.x, hole.y, polygon.radius}};
  for (const Point& corner : polygon.core->corners()) row.numbers.insert(row.numbers.end(), {corner.x, corner.y});
  return row;
}

}  // namespace

HoleRow hole_row(const Perforation& hole) {
  return std::visit([&](const auto& shape) { return row_of(shape, hole); }, hole.shape);
}

std::optional<Perforation> hole_of(const HoleRow& row) {
  if (row.shape == "circle" && row.numbers.size() == 3)
    return Perforation{row.numbers[0], row.numbers[1], Circle{row.numbers[2]}};
  constexpr std::size_t head = 3;
  if (row.shape == "polygon" && row.numbers.size() >= head && row.numbers.size() % 2 == head % 2) {
    std::vector<Point> corners;
    for (std::size_t k = head; k < row.numbers.size(); k += 2) corners.push_back({row.numbers[k], row.numbers[k + 1]});
    if (auto polygon = polygon_of(std::move(corners), row.numbers[2]))
      return Perforation{row.numbers[0], row.numbers[1], std::move(*polygon)};
  }
  return std::nullopt;
}

}  // namespace perfora::geometry
