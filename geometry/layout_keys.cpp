// What is here: the keys of [cell] and [layout]. What is not: what they do (layout.cpp).
#include <numbers>

#include "geometry/layout.h"
#include "geometry/layout_limits.h"

namespace perfora::geometry {
namespace {

using io::Dimension;
using io::OneNumber;
using io::Range;

/// A quarter turn each way reaches every direction of an axis; half a turn each way, those of shapes with a point.
const Range any_angle = Range::between(-std::numbers::pi, std::numbers::pi);

void describe_shape(io::Section& section, LayoutOptions& options) {
  section
      .choice("shape", options.shape,
              {{"circle", ShapeKind::circle},
               {"ellipse", ShapeKind::ellipse},
               {"slot", ShapeKind::slot},
               {"diamond", ShapeKind::diamond},
               {"triangle", ShapeKind::triangle},
               {"teardrop", ShapeKind::teardrop},
               {"polygon", ShapeKind::polygon}},
              "Shape of the holes; of a list those that name none of their own.")
      .real("diameter", options.diameter, Dimension::length, Range::positive(),
            "Length of the holes along their own axis, the diameter of circles (every family but list); of graded ones "
            "the mean over the rows.")
      .real("aspect", options.aspect, Dimension::ratio, Range::positive(),
            "Length over breadth (every shape but circle); 1 keeps the proportions of a polygon's outline.")
      .real("breadth", options.breadth, Dimension::length, Range::non_negative(),
            "Breadth across the axis, instead of aspect; 0: from it.")
      .real("angle", options.angle, Dimension::angle, any_angle,
            "Angle of the axis from the horizontal, anticlockwise.")
      .real("corner_radius", options.corner_radius, Dimension::length, Range::non_negative(),
            "Radius that rounds the corners. Diamond, triangle, teardrop: the length and the breadth stay; polygon: "
            "inside "
            "its outline.")
      .file("outline", options.outline, options.outline_checksum,
            "Corners of a polygon in turn, in any unit: a file of one WKT POLYGON, or CSV with columns x, y (polygon).")
      .real("size_spread", options.size_spread, Dimension::ratio, Range{0.0, 1.0, false, true},
            "Sizes at random: evenly from 1 - size_spread to 1 + size_spread times their own, shuffled by the seed.")
      .real("angle_spread", options.angle_spread, Dimension::angle, Range::between(0.0, std::numbers::pi),
            "Angles at random: every hole turns by up to this, to either side.")
      .boolean("herringbone", options.herringbone,
               "Every other row has the opposite angle (square, staggered, oblique, graded, rows).");
}

void describe_lattice(io::Section& section, LayoutOptions& options) {
  section
      .integer("rows", options.rows, Range::between(1, 1000),
               "Rows of holes, one above the other (every family but random and list).")
      .integer("columns", options.columns, Range::between(1, 1000),
               "Holes in a row (every family but random and list).")
      .real("stagger", options.stagger, Dimension::ratio, Range::between(0, 1),
            "Shift of every other row as a fraction of the horizontal pitch (staggered, rows); the family staggered "
            "needs an even number of rows.")
      .integer(
          "turn", options.turn, Range::between(-1000, 1000),
          "Turns the square lattice by atan(turn/columns), anticlockwise when positive, so that it still repeats; "
          "that makes rows x columns + turn^2 holes (rotated). Exactly square where the cell is and rows = columns, "
          "else stretched with the cell.")
      .integer("climb", options.climb, Range::between(-1000, 1000),
               "Each column is climb/columns vertical pitches higher than the one to its left, so that the pattern "
               "repeats after the width of the cell (oblique).")
      .real("grading", options.grading, Dimension::ratio, Range{-largest_grading, largest_grading, true, true},
            "Diameter of the top row less that of the bottom row, over the mean; linear over the rows (graded).");
}

void describe_rows(io::Section& section, LayoutOptions& options) {
  const auto profile = [&](const char* name, std::vector<double>& field, Dimension dimension, Range range,
                           const char* help) {
    section.real_list(name, field, dimension, range, help, OneNumber::taken);
  };
  profile("row_diameter", options.row_diameter, Dimension::length, Range::positive(),
          "Diameter of the rows from the bottom to the top (rows): one value for all; several lie evenly over the "
          "height, linear in between, as many as rows are each row's own. Empty: diameter. So are all keys row_*.");
  profile("row_breadth", options.row_breadth, Dimension::length, Range::positive(),
          "Breadth of the rows' holes (rows). Empty: breadth or aspect.");
  profile("row_aspect", options.row_aspect, Dimension::ratio, Range::positive(),
          "Length over breadth of the rows' holes, instead of row_breadth (rows).");
  profile("row_angle", options.row_angle, Dimension::angle, any_angle,
          "Angle of the rows' holes (rows). Empty: angle.");
  profile("row_columns", options.row_columns, Dimension::none, Range::between(1, 1000),
          "Holes in the rows, rounded to whole numbers (rows). Empty: columns.");
  profile("row_shift", options.row_shift, Dimension::ratio, Range::between(-1, 1),
          "Shift of the rows to the right beside the stagger, as a fraction of their own pitch (rows).");
  profile("row_height", options.row_height, Dimension::none, Range::positive(),
          "Height of the rows' bands over each other, such as [1, 2] (rows). Empty: all the same.");
  section
      .real("shift_spread", options.shift_spread, Dimension::ratio, Range::between(0, 1),
            "Shifts at random: every row moves by up to this fraction of its pitch, to either side (rows).")
      .choice("weak_end", options.weak_end,
              {{"none", WeakEnd::none}, {"bottom", WeakEnd::bottom}, {"top", WeakEnd::top}, {"both", WeakEnd::both}},
              "Ends of the block whose rows have larger holes (square, staggered, graded, rows).")
      .integer("weak_rows", options.weak_rows, Range::between(1, 1000), "Rows at a weak end.")
      .real("weak_factor", options.weak_factor, Dimension::ratio, Range::positive(),
            "Diameter of the holes at a weak end over what it would be; a breadth that is given stays.")
      .integer("rib_every", options.rib_every, Range::between(0, 1000),
               "A solid rib above every so many rows, also above the topmost where the number of rows is a multiple "
               "(square, staggered, graded, rows); 0: none.")
      .real("rib_thickness", options.rib_thickness, Dimension::length, Range::non_negative(),
            "What a rib adds to the distance of the rows below and above it; the rows share the rest of the height.");
}

}  // namespace

void describe(io::Schema& schema, LayoutOptions& options) {
  schema.section("cell", "The periodic rectangle the block is cut from.")
      .real("width", options.width, Dimension::length, Range::positive(), "Width of the cell, the period in x.")
      .real("height", options.height, Dimension::length, Range::positive(),
            "Height of the cell, the period in y, the direction of loading.")
      .real(
          "scale", options.scale, Dimension::none, {1e-3, 1e3, false, false},
          "Factor on every length of [cell] and [layout], the discs left as they are: the same pattern this many times "
          "as large in the same material (docs/user/theory.md, \"Grade, strength, scale\").");
  io::Section section = schema.section("layout", "Where the holes are.");
  section.choice("family", options.family,
                 {{"none", LayoutFamily::none},
                  {"square", LayoutFamily::square},
                  {"staggered", LayoutFamily::staggered},
                  {"rotated", LayoutFamily::rotated},
                  {"oblique", LayoutFamily::oblique},
                  {"graded", LayoutFamily::graded},
                  {"rows", LayoutFamily::rows},
                  {"random", LayoutFamily::random},
                  {"list", LayoutFamily::list}},
                 "Family of arrangements.");
  describe_shape(section, options);
  describe_lattice(section, options);
  describe_rows(section, options);
  section
      .real("jitter", options.jitter, Dimension::length, Range::non_negative(),
            "Each centre moves uniformly within a disc of this radius (every family but random and list).")
      .choice(
          "placement", options.placement,
          {{"hard_core", Placement::hard_core}, {"blue_noise", Placement::blue_noise}, {"voronoi", Placement::voronoi}},
          "Places at random (random): anywhere that keeps the walls; as far apart as random addition allows; at "
          "the centroids of their own Voronoi cells.")
      .integer("count", options.count, Range::between(1, static_cast<double>(maximum_holes)),
               "Number of holes (random).")
      .real("minimum_wall", options.minimum_wall, Dimension::length, Range::non_negative(),
            "A thinner wall is refused; hard-core placement keeps it.")
      .real_rows("holes", options.holes, 3, Dimension::length, "Rows of x, y, diameter (list).")
      .file("file", options.file, options.file_checksum,
            "CSV with columns x, y, diameter (metres, or units in the header), instead of holes; of other shapes also "
            "shape, "
            "breadth, angle, corner_radius, wkt. Or a drawing: .dxf, .svg, .wkt (list).")
      .text("file_unit", options.file_unit,
            "Unit of the file's plain lengths, such as \"mm\"; empty: as a drawing or the header of a CSV says, else "
            "metres (list).")
      .text(
          "file_layer", options.file_layer,
          "Layer (DXF) or group (SVG) of a drawing that has the holes; empty: the one called holes, else every closed "
          "outline but the block's (list).");
}

}  // namespace perfora::geometry
