// What is here: closed outlines read from drawings of other programs: DXF, SVG, WKT. What is not: which of them are
// holes of a block (drawn_holes.h), lists of holes as CSV (layout_list.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/plane.h"

namespace perfora::geometry {

/// One outline of a drawing, in m, y upwards, from the drawing's own origin (SVG: the lower left corner of the page).
struct DrawnShape {
  std::vector<std::string> layers;  ///< names of the layer (DXF) or of all groups around it (SVG), in lower case
  int line = 0;                     ///< of the file, where it begins
  double diameter = 0.0;            ///< of a circle about `centre`; 0: an outline of corners
  Point centre;
  std::vector<Point> corners;  ///< in turn, the first not repeated; curves within curve_tolerance
  /// Of what is drawn but is no closed outline ("this line is not closed"): harmless beside the holes, an error among
  /// them.
  std::string problem;
  /// Of what may hide holes, wherever it stands ("blocks are not read").
  bool hides_holes = false;
};

/// Where a drawing comes from, and what its lengths mean.
struct DrawnSource {
  std::string name;     ///< the file, for messages
  double metres = 0.0;  ///< of one unit of the drawing, as the user says; 0: as the file says
};

/// CIRCLE, ELLIPSE, LWPOLYLINE and POLYLINE with bulges, of the model space of an ASCII DXF file (R12 to today). The
/// unit is $INSUNITS. Throws io::InputError with file and line: a binary or broken file, a unit that is not said, a
/// value that is no number, too many outlines or corners.
std::vector<DrawnShape> read_dxf(std::string_view text, const DrawnSource& source);

/// circle, ellipse, rect, polygon and closed paths with all transforms. The unit is what width and viewBox of the root
/// say ("150mm", "0 0 150 150"). Throws io::InputError as read_dxf does, and for text that is no XML.
std::vector<DrawnShape> read_svg(std::string_view text, const DrawnSource& source);

/// POLYGON, MULTIPOLYGON, and GEOMETRYCOLLECTION of these, one after another; metres where the user says no unit.
/// Throws io::InputError.
std::vector<DrawnShape> read_wkt(std::string_view text, const DrawnSource& source);

}  // namespace perfora::geometry
