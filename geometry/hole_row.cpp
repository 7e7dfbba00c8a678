// What is here: shapes to and from rows of numbers. What is not: their geometry (shapes.cpp).
#include "geometry/hole_row.h"

namespace perfora::geometry {
namespace {

HoleRow row_of(const Circle& circle, const Perforation& hole) {
  return {"circle", {hole.x, hole.y, circle.diameter}};
}

}  // namespace

HoleRow hole_row(const Perforation& hole) {
  return std::visit([&](const auto& shape) { return row_of(shape, hole); }, hole.shape);
}

std::optional<Perforation> hole_of(const HoleRow& row) {
  if (row.shape == "circle" && row.numbers.size() == 3)
    return Perforation{row.numbers[0], row.numbers[1], Circle{row.numbers[2]}};
  return std::nullopt;
}

}  // namespace perfora::geometry
