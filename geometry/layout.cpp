// What is here: the keys of [cell] and [layout], the regular and listed families, and what is refused.
// What is not: lattices (layout_lattice.cpp), random placement (layout_random.cpp), wall thickness (wall.cpp).
#include "geometry/layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "geometry/layout_lattice.h"
#include "geometry/layout_random.h"
#include "geometry/random.h"
#include "geometry/wall.h"
#include "io/csv.h"
#include "io/error.h"
#include "io/text.h"

namespace perfora::geometry {

namespace {

/// More holes than this are a mistake of units or count: a block has at most thousands.
constexpr std::int64_t maximum_holes = 10000;
/// Most that the diameters of a graded layout may differ, over their mean: at 2 the smallest row would have none.
constexpr double largest_grading = 1.9;
/// Smallest wall that counts as thinner than the wanted one, relative to the cell: rounding of a wall that is exactly
/// as thick as wanted.
constexpr double wall_rounding = 1e-12;

io::Origin origin_of(const io::Schema* schema, const std::string& key) {
  io::Origin origin = schema != nullptr ? schema->origin(key) : io::Origin{};
  origin.key = key;
  return origin;
}

std::string length_text(double length) {
  return io::quantity(length, io::Dimension::length);
}

double wrap(double value, double period) {
  value -= period * std::floor(value / period);
  return value < period ? value : 0.0;
}

class Layouter {
 public:
  Layouter(const LayoutOptions& options, std::uint64_t seed, const io::Schema* schema)
      : options_(options), seed_(seed), schema_(schema) {}

  /// Everything that can be said before a hole is placed.
  void check() const {
    refuse_unless(std::isfinite(options_.width) && options_.width > 0.0, "cell.width", "the cell has no width",
                  "a positive length");
    refuse_unless(std::isfinite(options_.height) && options_.height > 0.0, "cell.height", "the cell has no height",
                  "a positive length");
    if (options_.family == LayoutFamily::none) return;
    if (options_.family == LayoutFamily::list) return check_list();
    refuse_unless(std::isfinite(options_.diameter) && options_.diameter > 0.0, "layout.diameter", "holes have no size",
                  "a positive length");
    if (options_.family == LayoutFamily::random)
      refuse_unless(options_.count >= 1, "layout.count", "there is no hole to place", "1 or more",
                    "use family = \"none\" for a solid block");
    else
      check_lattice();
    refuse_count(hole_count(options_), count_key(options_));
  }

  PerforationLayout place() const {
    PerforationLayout layout{options_.width, options_.height, {}};
    switch (options_.family) {
      case LayoutFamily::none:
        break;
      case LayoutFamily::square:
        layout.perforations = jittered(place_in_rows(options_, 0.0, 0.0));
        break;
      case LayoutFamily::staggered:
        layout.perforations = jittered(place_in_rows(options_, options_.stagger, 0.0));
        break;
      case LayoutFamily::rotated:
        layout.perforations = jittered(place_turned(options_));
        break;
      case LayoutFamily::graded:
        layout.perforations = jittered(place_in_rows(options_, 0.0, options_.grading));
        break;
      case LayoutFamily::random:
        layout.perforations = at_random().perforations;
        break;
      case LayoutFamily::list:
        place_list(layout);
        break;
    }
    return layout;
  }

  RandomPlacement at_random() const {
    return place_at_random(options_.width, options_.height, options_.count, options_.diameter,
                           options_.diameter + std::max(0.0, options_.minimum_wall), seed_);
  }

  void refuse_unless(bool good, const std::string& key, const std::string& problem, const std::string& allowed,
                     const std::string& remedy = {}) const {
    if (!good) throw io::InputError(origin_of(schema_, key), problem, allowed, remedy);
  }

 private:
  void refuse_count(std::int64_t holes, const std::string& key) const {
    refuse_unless(holes <= maximum_holes, key, std::to_string(holes) + " holes are too many",
                  "at most " + std::to_string(maximum_holes) + " holes", "lower the number of holes");
  }

  void check_list() const {
    refuse_unless(options_.holes.empty() != options_.file.empty(), "layout.holes",
                  "a list layout needs either layout.holes or layout.file", "exactly one of the two",
                  "give rows of x, y, diameter or the name of a CSV file");
    refuse_unless(options_.holes.size() % 3 == 0, "layout.holes", "a hole has three numbers", "rows of x, y, diameter");
  }

  void check_lattice() const {
    refuse_unless(options_.rows >= 1, "layout.rows", "there is no row of holes", "1 or more",
                  "use family = \"none\" for a solid block");
    refuse_unless(options_.columns >= 1, "layout.columns", "there is no column of holes", "1 or more",
                  "use family = \"none\" for a solid block");
    refuse_unless(std::isfinite(options_.jitter) && options_.jitter >= 0.0, "layout.jitter", "jitter is a radius",
                  "zero or more");
    if (options_.family == LayoutFamily::staggered) {
      refuse_unless(std::isfinite(options_.stagger), "layout.stagger", "stagger is not a number",
                    "a fraction of the pitch");
      refuse_unless(options_.rows % 2 == 0 || options_.stagger == std::round(options_.stagger), "layout.rows",
                    std::to_string(options_.rows) + " rows shifted in turn do not repeat periodically",
                    "an even number of rows", "add or leave out a row, or use family = \"square\"");
    }
    if (options_.family == LayoutFamily::graded) {
      refuse_unless(std::abs(options_.grading) < largest_grading, "layout.grading",
                    "with this grading a row of holes would have no size", "between -1.9 and 1.9");
      refuse_unless(options_.rows >= 2, "layout.rows", "one row cannot be graded from bottom to top", "2 or more rows",
                    "add a row, or use family = \"square\"");
    }
  }

