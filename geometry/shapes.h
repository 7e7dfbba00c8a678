// What is here: the shapes of a perforation and the questions a shape answers. Most new shapes are one more core in
// make_shape.cpp; one that is no core plus a radius is one more entry of Shape (docs/developer/how-to-add-a-shape.md).
// What is not: a hole at its place, which the other rooms ask (perforation.h).
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "geometry/core_gap.h"
#include "geometry/plane.h"
#include "geometry/rounded_polygon.h"

namespace perfora::geometry {

/// Every shape has these members and a gap_between with itself and with every other shape. Shapes know their size, not
/// their place: `centre` says where. Lengths in m. What each member answers is told once, at Perforation.
struct Circle {
  double diameter = 0.0;

  bool operator==(const Circle&) const = default;
  bool contains(Point centre, Point point, double margin) const;
  double segment_depth(Point centre, Point a, Point b) const;
  double deepest_dip(double length) const;
  double gap_to_image(double shift_x, double shift_y) const;
  Bounds bounds(Point centre) const;
  double area() const;
  double reach() const;
  double largest_extent() const;
  double smallest_extent() const;
  double level_chord(double offset) const;
  double upright_chord(double offset) const;
  double shared_area(double distance) const;
  std::vector<Arc> outline(Point centre, double tolerance) const;
  Circle clear_of(std::span<const NearDisc> discs, double reach) const;
  Circle scaled(double factor) const;
};

using Shape = std::variant<Circle, RoundedPolygon>;

Gap gap_between(const Circle& first, Point first_centre, const Circle& second, Point second_centre);
Gap gap_between(const Circle& first, Point first_centre, const RoundedPolygon& second, Point second_centre);
Gap gap_between(const RoundedPolygon& first, Point first_centre, const Circle& second, Point second_centre);
Gap gap_between(const RoundedPolygon& first, Point first_centre, const RoundedPolygon& second, Point second_centre);

}  // namespace perfora::geometry
