// What is here: what can be said of a design without placing discs: rules across keys of several rooms.
// What is not: ranges of single keys (the table of keys), rules within a room (make_layout, solver::validate).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "geometry/jam.h"
#include "geometry/make_packing.h"
#include "geometry/plane.h"
#include "geometry/size_law.h"
#include "geometry/wall.h"
#include "io/files.h"
#include "io/text.h"
#include "optimize/evaluate/design.h"

namespace perfora::optimize {

namespace {

/// Bonds are numbered by 32-bit integers; a disc has at most about 40 of them at the largest sensible horizon.
constexpr double most_discs = 5.0e7;
/// Below this many discs across the cell there is no material to speak of.
constexpr double fewest_discs_across = 10.0;
/// Up to this ratio of <d> to the reference the thresholds are taken as stated for this packing: rounding in a design
/// file.
constexpr double coarse_tolerance = 1.01;
/// A wall that is exactly as thick as wanted comes out thinner by no more than this share of it.
constexpr double wall_rounding = 1e-9;

std::string length_text(double metres) {
  return io::quantity(metres, io::Dimension::length);
}

/// A length in a warning, never below mm: warnings are part of what `perfora check --json` prints, which stays.
std::string warned_length(double metres) {
  constexpr double millimetre = 1e-3;
  return io::in_unit(metres, io::unit_for(std::max(metres, millimetre), io::Dimension::length));
}

std::string size_text(double width, double height) {
  return io::quantities({width, height}, io::Dimension::length, " x ");
}

/// Refuses a hopeless number of holes before any is placed: n points in a periodic cell of area A have two nearer than
/// sqrt(2 A/(sqrt(3) n)) (densest lattice packing in the plane: Thue), so the thinnest wall is below that minus the
/// diameter. Of unequal holes the two nearest may be small ones, and long ones may lie side by side: those are left to
/// make_layout.
void check_hole_count(const Design& design, const io::Schema& schema, double horizon_radius) {
  const geometry::LayoutOptions& layout = design.layout;
  const std::int64_t holes = geometry::hole_count(layout);
  if (holes <= 0 || !geometry::equal_circles(layout)) return;
  const double diameter = layout.scale * layout.diameter;
  const double area = layout.cell_width() * layout.cell_height();
  const double closest = std::sqrt(2.0 * area / (std::numbers::sqrt3 * static_cast<double>(holes)));
  if (closest - diameter >= horizon_radius) return;
  const double most = 2.0 * area / (std::numbers::sqrt3 * std::pow(diameter + horizon_radius, 2));
  if (most < 1.0) return;  // not the number is wrong: make_layout and check_walls say what
  throw io::InputError(schema.origin(geometry::count_key(layout)),
                       fmt::format("{} holes of {} leave no wall of at least the horizon of {} in a cell of {}", holes,
                                   length_text(diameter), length_text(horizon_radius),
                                   size_text(layout.cell_width(), layout.cell_height())),
                       fmt::format("at most {:.0f} such holes can fit", std::floor(most)),
                       "take fewer or smaller holes, or a larger cell");
}

/// Diameters that the rules on cells speak of: <d> that the horizon is stated in, and the largest. Of the size law, or
/// of the imported discs.
struct DiscSizes {
  double mean = 0.0, largest = 0.0;
};

DiscSizes disc_sizes(const Design& design, std::vector<std::string>& warnings) {
  if (design.packing.file.empty()) return {design.packing.mean_diameter, design.packing.maximum_diameter};
  const geometry::Packing packing =
      geometry::import_packing(design.packing, design.layout.cell_width(), design.layout.cell_height());
  if (std::string note = geometry::import_note(design.packing); !note.empty()) warnings.push_back(std::move(note));
  if (packing.quality.max_overlap_ratio > geometry::overlap_limit)
    warnings.push_back(fmt::format(
        "{}: discs overlap by up to {} of the smaller diameter, more than the {} of packings made here: bonds start "
        "without stress, but contacts of broken ones start squeezed",
        design.packing.file.string(), io::quantity(packing.quality.max_overlap_ratio, io::Dimension::ratio),
        io::quantity(geometry::overlap_limit, io::Dimension::ratio)));
  return {packing.mean_diameter(), 2.0 * *std::max_element(packing.radius.begin(), packing.radius.end())};
}

void check_size_law(const Design& design, const io::Schema& schema) {
  if (!design.packing.file.empty()) return;
  const geometry::PackingOptions& packing = design.packing;
  const double smallest = packing.maximum_diameter / packing.size_ratio;
  const bool equal_discs = packing.size_ratio == 1.0;  // their mean is the maximum: size_law_exponent says so
  if (!equal_discs && (packing.mean_diameter <= smallest || packing.mean_diameter >= packing.maximum_diameter))
    throw io::InputError(
        schema.origin("packing.mean_diameter"),
        fmt::format("the mean diameter {} is outside the diameters of the size law, {}",
                    length_text(packing.mean_diameter),
                    io::quantities({smallest, packing.maximum_diameter}, io::Dimension::length, " to ")),
        "between maximum_diameter/size_ratio and maximum_diameter",
        "change packing.mean_diameter and packing.maximum_diameter together");
  static_cast<void>(geometry::size_law_exponent(packing.mean_diameter, packing.maximum_diameter, packing.size_ratio));
}

void check_disc_count(const Design& design, const io::Schema& schema) {
  if (!design.packing.file.empty()) return;
  // Estimated by area first: expected_discs may be slow for absurd numbers.
  const double area = design.layout.cell_width() * design.layout.cell_height();
  const double by_area = area / (design.packing.mean_diameter * design.packing.mean_diameter);
  if (by_area > most_discs)
    throw io::InputError(schema.origin("packing.mean_diameter"),
                         fmt::format("about {:.3g} discs of {} would be needed for a cell of {}", by_area,
                                     length_text(design.packing.mean_diameter),
                                     size_text(design.layout.cell_width(), design.layout.cell_height())),
                         fmt::format("at most {:.3g} discs", most_discs), "take larger discs or a smaller cell");
}

void check_cell_against_discs(const Design& design, const io::Schema& schema, double mean_diameter,
                              double horizon_radius) {
  const bool narrow = design.layout.cell_width() < design.layout.cell_height();
  const double smallest_side = narrow ? design.layout.cell_width() : design.layout.cell_height();
  const io::Origin origin = schema.origin(narrow ? "cell.width" : "cell.height");
  if (smallest_side < fewest_discs_across * mean_diameter)
    throw io::InputError(
        origin,
        fmt::format("a cell of {} is only {:.2g} mean disc diameters of {} across", length_text(smallest_side),
                    smallest_side / mean_diameter, length_text(mean_diameter)),
        fmt::format("at least {:.0f} diameters", fewest_discs_across), "take smaller discs or a larger cell");
  if (smallest_side <= 2.0 * horizon_radius)
    throw io::InputError(origin,
                         fmt::format("a cell of {} is not wider than twice the horizon of {}, so a disc would "
                                     "be bonded to two images of the same neighbour",
                                     length_text(smallest_side), length_text(horizon_radius)),
                         "more than 2 x material.horizon x packing.mean_diameter",
                         "take smaller discs or a larger cell");
}

/// Where a run follows: what is left of the cell at its end.
void check_final_height(const Design& design, const io::Schema& schema, double largest_diameter,
                        double horizon_radius) {
  const double final_height = design.layout.cell_height() * (1.0 - design.solver.loading.until);
  const double reach = std::max(largest_diameter, horizon_radius);  // fragments keep their bonds while the cell shrinks
  if (final_height <= 2.0 * reach)
    throw io::InputError(schema.origin("loading.until"),
                         fmt::format("compressing to strain {:.4g} leaves a cell {} high, not more than twice the "
                                     "horizon or the largest disc",
                                     design.solver.loading.until, length_text(final_height)),
                         fmt::format("below {:.4g}", 1.0 - 2.0 * reach / design.layout.cell_height()),
                         "stop earlier or take a higher cell");
}

void check_crushed_ends(const Design& design, const io::Schema& schema) {
  const solver::BoundaryOptions& boundary = design.solver.boundary;
  const double crushed = boundary.crushed_bottom + boundary.crushed_top;
  if (crushed < design.layout.cell_height()) return;
  throw io::InputError(schema.origin(boundary.crushed_bottom >= boundary.crushed_top ? "boundary.crushed_bottom"
                                                                                     : "boundary.crushed_top"),
                       fmt::format("the crushed ends, {} together, leave nothing of a cell {} high",
                                   length_text(crushed), length_text(design.layout.cell_height())),
                       "less than the height of the cell", "lower boundary.crushed_bottom or boundary.crushed_top");
}

/// The two holes and where the middle of their wall is.
std::string pair_text(const geometry::ThinnestWall& wall, const geometry::PerforationLayout& layout) {
  const auto middle = [](double from, double to, double period) {
    const double inside = geometry::wrapped(0.5 * (from + to), period);
    return warned_length(inside < wall_rounding * period ? 0.0 : inside);
  };
  const std::string at = fmt::format("at ({}, {})", middle(wall.from.x, wall.to.x, layout.width),
                                     middle(wall.from.y, wall.to.y, layout.height));
  if (wall.first == wall.second) return fmt::format("hole {} and its periodic image {}", wall.first + 1, at);
  return fmt::format("holes {} and {} {}", wall.first + 1, wall.second + 1, at);
}

/// The largest mean disc diameter at which a wall is `horizons` bond radii thick, rounded down to three digits.
double diameter_for(double wall, double horizons, const Design& design) {
  const double exact = wall / (horizons * design.solver.material.horizon);
  const double digit = std::pow(10.0, std::floor(std::log10(exact)) - 2.0);
  return std::floor(exact / digit * (1.0 + wall_rounding)) * digit;
}

void check_walls(const geometry::PerforationLayout& layout, const Design& design, const io::Schema& schema,
                 double horizon_radius, std::vector<std::string>& warnings) {
  if (layout.perforations.empty()) return;
  const geometry::ThinnestWall wall = geometry::thinnest_wall(layout);
  if (wall.thickness < (1.0 - wall_rounding) * horizon_radius)
    throw io::InputError(
        schema.origin(geometry::size_key(design.layout)),
        fmt::format("the thinnest wall, {} between {}, is thinner than the horizon of {}, so "
                    "bonds would span it",
                    length_text(wall.thickness), pair_text(wall, layout), length_text(horizon_radius)),
        "at least " + length_text(horizon_radius),
        fmt::format("take smaller or fewer holes, discs of a mean diameter of at most {} (packing.mean_diameter) or a "
                    "smaller material.horizon; a random layout keeps walls of layout.minimum_wall",
                    length_text(diameter_for(wall.thickness, 1.0, design))));
  if (wall.thickness < (1.0 - wall_rounding) * 2.0 * horizon_radius)
    warnings.push_back(
        fmt::format("the thinnest wall, {} between {}, is thinner than two horizons ({}): every disc in "
                    "it feels an edge, so "
                    "it is softer and weaker than the material; a packing.mean_diameter of at most {} or thicker walls "
                    "give truer results",
                    warned_length(wall.thickness), pair_text(wall, layout), warned_length(2.0 * horizon_radius),
                    warned_length(diameter_for(wall.thickness, 2.0, design))));
}

void warn_about_holes(const geometry::PerforationLayout& layout, const Design& design,
                      std::vector<std::string>& warnings) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const geometry::Perforation& hole : layout.perforations) smallest = std::min(smallest, hole.smallest_extent());
  if (smallest < design.packing.maximum_diameter && design.packing.file.empty())
    warnings.push_back(
        fmt::format("the smallest hole, {}, is smaller than the largest disc, {}: it may take "
                    "no disc away",
                    warned_length(smallest), warned_length(design.packing.maximum_diameter)));
}