  /// Moves every centre within the jitter's disc, then back into the cell.
  std::vector<Perforation> jittered(std::vector<Perforation> holes) const {
    for (std::size_t k = 0; k < holes.size(); ++k) {
      if (options_.jitter > 0.0) {
        const auto u = uniform_pair(seed_, RandomStream::hole_jitter, k);
        const double distance = options_.jitter * std::sqrt(u[0]), angle = 2.0 * std::numbers::pi * u[1];
        holes[k].x += distance * std::cos(angle);
        holes[k].y += distance * std::sin(angle);
      }
      holes[k].x = wrap(holes[k].x, options_.width);
      holes[k].y = wrap(holes[k].y, options_.height);
    }
    return holes;
  }

  void place_list(PerforationLayout& layout) const {
    if (options_.file.empty()) {
      refuse_count(static_cast<std::int64_t>(options_.holes.size() / 3), "layout.holes");
      for (std::size_t k = 0; k + 2 < options_.holes.size(); k += 3)
        add_listed(layout, options_.holes[k], options_.holes[k + 1], options_.holes[k + 2],
                   origin_of(schema_, "layout.holes"));
      return;
    }
    const io::CsvTable table =
        io::read_csv(options_.file, {"x", "y", "diameter"}, static_cast<std::size_t>(maximum_holes));
    for (std::size_t k = 0; k < table.rows(); ++k)
      add_listed(layout, table.columns[0][k], table.columns[1][k], table.columns[2][k],
                 {options_.file.string(), table.lines[k], "layout.file"});
  }

  static void add_listed(PerforationLayout& layout, double x, double y, double diameter, const io::Origin& origin) {
    const std::string name = "hole " + std::to_string(layout.perforations.size() + 1);
    if (!(std::isfinite(diameter) && diameter > 0.0))
      throw io::InputError(origin, name + " has no size", "a positive diameter in metres",
                           "correct or leave out this hole");
    if (!(x >= 0.0 && x <= layout.width && y >= 0.0 && y <= layout.height))
      throw io::InputError(origin, name + " at (" + length_text(x) + ", " + length_text(y) + ") lies outside the cell",
                           "0 to " + length_text(layout.width) + " in x, 0 to " + length_text(layout.height) + " in y",
                           "give centres in metres within the cell");
    layout.perforations.push_back({wrap(x, layout.width), wrap(y, layout.height), Circle{diameter}});
  }

