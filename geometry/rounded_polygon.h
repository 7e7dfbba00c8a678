// What is here: every shape but the circle: a core (a segment, a polygon) with a radius round it. What is not: which
// core an ellipse, a slot, a diamond has (make_shape.h).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/core_gap.h"
#include "geometry/plane.h"
#include "geometry/polygon_core.h"

namespace perfora::geometry {

/// All points nearer to the core than `radius`: a slot is a segment and half its breadth, an ellipse a polygon and 0.
/// Around a core that is not convex the radius is 0. The members are those of Circle, told at Perforation.
/// A negative radius is a rim moved in from the core, as clear_of leaves it: only contains, segment_depth and gaps are
/// meant then, and a point before a corner counts as nearer to the rim than it is.
struct RoundedPolygon {
  std::shared_ptr<const PolygonCore> core;
  double radius = 0.0;

  bool operator==(const RoundedPolygon& other) const;
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
  RoundedPolygon clear_of(std::span<const NearDisc> discs, double reach) const;
  RoundedPolygon scaled(double factor) const;

  PlacedCore placed(Point centre) const;
};

/// The shape of a core that was written to a file: nothing where it is none (fewer than two corners, edges that cross
/// or run clockwise, numbers that are none, a radius round a core that is not convex).
std::optional<RoundedPolygon> polygon_of(std::vector<Point> corners, double radius);

}  // namespace perfora::geometry