/// Keys of [layout] that somebody set and that the holes do not depend on: of another family, or without the key that
/// switches them on.
void warn_about_idle_keys(const Design& design, const io::Schema& schema, std::vector<std::string>& warnings) {
  const auto holes_of = [&](const geometry::LayoutOptions& layout) {
    return geometry::place_perforations(layout, design.seeds.effective(0).layout).perforations;
  };
  std::vector<geometry::Perforation> own;
  for (const io::Key& key : schema.keys()) {
    const std::string name = key.full_name();
    if (key.section != "layout" || name == "layout.minimum_wall" || key.at_default()) continue;
    if (schema.origin(name).file == "default") continue;
    if (own.empty()) own = holes_of(design.layout);
    DesignFile without(design);
    try {
      without.schema().set(name, DesignFile().schema().at(name).get(), {});
      if (holes_of(without.design().layout) != own) continue;
    } catch (const io::InputError&) {
      continue;  // it takes part in saying what a hole is
    }
    warnings.push_back(fmt::format("{} has no effect: the holes are the same without it", name));
  }
}

void warn_about_resolution(const Design& design, double mean_diameter, std::vector<std::string>& warnings) {
  const solver::MaterialOptions& material = design.solver.material;
  const double ratio = mean_diameter / material.reference_mean_diameter;
  if (ratio <= coarse_tolerance) return;
  const std::string mean = warned_length(mean_diameter);
  const std::string reference = warned_length(material.reference_mean_diameter);
  const char* consequence =
      "; the first peak comes out biased, not only noisy, and a wall holds fewer discs: use it to try things out, and "
      "fewer "
      "holes in a smaller cell at the reference diameter for cheap numbers that hold";
  switch (material.threshold_scaling) {
    case solver::ThresholdScaling::none:
      warnings.push_back(fmt::format(
          "the mean disc diameter {} is {:.2f} times the reference {} that the critical stretches are "
          "stated for, "
          "and material.threshold_scaling = \"none\" leaves them as they are: strength falls by that factor{}",
          mean, ratio, reference, consequence));
      break;
    case solver::ThresholdScaling::strength:
      warnings.push_back(fmt::format(
          "the mean disc diameter {} is {:.2f} times the reference {}: strength is kept by scaling the "
          "critical "
          "stretches with it, so the fracture energy and the characteristic length E G/sigma_t^2 (about 6 mm for Table "
          "1 at the "
          "reference) grow {:.2f} times as well{}",
          mean, ratio, reference, ratio, consequence));
      break;
    case solver::ThresholdScaling::toughness:
      warnings.push_back(
          fmt::format("the mean disc diameter {} is {:.2f} times the reference {}: fracture energy is "
                      "kept by scaling the "
                      "critical stretches with its square root, so the strength falls to {:.2f} of its value{}",
                      mean, ratio, reference, 1.0 / std::sqrt(ratio), consequence));
      break;
  }
}

