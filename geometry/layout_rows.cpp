// What is here: rows of holes, their profiles over the height, weak ends, ribs. What is not: shapes (planned_hole.cpp).
#include "geometry/layout_rows.h"

#include <cmath>
#include <numeric>

#include "geometry/random.h"

namespace perfora::geometry {
namespace {

/// The profile's value, or what holds for all rows where there is no profile.
double value_of(const std::vector<double>& profile, double otherwise, int row, int rows) {
  return profile.empty() ? otherwise : row_profile(profile, row, rows);
}

bool is_weak(const LayoutOptions& options, int row) {
  const bool low = options.weak_end == WeakEnd::bottom || options.weak_end == WeakEnd::both;
  const bool high = options.weak_end == WeakEnd::top || options.weak_end == WeakEnd::both;
  return (low && row < options.weak_rows) || (high && row >= options.rows - options.weak_rows);
}

double length_in_row(const LayoutOptions& options, int row) {
  if (options.family == LayoutFamily::graded) {
    const double height_fraction = options.rows > 1 ? static_cast<double>(row) / (options.rows - 1) : 0.5;
    return options.diameter * (1.0 + options.grading * (height_fraction - 0.5));
  }
  if (options.family == LayoutFamily::rows) return value_of(options.row_diameter, options.diameter, row, options.rows);
  return options.diameter;
}

double breadth_in_row(const LayoutOptions& options, int row, double length) {
  const bool own = options.family == LayoutFamily::rows;
  if (own && !options.row_breadth.empty()) return row_profile(options.row_breadth, row, options.rows);
  if (own && !options.row_aspect.empty()) return length / row_profile(options.row_aspect, row, options.rows);
  return breadth_for(options, length);
}

double angle_in_row(const LayoutOptions& options, int row) {
  const double angle = options.family == LayoutFamily::rows
                           ? value_of(options.row_angle, options.angle, row, options.rows)
                           : options.angle;
  return options.herringbone && row % 2 == 1 ? -angle : angle;
}

double shift_of_row(const LayoutOptions& options, int row, std::uint64_t seed) {
  const bool own = options.family == LayoutFamily::rows;
  double shift = row % 2 == 1 && (own || options.family == LayoutFamily::staggered) ? options.stagger : 0.0;
  if (!own) return shift;
  shift += value_of(options.row_shift, 0.0, row, options.rows);
  if (options.shift_spread > 0.0)
    shift += options.shift_spread *
             (2.0 * uniform_pair(seed, RandomStream::row_shift, static_cast<std::uint64_t>(row))[0] - 1.0);
  return shift;
}

/// Centre of every row above the bottom, m.
std::vector<double> row_centres(const LayoutOptions& options) {
  const int rows = options.rows;
  const double free_height = options.height - rib_count(options) * options.rib_thickness;
  const bool equal = options.family != LayoutFamily::rows || options.row_height.empty();
  std::vector<double> weights(static_cast<std::size_t>(rows), 1.0), centres;
  if (!equal)
    for (int row = 0; row < rows; ++row)
      weights[static_cast<std::size_t>(row)] = row_profile(options.row_height, row, rows);
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0), pitch = free_height / rows;
  double below = 0.0;
  for (int row = 0; row < rows; ++row) {
    const double weight = weights[static_cast<std::size_t>(row)];
    double centre = equal ? (row + 0.5) * pitch : (below + 0.5 * weight) / sum * free_height;
    const int ribs_below = options.rib_every > 0 ? row / options.rib_every : 0;
    centre += ribs_below * options.rib_thickness;
    centres.push_back(centre);
    below += weight;
  }
  return centres;
}

}  // namespace

double row_profile(const std::vector<double>& values, int row, int rows) {
  const auto last = static_cast<std::int64_t>(values.size()) - 1;
  // Row r of n lies at r/(n - 1) of the height, the middle one of one row at 1/2: in whole numbers, so that a profile
  // with a value a row is met exactly.
  const std::int64_t steps = rows > 1 ? rows - 1 : 2, place = (rows > 1 ? row : 1) * last;
  const auto below = static_cast<std::size_t>(place / steps);
  const std::int64_t rest = place % steps;
  if (rest == 0) return values[below];
  const double share = static_cast<double>(rest) / static_cast<double>(steps);
  return values[below] + share * (values[below + 1] - values[below]);
}

int columns_in_row(const LayoutOptions& options, int row) {
  if (options.family != LayoutFamily::rows || options.row_columns.empty()) return options.columns;
  return static_cast<int>(std::lround(row_profile(options.row_columns, row, options.rows)));
}

int rib_count(const LayoutOptions& options) {
  return options.rib_every > 0 ? options.rows / options.rib_every : 0;
}

std::vector<PlannedHole> plan_rows(const LayoutOptions& options, std::uint64_t seed) {
  std::vector<PlannedHole> holes;
  const std::vector<double> centres = row_centres(options);
  for (int row = 0; row < options.rows; ++row) {
    const int columns = columns_in_row(options, row);
    const double pitch = options.width / columns, shift = shift_of_row(options, row, seed);
    const double length = length_in_row(options, row) * (is_weak(options, row) ? options.weak_factor : 1.0);
    const double breadth = breadth_in_row(options, row, length);
    for (int column = 0; column < columns; ++column)
      holes.push_back({(column + 0.5 + shift) * pitch, centres[static_cast<std::size_t>(row)], length, breadth,
                       angle_in_row(options, row)});
  }
  return holes;
}

}  // namespace perfora::geometry
