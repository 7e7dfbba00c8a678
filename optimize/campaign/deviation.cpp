// What is here: designs changed as a workshop changes them. What is not: what that does (tolerance_result.h).
#include "optimize/campaign/deviation.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/layout.h"
#include "geometry/plane.h"
#include "geometry/random.h"

namespace perfora::optimize {
namespace {

using geometry::LayoutFamily;
using geometry::LayoutOptions;

/// A circle, lengths before layout.scale.
struct Round {
  double x = 0.0, y = 0.0, diameter = 0.0;
};

/// As wide in every direction, and as large as a circle is.
bool is_round(const geometry::Perforation& hole, double diameter) {
  constexpr double rounding = 1e-9;
  return hole.smallest_extent() > (1.0 - rounding) * diameter &&
         std::abs(hole.area() / (0.25 * std::numbers::pi * diameter * diameter) - 1.0) < rounding;
}

/// The holes as they lie, where all are circles; empty otherwise.
std::vector<Round> circles_of(const DesignFile& design) {
  LayoutOptions options = design.design().layout;
  options.scale = 1.0;
  std::vector<Round> found;
  for (const geometry::Perforation& hole :
       geometry::place_perforations(options, design.design().seeds.effective(0).layout).perforations) {
    const double diameter = hole.largest_extent();
    if (!is_round(hole, diameter)) return {};
    found.push_back({hole.x, hole.y, diameter});
  }
  return found;
}

bool is_lattice(const LayoutOptions& options) {
  return options.family != LayoutFamily::none && options.family != LayoutFamily::list &&
         options.family != LayoutFamily::random;
}

/// Another seed of the layout would move these, too.
bool is_random(const LayoutOptions& options) {
  return options.size_spread > 0.0 || options.angle_spread > 0.0 || options.jitter > 0.0 || options.shift_spread > 0.0;
}

/// The design with these holes, one by one.
Design with_holes(const Design& design, const std::vector<Round>& holes) {
  Design made = design;
  LayoutOptions list;
  list.width = design.layout.width;
  list.height = design.layout.height;
  list.scale = design.layout.scale;
  list.family = LayoutFamily::list;
  for (const Round& hole : holes)
    for (const double number :
         {geometry::wrapped(hole.x, list.width), geometry::wrapped(hole.y, list.height), hole.diameter})
      list.holes.push_back(number);
  made.layout = list;
  return made;
}

std::vector<Round> resized(std::vector<Round> holes, double amount, std::uint64_t seed) {
  for (std::size_t k = 0; k < holes.size(); ++k)
    holes[k].diameter += amount * (2.0 * geometry::uniform_pair(seed, geometry::RandomStream::hole_size, k)[0] - 1.0);
  return holes;
}

std::vector<Round> displaced(std::vector<Round> holes, double amount, std::uint64_t seed) {
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const auto u = geometry::uniform_pair(seed, geometry::RandomStream::hole_move, k);
    const double distance = amount * std::sqrt(u[0]), angle = 2.0 * std::numbers::pi * u[1];
    holes[k].x += distance * std::cos(angle);
    holes[k].y += distance * std::sin(angle);
  }
  return holes;
}

/// The pattern goes on beyond the block, so that turning it fills the corners.
std::vector<Round> turned(const std::vector<Round>& holes, double angle, double width, double height) {
  std::vector<Round> found;
  for (const Round& hole : holes)
    for (int across = -1; across <= 1; ++across)
      for (int up = -1; up <= 1; ++up) {
        const double x = hole.x + across * width - 0.5 * width, y = hole.y + up * height - 0.5 * height;
        const Round moved{0.5 * width + x * std::cos(angle) - y * std::sin(angle),
                          0.5 * height + x * std::sin(angle) + y * std::cos(angle), hole.diameter};
        if (moved.x >= 0.0 && moved.x < width && moved.y >= 0.0 && moved.y < height) found.push_back(moved);
      }
  return found;
}

std::vector<Round> sheared(std::vector<Round> holes, double amount, double height) {
  for (Round& hole : holes) hole.x += amount * (hole.y - 0.5 * height);
  return holes;
}

double mean_size(const Design& design) {
  const auto holes = geometry::place_perforations(design.layout, design.seeds.effective(0).layout).perforations;
  double sum = 0.0;
  for (const geometry::Perforation& hole : holes) sum += hole.largest_extent();
  return sum / static_cast<double>(holes.size());
}

/// By the keys of the design, for shapes whose holes a list cannot hold.
Design spread_by_keys(const Design& design, Deviation deviation, double amount, std::uint64_t seed) {
  Design made = design;
  made.layout.minimum_wall = 0.0;
  made.seeds.layout = static_cast<std::int64_t>(seed);
  if (deviation == Deviation::hole_size)
    made.layout.size_spread = amount / mean_size(design);
  else
    made.layout.jitter = amount / design.layout.scale;
  return made;
}

}  // namespace

const char* deviation_name(Deviation deviation) {
  switch (deviation) {
    case Deviation::hole_size:
      return "hole size";
    case Deviation::hole_position:
      return "hole position";
    case Deviation::grade:
      return "grade";
    case Deviation::tilt:
      return "tilt";
    case Deviation::shear:
      return "shear";
  }
  return "";
}

std::string why_not(Deviation deviation, const DesignFile& design) {
  const LayoutOptions& layout = design.design().layout;
  if (deviation == Deviation::grade) return {};
  if (layout.family == LayoutFamily::none) return "the block has no holes";
  const bool circles = !circles_of(design).empty();
  if (deviation == Deviation::hole_size || deviation == Deviation::hole_position) {
    if (circles || (is_lattice(layout) && !is_random(layout))) return {};
    return "its holes are no circles and lie at random or in a list, whose shapes cannot be changed one by one";
  }
  const solver::BoundaryOptions& boundary = design.design().solver.boundary;
  const bool platens = boundary.top_bottom == solver::TopBottom::platens;
  if (!platens || (deviation == Deviation::tilt && boundary.sides == solver::Sides::periodic))
    return deviation == Deviation::tilt
               ? "a turned pattern does not repeat: it needs boundary.top_bottom = \"platens\" and sides that are not "
                 "periodic"
               : "a sheared pattern does not repeat: it needs boundary.top_bottom = \"platens\"";
  return circles ? "" : "its holes are no circles, which alone are moved one by one";
}

Design deviated(const DesignFile& design, Deviation deviation, double amount, std::uint64_t seed) {
  const Design& nominal = design.design();
  if (deviation == Deviation::grade) {
    Design made = nominal;
    made.solver.material.grade *= 1.0 + amount;
    return made;
  }
  const std::vector<Round> circles = circles_of(design);
  if (circles.empty()) return spread_by_keys(nominal, deviation, amount, seed);
  const LayoutOptions& layout = nominal.layout;
  switch (deviation) {
    case Deviation::hole_size:
      return with_holes(nominal, resized(circles, amount / layout.scale, seed));
    case Deviation::hole_position:
      return with_holes(nominal, displaced(circles, amount / layout.scale, seed));
    case Deviation::tilt:
      return with_holes(nominal, turned(circles, amount, layout.width, layout.height));
    case Deviation::shear:
      return with_holes(nominal, sheared(circles, amount, layout.height));
    case Deviation::grade:
      break;
  }
  return nominal;
}

}  // namespace perfora::optimize
