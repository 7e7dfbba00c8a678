// What is here: a simple polygon (or a straight segment) about its own origin and what is measured in it: distances,
// depths, chords, the areas that estimates need. What is not: radii round it (rounded_polygon.h), gaps between
// two (core_gap.h), which corners a shape has (make_shape.h), whether a polygon is simple (polygon_checks.h).
#pragma once

#include <vector>

#include "geometry/plane.h"

namespace perfora::geometry {

/// Corners anticlockwise, at least two different ones, no edge crossing another; two corners are a segment, which has
/// no inside. Lengths in m, relative to the centre of the shape that the core belongs to. Never changes, so that copies
/// of a shape share one.
class PolygonCore {
 public:
  explicit PolygonCore(std::vector<Point> corners);

  const std::vector<Point>& corners() const { return corners_; }
  bool convex() const { return pieces_.empty(); }
  /// Convex parts that make it up; none where it is convex itself.
  const std::vector<std::vector<Point>>& pieces() const { return pieces_; }
  double area() const { return area_; }
  double perimeter() const { return perimeter_; }  ///< of a segment: there and back
  const Bounds& box() const { return box_; }
  /// Distance from the origin to the farthest corner.
  double reach() const { return reach_; }
  /// Largest and smallest distance between two parallel lines with the polygon just between them.
  double largest_extent() const { return largest_extent_; }
  double smallest_extent() const { return smallest_extent_; }

  /// Distance to the nearest edge: positive inside, negative outside.
  double depth(Point p) const;
  /// The largest depth along the segment a-b, to within 1e-12 of the extent; -margin where that is not reached. Cost
  /// O(corners), and a few times that where the segment enters.
  double deepest_on(Point a, Point b, double margin) const;
  /// Length of the line through p along the unit vector u that lies inside, and the same of the line's share with
  /// itself moved along by `shift`.
  double chord(Point p, Point u, double shift = 0.0) const;
  /// Area shared with the same polygon moved by `distance`, mean over all directions (to about 1 %).
  double shared_area(double distance) const;

 private:
  struct Edge {
    Point start, end, unit;
    double length;
  };
  /// Distances of p to all edges; returns the smallest.
  double distances(Point p, std::vector<double>& to_edges) const;
  /// Of a segment that lies inside.
  double deepest_between(Point a, Point b) const;
  /// Of a segment that lies outside: its distance from the core, at most `margin`.
  double distance_outside(Point a, Point b, double margin) const;
  void measure_extents();

  std::vector<Point> corners_;
  std::vector<Edge> edges_;
  std::vector<std::vector<Point>> pieces_;
  Bounds box_;
  double area_ = 0.0, perimeter_ = 0.0, reach_ = 0.0, largest_extent_ = 0.0, smallest_extent_ = 0.0;
};

}  // namespace perfora::geometry
