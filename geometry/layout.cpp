// What is here: from options to holes, and what is refused. What is not: the keys (layout_keys.cpp), rows and lattices
// (layout_rows.cpp, layout_lattice.cpp), lists (layout_list.cpp), random placement (layout_random.cpp), wall thickness
// (wall.cpp).
#include "geometry/layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "geometry/layout_lattice.h"
#include "geometry/layout_limits.h"
#include "geometry/layout_list.h"
#include "geometry/layout_points.h"
#include "geometry/layout_random.h"
#include "geometry/layout_rows.h"
#include "geometry/outline_file.h"
#include "geometry/planned_hole.h"
#include "geometry/random.h"
#include "geometry/wall.h"
#include "io/error.h"
#include "io/text.h"

namespace perfora::geometry {

namespace {

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
    check_sizes();
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
      case LayoutFamily::staggered:
      case LayoutFamily::graded:
      case LayoutFamily::rows:
        layout.perforations = jittered(in_shape(plan_rows(options_, seed_)));
        break;
      case LayoutFamily::rotated:
        layout.perforations = jittered(in_shape(plan_turned(options_)));
        break;
      case LayoutFamily::oblique:
        layout.perforations = jittered(in_shape(plan_oblique(options_)));
        break;
      case LayoutFamily::random:
        layout.perforations = at_random().perforations;
        break;
      case LayoutFamily::list:
        layout.perforations = listed();
        break;
    }
    return layout;
  }

  RandomPlacement at_random() const {
    const double wall = std::max(0.0, options_.minimum_wall);
    if (options_.placement == Placement::hard_core && equal_circles(options_))
      return place_at_random(options_.width, options_.height, options_.count, options_.diameter,
                             options_.diameter + wall, seed_);
    std::vector<PlannedHole> holes(static_cast<std::size_t>(options_.count), plain_hole(options_, 0.0, 0.0));
    if (options_.placement == Placement::hard_core)
      return place_apart(options_.width, options_.height, in_shape(std::move(holes)), wall, seed_);
    const auto spread_out = options_.placement == Placement::blue_noise ? blue_noise_points : voronoi_points;
    const std::vector<Point> points = spread_out(options_.width, options_.height, options_.count, seed_);
    for (std::size_t k = 0; k < holes.size(); ++k) {
      holes[k].x = points[k].x;
      holes[k].y = points[k].y;
    }
    return {in_shape(std::move(holes)), true};
  }

  void refuse_unless(bool good, const std::string& key, const std::string& problem, const std::string& allowed,
                     const std::string& remedy = {}) const {
    if (!good) throw io::InputError(origin_of(schema_, key), problem, allowed, remedy);
  }

 private:
  std::vector<Perforation> in_shape(std::vector<PlannedHole> holes) const {
    spread(holes, options_, seed_);
    return shaped_or_refused(holes, outline());
  }

  /// Rows that name no shape have that of the keys, with the row's diameter for length.
  std::vector<Perforation> listed() const {
    const std::vector<Point> corners = outline();
    const auto usual = [&](double diameter) {
      const PlannedHole hole{0.0, 0.0, diameter, breadth_for(options_, diameter), options_.angle};
      return shaped_or_refused({hole}, corners).front().shape;
    };
    return listed_holes(options_, usual, static_cast<std::size_t>(maximum_holes), origin_of(schema_, "layout.holes"));
  }

  std::vector<Point> outline() const {
    if (options_.shape != ShapeKind::polygon) return {};
    refuse_unless(!options_.outline.empty(), "layout.outline", "a polygon needs its corners", "a file of WKT or CSV",
                  "name the file, or take another layout.shape");
    return read_outline(options_.outline);
  }

  std::vector<Perforation> shaped_or_refused(const std::vector<PlannedHole>& holes,
                                             const std::vector<Point>& corners) const {
    if (const auto fault = first_fault(holes, options_, corners))
      refuse_unless(false, fault_key(fault->where), fault->problem, fault->allowed);
    return shaped(holes, options_, corners);
  }

  std::string fault_key(ShapeFault::Where where) const {
    const bool own = options_.family == LayoutFamily::rows;
    switch (where) {
      case ShapeFault::Where::length:
        return size_key(options_);
      case ShapeFault::Where::breadth:
        if (own && !options_.row_breadth.empty()) return "layout.row_breadth";
        if (own && !options_.row_aspect.empty()) return "layout.row_aspect";
        return options_.breadth > 0.0 ? "layout.breadth" : "layout.aspect";
      case ShapeFault::Where::angle:
        return own && !options_.row_angle.empty() ? "layout.row_angle" : "layout.angle";
      case ShapeFault::Where::corner_radius:
        return "layout.corner_radius";
      case ShapeFault::Where::outline:
        return "layout.outline";
    }
    return size_key(options_);
  }

  void refuse_count(std::int64_t holes, const std::string& key) const {
    refuse_unless(holes <= maximum_holes, key, std::to_string(holes) + " holes are too many",
                  "at most " + std::to_string(maximum_holes) + " holes", "lower the number of holes");
  }

  /// One of two ways to say how broad a hole is; none for a circle.
  void check_sizes() const {
    const bool own = options_.family == LayoutFamily::rows;
    const std::string taken = "take shape = \"ellipse\" or \"slot\"";
    refuse_unless(options_.breadth == 0.0 || options_.aspect == 1.0, "layout.breadth",
                  "the breadth follows from layout.aspect already", "one of the two", "leave one of them out");
    refuse_unless(!own || options_.row_breadth.empty() || options_.row_aspect.empty(), "layout.row_breadth",
                  "the breadth follows from layout.row_aspect already", "one of the two", "leave one of them out");
    if (options_.shape != ShapeKind::circle) return;
    refuse_unless(options_.aspect == 1.0, "layout.aspect", "a circle is as broad as it is long", "1", taken);
    refuse_unless(options_.breadth == 0.0, "layout.breadth", "a circle is as broad as it is long", "0", taken);
    refuse_unless(!own || options_.row_aspect.empty(), "layout.row_aspect", "a circle is as broad as it is long",
                  "no value", taken);
    refuse_unless(!own || options_.row_breadth.empty(), "layout.row_breadth", "a circle is as broad as it is long",
                  "no value", taken);
  }

  void check_list() const {
    refuse_unless(options_.holes.empty() != options_.file.empty(), "layout.holes",
                  "a list layout needs either layout.holes or layout.file", "exactly one of the two",
                  "give rows of x, y, diameter or the name of a CSV file");
    refuse_unless(options_.holes.size() % 3 == 0, "layout.holes", "a hole has three numbers", "rows of x, y, diameter");
    refuse_count(static_cast<std::int64_t>(options_.holes.size() / 3), "layout.holes");
    check_sizes();
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
    if (options_.family != LayoutFamily::rotated && options_.family != LayoutFamily::oblique) {
      const double ribs = rib_count(options_) * options_.rib_thickness;
      refuse_unless(ribs < options_.height, "layout.rib_thickness",
                    std::to_string(rib_count(options_)) + " ribs of " + length_text(options_.rib_thickness) +
                        " leave no room for rows in a cell " + length_text(options_.height) + " high",
                    "ribs that are less than the cell together", "take thinner ribs, fewer of them or a higher cell");
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
      holes[k].x = wrapped(holes[k].x, options_.width);
      holes[k].y = wrapped(holes[k].y, options_.height);
    }
    return holes;
  }

  const LayoutOptions& options_;
  std::uint64_t seed_;
  const io::Schema* schema_;
};

