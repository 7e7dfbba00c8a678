// What is here: a perforation (a shape at its place) as a plain value with the questions that the other rooms ask of
// it, and the layout that perforations form. What is not: the shapes (shapes.h), which nobody outside this room looks
// into; how layouts are made (layout.h); CGAL (only in .cpp files of this room).
#pragma once

#include <span>
#include <vector>

#include "geometry/shapes.h"

namespace perfora::geometry {

/// A hole, centre in [0, width) x [0, height). Lengths in m, areas in m2. No periodic image is taken here: who asks
/// moves the hole or the point.
struct Perforation {
  double x = 0.0;  ///< of the centre
  double y = 0.0;
  Shape shape;

  bool operator==(const Perforation&) const = default;

  /// Whether the point lies in the hole, or nearer than `margin` to it.
  bool contains(double px, double py, double margin = 0.0) const;
  /// How far the straight segment a-b dips into the hole: the distance from the rim to its deepest point, 0 when it
  /// does not enter.
  double segment_depth(double ax, double ay, double bx, double by) const;
  /// No segment of at most `length` with both ends outside dips deeper into the hole than this.
  double deepest_dip(double length) const;
  /// Gap to `other` moved by (shift_x, shift_y), its ends on the rims. Negative when they overlap: minus the least move
  /// that takes them apart (of holes that are not convex: of those of their convex pieces that overlap most), so minus
  /// the smaller hole's smallest extent at least when nested.
  Gap gap_to(const Perforation& other, double shift_x, double shift_y) const;
  /// Its length.
  double signed_gap(const Perforation& other, double shift_x, double shift_y) const;
  /// The gap to this hole itself moved by (shift_x, shift_y).
  double gap_to_image(double shift_x, double shift_y) const;

  Bounds bounds() const;
  double area() const;
  /// Distance from the centre to the farthest point of the hole.
  double reach() const;
  /// Largest and smallest distance between two parallel lines with the hole just between them.
  double largest_extent() const;
  double smallest_extent() const;
  /// Length in the hole of the horizontal line that runs `offset` above the centre.
  double level_chord(double offset) const;
  /// Length in the hole of the vertical line that runs `offset` to the right of the centre.
  double upright_chord(double offset) const;
  /// Area shared with the same hole moved by `distance`, mean over all directions.
  double shared_area(double distance) const;
  /// The rim, anticlockwise: arcs whose ends are joined by straight lines, the last one to the first. `tolerance`: how
  /// far the arcs may lie from the rim of a shape that arcs cannot follow; where they can they are exact.
  std::vector<Arc> outline(double tolerance) const;

  Perforation moved_by(double dx, double dy) const;
  /// This hole with its rim moved in or out until no disc reaches into it but one touches it; with no disc near, until
  /// its reach is `reach`.
  Perforation clear_of(std::span<const NearDisc> discs, double reach) const;
  /// All lengths, the place included, times `factor`.
  Perforation scaled(double factor) const;
};

/// Perforations of a periodic rectangle.
struct PerforationLayout {
  double width = 0.0;   ///< period in x, m
  double height = 0.0;  ///< period in y, m
  std::vector<Perforation> perforations;

  /// Area left by the holes over the area of the cell, assuming they do not overlap.
  double solid_area_fraction() const;
  /// All lengths times `factor`.
  PerforationLayout scaled(double factor) const;
  /// The holes of the rectangle cut out of the periodic plane, along its upright edges (`cut_x`), its level edges
  /// (`cut_y`) or both: the holes and their images across the cut edges, as far as they reach into the rectangle.
  std::vector<Perforation> cut_out(bool cut_x, bool cut_y) const;
};

/// Thinnest wall: the smallest signed gap over all pairs of holes, periodic images and the own image included.
/// first = second: a hole and its own image. Infinite (no wall, first = -1) without holes.
struct ThinnestWall {
  double thickness = 0.0;
  int first = -1;
  int second = -1;
  Point from{}, to{};  ///< its ends on the rims of the first hole and of the nearest image of the second, m
};

}  // namespace perfora::geometry