/// Plain numbers are in metres, and people think in millimetres.
void warn_about_metres(const Design& design, std::vector<std::string>& warnings) {
  constexpr double implausible = 2.0;  // m
  for (const auto& [key, side] :
       {std::pair{"cell.width", design.layout.width}, std::pair{"cell.height", design.layout.height}})
    if (side >= implausible)
      warnings.push_back(
          fmt::format("{} is {}: plain numbers are in m; did you mean \"{:g} mm\"?", key, length_text(side), side));
}

/// Discs in the plane, brought together at random, jam at 0.82 to 0.86; the densest lattice of equal ones has 0.907.
void warn_about_solid_fraction(const Design& design, std::vector<std::string>& warnings) {
  constexpr double jammed = 0.87;
  const double wanted = design.packing.solid_fraction;
  if (design.packing.file.empty() && wanted > jammed)
    warnings.push_back(fmt::format(
        "packing.solid_fraction is {}: random packings of discs jam at 82 to 86 %, so none will be made; lower it, or "
        "write 0 for what compaction reaches",
        io::quantity(wanted, io::Dimension::ratio)));
}

void warn_about_window(const Design& design, std::vector<std::string>& warnings) {
  const double until = design.solver.loading.until;
  const results::MeasureOptions measures = results::with_window_of(design.target, design.measures);
  if (measures.plateau == results::PlateauPlace::found || until >= measures.plateau_end) return;
  warnings.push_back(fmt::format(
      "the run ends at {} strain, before the end of the plateau window at {}: there will be no plateau stress, "
      "nor what follows from it; raise loading.until, or set measures.plateau_start and measures.plateau_end",
      io::quantity(until, io::Dimension::ratio), io::quantity(measures.plateau_end, io::Dimension::ratio)));
}

