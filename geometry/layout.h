// What is here: the families of perforation layouts and their options. What is not: packings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "geometry/perforation.h"
#include "io/schema.h"

namespace perfora::geometry {

enum class LayoutFamily { none, square, staggered, rotated, graded, random, list };

/// Options of the design file's [cell] and [layout] sections. Lengths in m.
struct LayoutOptions {
  double width = 0.150;
  double height = 0.150;
  double scale = 1.0;         ///< factor on every length here: what is laid is this many times as large
  LayoutFamily family = LayoutFamily::square;
  double diameter = 0.020;    ///< graded: mean of the rows
  int rows = 6;
  int columns = 6;
  double stagger = 0.5;       ///< staggered: shift of every other row as a fraction of the horizontal pitch
  int turn = 1;               ///< rotated: lattice rows crossed along one width of the cell; positive turns anticlockwise
  double grading = 0.3;       ///< graded: diameter of the top row less that of the bottom row, over `diameter`
  double jitter = 0.0;        ///< regular families: each centre moves uniformly within a disc of this radius
  int count = 36;             ///< random: number of holes
  double minimum_wall = 0.0;  ///< every family: a thinner wall is refused; random: kept while placing
  std::vector<double> holes;  ///< list: rows of x, y, diameter
  std::filesystem::path file; ///< list: CSV with columns x, y, diameter in metres instead of `holes`

  double cell_width() const { return scale * width; }  ///< as laid
  double cell_height() const { return scale * height; }
};

void describe(io::Schema& schema, LayoutOptions& options);

/// Lays the perforations out. `seed` feeds the random family and jitter only.
/// Throws io::InputError (with the key's origin taken from `schema` when given) for overlapping holes, walls thinner than minimum_wall,
/// a hole larger than the cell, an odd number of rows with a stagger that breaks periodicity, one row that cannot be graded, a random layout
/// that does not fit, a bad CSV.
PerforationLayout make_layout(const LayoutOptions& options, std::uint64_t seed, const io::Schema* schema = nullptr);

/// The same placement without refusing overlaps or thin walls: what constraints of a study are measured on.
PerforationLayout place_perforations(const LayoutOptions& options, std::uint64_t seed, const io::Schema* schema = nullptr);

/// Holes these options make, without placing them; those of a CSV file are not counted.
std::int64_t hole_count(const LayoutOptions& options);

/// The key to blame when they are too many: "layout.rows", "layout.count", ...
const char* count_key(const LayoutOptions& options);

/// Whether the family gives every hole `options.diameter`.
bool equal_holes(LayoutFamily family);

}  // namespace perfora::geometry