const char* smaller_holes(LayoutFamily family) {
  return family == LayoutFamily::graded ? "lower the diameter, take a grading nearer to 0" : "lower the diameter";
}

}  // namespace

std::int64_t hole_count(const LayoutOptions& options) {
  const std::int64_t rows = options.rows, columns = options.columns, turn = options.turn;
  switch (options.family) {
    case LayoutFamily::none:
      return 0;
    case LayoutFamily::square:
    case LayoutFamily::staggered:
    case LayoutFamily::graded:
    case LayoutFamily::oblique:
      return rows * columns;
    case LayoutFamily::rows: {
      std::int64_t holes = 0;
      for (int row = 0; row < options.rows; ++row) holes += columns_in_row(options, row);
      return holes;
    }
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

const char* size_key(const LayoutOptions& options) {
  if (options.family == LayoutFamily::list) return "layout.holes";
  return options.family == LayoutFamily::rows && !options.row_diameter.empty() ? "layout.row_diameter"
                                                                               : "layout.diameter";
}

bool equal_circles(const LayoutOptions& options) {
  const bool own_rows = options.family == LayoutFamily::graded || options.family == LayoutFamily::list ||
                        (options.family == LayoutFamily::rows && !options.row_diameter.empty());
  return options.shape == ShapeKind::circle && !own_rows && options.size_spread == 0.0 &&
         options.weak_end == WeakEnd::none;
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
  if (equal_circles(options) && options.family != LayoutFamily::none)
    layouter.refuse_unless(options.diameter < side, "layout.diameter",
                           "a hole of " + length_text(options.diameter) + " is larger than the cell",
                           "less than " + length_text(side),
                           options.diameter >= 1.0 && options.diameter / 1000.0 < side
                               ? "plain numbers are in m: did you mean \"" + io::shortest(options.diameter) + " mm\"?"
                               : "lower the diameter or enlarge the cell");
  PerforationLayout layout{options.width, options.height, {}};
  if (options.family == LayoutFamily::random) {
    RandomPlacement placement = layouter.at_random();
    layouter.refuse_unless(placement.fits, "layout.count",
                           std::to_string(options.count) + " holes of " + length_text(options.diameter) +
                               " with walls of " + length_text(options.minimum_wall) +
                               " do not fit at random into the cell",
                           "holes with half their wall covering less than about 80 % of the cell",
                           "lower layout.count, layout.diameter or layout.minimum_wall");
    layout.perforations = std::move(placement.perforations);
    if (equal_circles(options) && options.placement == Placement::hard_core) return layout.scaled(options.scale);
  } else {
    layout = layouter.place();
  }
  for (std::size_t k = 0; k < layout.perforations.size(); ++k) {
    const Bounds box = layout.perforations[k].bounds();
    const bool too_wide = box.width() >= options.width;
    layouter.refuse_unless(!too_wide && box.height() < options.height, size_key(options),
                           "hole " + std::to_string(k + 1) + " of " +
                               length_text(layout.perforations[k].largest_extent()) + " is larger than the cell",
                           "less than " + length_text(too_wide ? options.width : options.height),
                           std::string(smaller_holes(options.family)) + " or enlarge the cell");
  }
  const ThinnestWall wall = thinnest_wall(layout);
  const std::string pair = wall.first == wall.second
                               ? "hole " + std::to_string(wall.first + 1) + " and its periodic image"
                               : "holes " + std::to_string(wall.first + 1) + " and " + std::to_string(wall.second + 1);
  layouter.refuse_unless(wall.thickness > 0.0, size_key(options),
                         pair + (wall.thickness < 0.0 ? " overlap by " + length_text(-wall.thickness) : " touch"),
                         "walls thicker than 0", std::string(smaller_holes(options.family)) + " or take fewer holes");
  layouter.refuse_unless(wall.thickness >= options.minimum_wall - wall_rounding * side, "layout.minimum_wall",
                         "the wall between " + pair + " is " + length_text(wall.thickness),
                         "at least the minimum wall of " + length_text(options.minimum_wall),
                         "lower the diameter, the jitter or the number of holes, or ask for less");
  return layout.scaled(options.scale);
}

}  // namespace perfora::geometry
