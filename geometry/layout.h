// What is here: the families of perforation layouts and their options. What is not: packings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/make_shape.h"
#include "geometry/perforation.h"
#include "io/schema.h"

namespace perfora::geometry {

enum class LayoutFamily { none, square, staggered, rotated, oblique, graded, rows, random, list };
/// How `random` places the holes: hard-core, with the largest smallest distance, or at the centroids of their Voronoi
/// cells.
enum class Placement { hard_core, blue_noise, voronoi };
enum class WeakEnd { none, bottom, top, both };

/// Options of the design file's [cell] and [layout] sections. Lengths in m, angles in rad. The lists row_* are profiles
/// over the height of family rows (row_profile()); empty: as the key without row_ says.
struct LayoutOptions {
  double width = 0.150;
  double height = 0.150;
  double scale = 1.0;         ///< factor on every length here: what is laid is this many times as large
  LayoutFamily family = LayoutFamily::square;
  ShapeKind shape = ShapeKind::circle;
  double diameter = 0.020;       ///< length of the shape along its own axis; graded: mean of the rows
  double aspect = 1.0;           ///< length over breadth
  double breadth = 0.0;          ///< across the axis, instead of `aspect`; 0: from it
  double angle = 0.0;            ///< of the axis from the horizontal, anticlockwise
  double corner_radius = 0.0;    ///< of polygons
  std::filesystem::path outline; ///< polygon: its corners
  std::string outline_checksum;  ///< io::content_checksum() of that file
  double size_spread = 0.0;      ///< sizes lie evenly within 1 -+ this times their own, in random order
  double angle_spread = 0.0;     ///< every hole turns uniformly within -+ this
  bool herringbone = false;      ///< families in rows: every other row has the opposite angle
  int rows = 6;
  int columns = 6;
  double stagger = 0.5;       ///< staggered, rows: shift of every other row as a fraction of the horizontal pitch
  int turn = 1;               ///< rotated: lattice rows crossed along one width of the cell; positive turns anticlockwise
  int climb = 1;              ///< oblique: vertical pitches that the columns rise along one width of the cell
  double grading = 0.3;       ///< graded: diameter of the top row less that of the bottom row, over `diameter`
  std::vector<double> row_diameter, row_breadth, row_aspect, row_angle;
  std::vector<double> row_columns;  ///< holes in a row, rounded to whole numbers
  std::vector<double> row_shift;    ///< beside the stagger, as a fraction of the row's own pitch
  std::vector<double> row_height;   ///< heights of the rows' bands, over each other
  double shift_spread = 0.0;        ///< rows: every row moves uniformly within -+ this fraction of its pitch
  WeakEnd weak_end = WeakEnd::none; ///< square, staggered, graded, rows
  int weak_rows = 1;                ///< at each weak end
  double weak_factor = 1.2;         ///< on the diameter of their holes
  int rib_every = 0;                ///< square, staggered, graded, rows: a rib above every so many rows; 0: none
  double rib_thickness = 0.0;
  double jitter = 0.0;        ///< regular families: each centre moves uniformly within a disc of this radius
  Placement placement = Placement::hard_core;
  int count = 36;             ///< random: number of holes
  double minimum_wall = 0.0;  ///< every family: a thinner wall is refused; hard-core placement keeps it
  std::vector<double> holes;  ///< list: rows of x, y, diameter
  std::filesystem::path file; ///< list: CSV of holes (layout_list.h) or drawing (drawn_holes.h) instead of `holes`
  std::string file_checksum;  ///< io::content_checksum() of that file
  std::string file_unit;      ///< of a drawing's lengths; "": as the drawing says
  std::string file_layer;     ///< of a drawing: the layer or group with the holes; "": see drawn_holes.h

  double cell_width() const { return scale * width; }  ///< as laid
  double cell_height() const { return scale * height; }
};

void describe(io::Schema& schema, LayoutOptions& options);

/// Lays the perforations out. `seed` feeds random placement, spreads and jitter only.
/// Throws io::InputError (with the key's origin taken from `schema` when given) for overlapping holes, walls thinner than minimum_wall,
/// a hole larger than the cell, a size that its shape cannot have, an odd number of rows with a stagger that breaks periodicity, one row
/// that cannot be graded, ribs that leave no room, a random layout that does not fit, a bad CSV or outline.
PerforationLayout make_layout(const LayoutOptions& options, std::uint64_t seed, const io::Schema* schema = nullptr);

/// The same placement without refusing overlaps or thin walls: what constraints of a study are measured on.
PerforationLayout place_perforations(const LayoutOptions& options, std::uint64_t seed, const io::Schema* schema = nullptr);

/// Holes these options make, without placing them; those of a CSV file are not counted.
std::int64_t hole_count(const LayoutOptions& options);

/// The key to blame when they are too many: "layout.rows", "layout.count", ...
const char* count_key(const LayoutOptions& options);

/// The key to blame for a hole's size: "layout.diameter", "layout.row_diameter", "layout.holes".
const char* size_key(const LayoutOptions& options);

/// Whether every hole is a circle of `options.diameter`.
bool equal_circles(const LayoutOptions& options);

}  // namespace perfora::geometry
