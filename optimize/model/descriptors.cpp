// What is here: descriptors of a layout from level and upright cuts through it. What is not: models.
#include "optimize/model/descriptors.h"

#include <algorithm>
#include <cmath>

#include "geometry/wall.h"
#include "optimize/model/average.h"

namespace perfora::model {
namespace {

using geometry::Perforation;
using geometry::PerforationLayout;

/// Cuts through the block each way: finer than a tenth of the smallest hole that can be cast in a block of 150 mm.
constexpr int cuts = 300;
/// A minimum of the solid width is a row when it lies this much (of the width) below the maxima beside it.
constexpr double row_depth = 0.05;

/// Share of solid along a level cut at height y, periodic; overlaps counted twice, never below 0.
double solid_at_level(const PerforationLayout& layout, double y) {
  double open = 0.0;
  for (const Perforation& hole : layout.perforations) {
    const double offset = std::remainder(y - hole.y, layout.height);
    open += hole.level_chord(offset);
  }
  return std::max(0.0, 1.0 - open / layout.width);
}

double solid_at_upright(const PerforationLayout& layout, double x) {
  double open = 0.0;
  for (const Perforation& hole : layout.perforations)
    open += hole.upright_chord(std::remainder(x - hole.x, layout.width));
  return std::max(0.0, 1.0 - open / layout.height);
}

/// Minima of a periodic curve that lie `row_depth` below the maxima on both sides, in order.
std::vector<std::size_t> minima(const std::vector<double>& solid) {
  const std::size_t n = solid.size();
  const auto top = static_cast<std::size_t>(std::max_element(solid.begin(), solid.end()) - solid.begin());
  std::vector<std::size_t> found;
  std::size_t lowest = top;
  double highest = solid[top];
  bool falling = true;  // looking for the bottom of a valley
  for (std::size_t k = 1; k <= n; ++k) {
    const std::size_t at = (top + k) % n;
    if (falling) {
      if (solid[at] < solid[lowest]) lowest = at;
      if (solid[at] > solid[lowest] + row_depth && highest > solid[lowest] + row_depth) {
        found.push_back(lowest);
        falling = false;
        highest = solid[at];
      }
    } else {
      highest = std::max(highest, solid[at]);
      if (solid[at] < highest - row_depth) {
        falling = true;
        lowest = at;
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

double deviation_of(const std::vector<double>& values) {
  if (values.size() < 2) return 0.0;
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Slope of the values over their places from -1/2 to 1/2.
double trend_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  if (values.size() < 2) return 0.0;
  double sxy = 0.0, sxx = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double x = static_cast<double>(k) / (n - 1.0) - 0.5;
    sxy += x * values[k];
    sxx += x * x;
  }
  return sxy / sxx;
}

/// Correlation of each value with the next one: rows of a graded block +, alternating ones -.
double order_of(const std::vector<double>& values) {
  const double mean = mean_of(values), deviation = deviation_of(values);
  if (values.size() < 3 || deviation < 1e-6) return 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < values.size(); ++k) sum += (values[k] - mean) * (values[k + 1] - mean);
  return sum / (static_cast<double>(values.size() - 1) * deviation * deviation);
}

struct HoleMeans {
  double height = 0.0, width = 0.0, spread = 0.0, tilt = 0.0;
};

/// `tilt`: of the bounding box against the extents, 0 for upright and level holes, 1 at 45 degrees.
HoleMeans means_of(const PerforationLayout& layout) {
  HoleMeans means;
  std::vector<double> areas;
  for (const Perforation& hole : layout.perforations) {
    const geometry::Bounds box = hole.bounds();
    const double n = static_cast<double>(layout.perforations.size());
    means.height += box.height() / n;
    means.width += box.width() / n;
    const double longest = hole.largest_extent(), least = hole.smallest_extent();
    const double level = std::min(box.width(), box.height());
    if (longest > least * 1.0001) means.tilt += std::clamp((level - least) / (longest - least), 0.0, 1.0) / n;
    areas.push_back(std::sqrt(hole.area()));
  }
  if (!areas.empty()) means.spread = deviation_of(areas) / mean_of(areas);
  return means;
}

}  // namespace

const std::vector<Descriptor>& descriptor_list() {
  static const std::vector<Descriptor> list{
      {"porosity", "area of the holes over that of the block"},
      {"weakest_row", "solid share of the width in the weakest level cut"},
      {"mean_row", "mean over the rows of their weakest level cut"},
      {"row_spread", "deviation of the rows' weakest cuts"},
      {"row_trend", "their fall or rise from the bottom row to the top row"},
      {"row_order", "correlation of each row with the next: graded +, alternating -"},
      {"rows", "number of rows, as a logarithm"},
      {"free_stroke", "height of the holes of all rows over that of the block"},
      {"aspect", "ln of the mean height of the holes over their mean width"},
      {"tilt", "how far the holes lie between level and upright: 0 to 1"},
      {"size_spread", "deviation of the holes' sizes over their mean"},
      {"free_columns", "largest solid share of an upright cut: 1 where a column stands through"},
      {"phase", "deviation of the solid share over upright cuts: small where rows are staggered"},
      {"thinnest_wall", "thinnest wall over the height of the block"},
      {"holes", "number of holes, as a logarithm"},
      {"block_shape", "ln of height over width of the block"},
      {"block_size", "ln of the height in m"}};
  return list;
}

Descriptors describe_design(const optimize::Design& design) {
  const PerforationLayout layout = geometry::place_perforations(design.layout, design.seeds.effective(0).layout);
  std::vector<double> level, upright;
  for (int k = 0; k < cuts; ++k) {
    const double share = (k + 0.5) / cuts;
    level.push_back(solid_at_level(layout, share * layout.height));
    upright.push_back(solid_at_upright(layout, share * layout.width));
  }
  std::vector<double> rows;
  for (const std::size_t at : minima(level)) rows.push_back(level[at]);
  const HoleMeans holes = means_of(layout);
  const bool solid = layout.perforations.empty();
  const double count = std::max<double>(1.0, static_cast<double>(rows.size()));
  Descriptors made;
  made.family = 100 * static_cast<int>(design.layout.family) + static_cast<int>(design.layout.shape);
  made.values = {1.0 - layout.solid_area_fraction(),
                 *std::min_element(level.begin(), level.end()),
                 rows.empty() ? mean_of(level) : mean_of(rows),
                 deviation_of(rows),
                 trend_of(rows),
                 order_of(rows),
                 std::log(count),
                 std::min(1.0, count * holes.height / layout.height),
                 solid ? 0.0 : std::log(holes.height / holes.width),
                 holes.tilt,
                 holes.spread,
                 *std::max_element(upright.begin(), upright.end()),
                 deviation_of(upright),
                 solid ? 1.0 : std::clamp(geometry::thinnest_wall(layout).thickness / layout.height, -1.0, 1.0),
                 std::log1p(static_cast<double>(layout.perforations.size())),
                 std::log(layout.height / layout.width),
                 std::log(layout.height)};
  return made;
}

}  // namespace perfora::model