  const LayoutOptions& options_;
  std::uint64_t seed_;
  const io::Schema* schema_;
};

const char* size_key(LayoutFamily family) {
  return family == LayoutFamily::list ? "layout.holes" : "layout.diameter";
}

const char* smaller_holes(LayoutFamily family) {
  return family == LayoutFamily::graded ? "lower the diameter, take a grading nearer to 0" : "lower the diameter";
}

}  // namespace

void describe(io::Schema& schema, LayoutOptions& options) {
  using io::Dimension;
  using io::Range;
  schema.section("cell", "The periodic rectangle the block is cut from.")
      .real("width", options.width, Dimension::length, Range::positive(), "Width of the cell, the period in x.")
      .real("height", options.height, Dimension::length, Range::positive(),
            "Height of the cell, the period in y, the direction of loading.")
      .real("scale", options.scale, Dimension::none, {1e-3, 1e3, false, false},
            "Factor on every length of [cell] and [layout], the discs left as they are: the same pattern this many times "
            "as large in the same material (docs/user/theory.md, \"Grade, strength, scale\").");
  schema.section("layout", "Where the perforations are.")
      .choice("family", options.family,
              {{"none", LayoutFamily::none},
               {"square", LayoutFamily::square},
               {"staggered", LayoutFamily::staggered},
               {"rotated", LayoutFamily::rotated},
               {"graded", LayoutFamily::graded},
               {"random", LayoutFamily::random},
               {"list", LayoutFamily::list}},
              "Family of arrangements.")
      .real("diameter", options.diameter, Dimension::length, Range::positive(),
            "Diameter of the holes (every family but list); of graded ones the mean over the rows.")
      .integer("rows", options.rows, Range::between(1, 1000),
               "Rows of holes, one above the other (square, staggered, rotated, graded).")
      .integer("columns", options.columns, Range::between(1, 1000),
               "Holes in a row (square, staggered, rotated, graded).")
      .real("stagger", options.stagger, Dimension::ratio, Range::between(0, 1),
            "Shift of every other row as a fraction of the horizontal pitch (staggered); needs an even number of rows.")
      .integer(
          "turn", options.turn, Range::between(-1000, 1000),
          "Turns the square lattice by atan(turn/columns), anticlockwise when positive, so that it still repeats; "
          "that makes rows x columns + turn^2 holes (rotated). Exactly square where the cell is and rows = columns, "
          "else stretched with the cell.")
      .real("grading", options.grading, Dimension::ratio, Range{-largest_grading, largest_grading, true, true},
            "Diameter of the top row less that of the bottom row, over the mean; linear over the rows (graded).")
      .real("jitter", options.jitter, Dimension::length, Range::non_negative(),
            "Each centre moves uniformly within a disc of this radius (square, staggered, rotated, graded).")
      .integer("count", options.count, Range::between(1, static_cast<double>(maximum_holes)),
               "Number of holes (random).")
      .real("minimum_wall", options.minimum_wall, Dimension::length, Range::non_negative(),
            "A thinner wall is refused; random placement keeps it.")
      .real_rows("holes", options.holes, 3, Dimension::length, "Rows of x, y, diameter (list).")
      .path("file", options.file, "CSV with columns x, y, diameter in metres, instead of holes (list).");
}

std::int64_t hole_count(const LayoutOptions& options) {
  const std::int64_t rows = options.rows, columns = options.columns, turn = options.turn;
  switch (options.family) {
    case LayoutFamily::none:
      return 0;
    case LayoutFamily::square:
    case LayoutFamily::staggered:
    case LayoutFamily::graded:
      return rows * columns;
    case LayoutFamily::rotated:
      return rows * columns + turn * turn;
    case LayoutFamily::random:
      return options.count;
    case LayoutFamily::list:
      return static_cast<std::int64_t>(options.holes.size() / 3);
  }
  return 0;
}

const char* count_key(const LayoutOptions& options) {
  if (options.family == LayoutFamily::random) return "layout.count";
  if (options.family == LayoutFamily::list) return "layout.holes";
  const std::int64_t rows = options.rows, columns = options.columns, turn = options.turn;
  if (options.family == LayoutFamily::rotated && turn * turn > rows * columns) return "layout.turn";
  return rows >= columns ? "layout.rows" : "layout.columns";
}

bool equal_holes(LayoutFamily family) {
  return family != LayoutFamily::graded && family != LayoutFamily::list;
}

PerforationLayout place_perforations(const LayoutOptions& options, std::uint64_t seed, const io::Schema* schema) {
  const Layouter layouter(options, seed, schema);
  layouter.check();
  return layouter.place().scaled(options.scale);
}

PerforationLayout make_layout(const LayoutOptions& options, std::uint64_t seed, const io::Schema* schema) {
  const Layouter layouter(options, seed, schema);
  layouter.check();
  const double side = std::min(options.width, options.height);
  if (options.family != LayoutFamily::none && options.family != LayoutFamily::list)
    layouter.refuse_unless(options.diameter < side, "layout.diameter",
                           "a hole of " + length_text(options.diameter) + " is larger than the cell",
                           "less than " + length_text(side), "lower the diameter or enlarge the cell");
  if (options.family == LayoutFamily::random) {
    RandomPlacement placement = layouter.at_random();
    layouter.refuse_unless(placement.fits, "layout.count",
                           std::to_string(options.count) + " holes of " + length_text(options.diameter) +
                               " with walls of " + length_text(options.minimum_wall) +
                               " do not fit at random into the cell",
                           "holes with half their wall covering less than about 80 % of the cell",
                           "lower layout.count, layout.diameter or layout.minimum_wall");
    return PerforationLayout{options.width, options.height, std::move(placement.perforations)}.scaled(options.scale);
  }
  PerforationLayout layout = layouter.place();
  for (std::size_t k = 0; k < layout.perforations.size(); ++k)
    layouter.refuse_unless(layout.perforations[k].largest_extent() < side, size_key(options.family),
                           "hole " + std::to_string(k + 1) + " of " +
                               length_text(layout.perforations[k].largest_extent()) + " is larger than the cell",
                           "less than " + length_text(side),
                           std::string(smaller_holes(options.family)) + " or enlarge the cell");
  const ThinnestWall wall = thinnest_wall(layout);
  const std::string pair = wall.first == wall.second
                               ? "hole " + std::to_string(wall.first + 1) + " and its periodic image"
                               : "holes " + std::to_string(wall.first + 1) + " and " + std::to_string(wall.second + 1);
  layouter.refuse_unless(wall.thickness > 0.0, size_key(options.family),
                         pair + (wall.thickness < 0.0 ? " overlap by " + length_text(-wall.thickness) : " touch"),
                         "walls thicker than 0", std::string(smaller_holes(options.family)) + " or take fewer holes");
  layouter.refuse_unless(wall.thickness >= options.minimum_wall - wall_rounding * side, "layout.minimum_wall",
                         "the wall between " + pair + " is " + length_text(wall.thickness),
                         "at least the minimum wall of " + length_text(options.minimum_wall),
                         "lower the diameter, the jitter or the number of holes, or ask for less");
  return layout.scaled(options.scale);
}

}  // namespace perfora::geometry