void check_file_contents(const Design& design, const io::Schema& schema) {
  if (const auto [key, problem] = changed_file(design); !problem.empty())
    throw io::InputError(
        schema.origin(key + io::checksum_suffix), problem, "results belong to what the file held then",
        fmt::format("put the earlier file back, or remove {}{} and begin anew", key, io::checksum_suffix));
}

enum class Warnings { all, cheap };

std::vector<std::string> checked(const Design& design, const io::Schema& schema, Purpose purpose, Warnings warn) {
  std::vector<std::string> warnings;
  check_file_contents(design, schema);
  check_size_law(design, schema);
  check_disc_count(design, schema);
  const DiscSizes sizes = disc_sizes(design, warnings);
  const double mean_diameter = sizes.mean, horizon_radius = design.solver.material.horizon * mean_diameter;
  check_cell_against_discs(design, schema, mean_diameter, horizon_radius);
  if (purpose == Purpose::run) check_final_height(design, schema, sizes.largest, horizon_radius);
  check_hole_count(design, schema, horizon_radius);
  check_crushed_ends(design, schema);
  const auto layout = geometry::make_layout(design.layout, design.seeds.effective(0).layout, &schema);
  check_walls(layout, design, schema, horizon_radius, warnings);
  solver::validate(design.solver, schema);
  results::validate(design.measures, schema);
  warn_about_metres(design, warnings);
  warn_about_solid_fraction(design, warnings);
  results::validate(design.target, design.measures, schema);
  for (std::string& told : results::warnings(design.target)) warnings.push_back(std::move(told));
  warn_about_holes(layout, design, warnings);
  if (warn == Warnings::all) warn_about_idle_keys(design, schema, warnings);
  warn_about_resolution(design, mean_diameter, warnings);
  if (purpose == Purpose::run) warn_about_window(design, warnings);
  return warnings;
}

