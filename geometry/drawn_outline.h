// What is here: an outline put together from lines, arcs and Bezier curves. What is not: the files they come from
// (drawn_dxf.cpp, drawn_svg.cpp).
#pragma once

#include <vector>

#include "geometry/plane.h"

namespace perfora::geometry {

/// a x + c y + e, b x + d y + f: a transformation as SVG writes it.
struct Affine {
  double a = 1.0, b = 0.0, c = 0.0, d = 1.0, e = 0.0, f = 0.0;

  Point operator()(Point p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
  /// First `inner`, then this.
  Affine after(const Affine& inner) const {
    return {a * inner.a + c * inner.b, b * inner.a + d * inner.b,     a * inner.c + c * inner.d,
            b * inner.c + d * inner.d, a * inner.e + c * inner.f + e, b * inner.e + d * inner.f + f};
  }
  /// Largest stretch of a length, at most a factor of sqrt(2) too large.
  double stretch() const { return std::sqrt(a * a + b * b + c * c + d * d); }
};

/// Corners in turn, mapped into m. Curves are followed within curve_tolerance by corners that lie on them.
class DrawnOutline {
 public:
  explicit DrawnOutline(const Affine& to_metres) : to_metres_(to_metres) {}

  /// Every member takes places in the drawing's own units.
  void add(Point corner);
  /// From the last corner by the arc with this bulge (tan of a quarter of its angle, anticlockwise positive).
  void bulge_to(Point end, double bulge);
  /// The ellipse about `centre` with the half axes (x1, y1) and (x2, y2), from angle `from` to `to` (rad, of its
  /// parameter), its first place left out.
  void ellipse(Point centre, Point first_axis, Point second_axis, double from, double to);
  void cubic_to(Point control, Point second_control, Point end);
  void quadratic_to(Point control, Point end);

  bool empty() const { return corners_.empty(); }
  Point last() const { return last_; }
  bool too_long() const { return corners_.size() > most_corners; }
  /// Whether the last corner is the first one.
  bool returns() const;
  /// The corners, those at the same place once.
  std::vector<Point> corners() const;

  static constexpr std::size_t most_corners = 10000;

 private:
  Affine to_metres_;
  Point last_;  ///< in the drawing's units
  std::vector<Point> corners_;
};

/// Diameter and centre where the corners follow a circle within curve_tolerance; diameter 0 where they do not.
struct RoundOutline {
  double diameter = 0.0;
  Point centre;
};
RoundOutline round_outline(const std::vector<Point>& corners);

}  // namespace perfora::geometry
