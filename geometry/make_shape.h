// What is here: shapes by their names and sizes. What is not: where they stand (layout.h), files of outlines
// (outline_file.h), their geometry (shapes.h).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/shapes.h"

namespace perfora::geometry {

/// A slot is a rectangle with half-circles at both ends; a triangle is isosceles with its apex, a teardrop has its tip
/// along the axis; a polygon is an outline of one's own.
enum class ShapeKind { circle, ellipse, slot, diamond, triangle, teardrop, polygon };

/// "circle", "ellipse", ...; nothing for another name.
std::optional<ShapeKind> shape_kind_called(std::string_view name);

/// Lengths in m. The centre of a shape is the middle of its extents along and across its axis.
struct ShapeSize {
  double length = 0.0;   ///< extent along the shape's own axis; of a circle its diameter
  double breadth = 0.0;  ///< extent across the axis; circle: not used
  double angle = 0.0;    ///< of the axis, rad, anticlockwise from the x axis
  /// Diamond, triangle, teardrop: radius of every corner, within length and breadth. Polygon: its corners are rounded
  /// inside the outline. Other kinds have no corners.
  double corner_radius = 0.0;
  /// Polygon: corners in turn, the first not repeated, in any unit; stretched to length and breadth. A length of 0:
  /// as given, in m; a breadth of 0: stretched alike in both directions.
  std::vector<Point> outline;
};

/// What is wrong with a size, and in which member.
struct ShapeFault {
  enum class Where { length, breadth, angle, corner_radius, outline };
  Where where = Where::length;
  std::string problem, allowed;
};

/// Nothing when make_shape can make it.
std::optional<ShapeFault> fault_of(ShapeKind kind, const ShapeSize& size);

/// The shape. One with equal extents that is round (ellipse, slot, teardrop) is a circle, bit for bit. Curves that are
/// no circle's become corners that are at most `curve_tolerance` off. Throws std::invalid_argument with the problem
/// where fault_of has one. Cost O(corners): make equal shapes once and copy them.
Shape make_shape(ShapeKind kind, const ShapeSize& size);

/// Largest distance of the rim of an ellipse or of a teardrop from the true curve, m: 1e-3 of discs of 0.5 mm. Ellipses
/// longer than 80 mm have 512 corners and are off by up to 6.3e-6 of their length.
inline constexpr double curve_tolerance = 0.5e-6;

/// The middle of the extents of an outline along the axes: where its centre is.
Point middle_of(const std::vector<Point>& outline);

}  // namespace perfora::geometry