/// A complaint about a key that the file leaves at its default names the file all the same: that is where the remedy
/// goes. Holes that came from a CSV file are that file's.
io::InputError at_home(const io::InputError& error, const Design& design, const std::filesystem::path& path) {
  if (error.origin().file != "default" || path.empty()) return error;
  const std::string prefix = "default: " + error.origin().key + ": ";
  std::string text = error.what();
  if (!text.starts_with(prefix)) return error;
  text.erase(0, prefix.size());
  if (error.origin().key == "layout.holes" && !design.layout.file.empty())
    return {{design.layout.file.string(), 0, ""}, text};
  return {{path.string(), 0, error.origin().key}, text};
}

}  // namespace

ChangedFile changed_file(const Design& design) {
  const std::tuple<const char*, const std::filesystem::path&, const std::string&> files[] = {
      {"layout.outline", design.layout.outline, design.layout.outline_checksum},
      {"layout.file", design.layout.file, design.layout.file_checksum},
      {"packing.file", design.packing.file, design.packing.file_checksum}};
  for (const auto& [key, file, then] : files) {
    if (file.empty() || then.empty()) continue;
    std::string now = "it cannot be read";
    try {
      now = io::content_checksum(file);
    } catch (const io::InputError&) {
    }
    if (now != then)
      return {key, fmt::format("{} does not hold what it held when this design was written ({}, then {})",
                               file.string(), now, then)};
  }
  return {};
}

std::vector<std::string> DesignFile::validate(Purpose purpose) const {
  try {
    std::vector<std::string> warnings = schema_->notices();
    for (std::string& warning : checked(*design_, *schema_, purpose, Warnings::all))
      warnings.push_back(std::move(warning));
    return warnings;
  } catch (const io::InputError& error) {
    throw at_home(error, *design_, path_);
  }
}

void DesignFile::require_valid(Purpose purpose) const {
  try {
    static_cast<void>(checked(*design_, *schema_, purpose, Warnings::cheap));
  } catch (const io::InputError& error) {
    throw at_home(error, *design_, path_);
  }
}

}  // namespace perfora::optimize
