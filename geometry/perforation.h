// What is here: a perforation as plain data with the three questions the other rooms ask of a shape (contains, depth of a segment, signed gap),
// and the layout they form. What is not: how layouts are made (layout.h), CGAL (only in .cpp files of this room).
#pragma once

#include <vector>

namespace perfora::geometry {

/// A circular hole, centre in [0, width) x [0, height), metres. Other shapes come later behind the same three questions.
struct Perforation {
  double x = 0.0;
  double y = 0.0;
  double diameter = 0.0;

  bool operator==(const Perforation&) const = default;
  /// Whether the point (no periodic image taken) lies inside the hole.
  bool contains(double px, double py) const;
  /// How far the straight segment a-b dips into the hole, metres: radius minus the distance from the centre to the segment, 0 when it does not enter.
  double segment_depth(double ax, double ay, double bx, double by) const;
  /// Gap to `other` moved by (shift_x, shift_y), metres; negative when they overlap, minus the smaller diameter at least when nested.
  double signed_gap(const Perforation& other, double shift_x, double shift_y) const;
};

/// Perforations of a periodic rectangle.
struct PerforationLayout {
  double width = 0.0;   ///< period in x, m
  double height = 0.0;  ///< period in y, m
  std::vector<Perforation> perforations;

  /// Area left by the holes over the area of the cell, assuming they do not overlap.
  double solid_area_fraction() const;
};

/// Thinnest wall: the smallest signed gap over all pairs of holes, periodic images and the own image included.
/// first = second: a hole and its own image. Infinite (no wall, first = -1) without holes.
struct ThinnestWall {
  double thickness = 0.0;
  int first = -1;
  int second = -1;
};

}  // namespace perfora::geometry
