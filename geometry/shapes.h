// What is here: the shapes of a perforation and the questions a shape answers. A new shape is one more struct here, one
// more entry in Shape, its definitions in shapes.cpp, its reader and writer (docs/developer/how-to-add-a-shape.md).
// What is not: a hole at its place, which the other rooms ask (perforation.h).
#pragma once

#include <span>
#include <variant>
#include <vector>

namespace perfora::geometry {

struct Point {
  double x = 0.0, y = 0.0;  ///< m

  bool operator==(const Point&) const = default;
};

/// Smallest box along the axes, m.
struct Bounds {
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
};

/// A piece of an outline: the arc about `centre` from angle `from` anticlockwise to `to` >= from (rad). A radius of 0
/// is a corner.
struct Arc {
  Point centre;
  double radius = 0.0;  ///< m
  double from = 0.0, to = 0.0;
};

/// A disc near a hole, relative to the centre of the hole, m.
struct NearDisc {
  Point centre;
  double radius = 0.0;
};

/// Every shape has these members and a signed_gap with itself and with every other shape. Shapes know their size, not
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
double signed_gap(const Circle& first, Point first_centre, const Circle& second, Point second_centre);

using Shape = std::variant<Circle>;

}  // namespace perfora::geometry
