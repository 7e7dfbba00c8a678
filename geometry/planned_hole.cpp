// What is here: sizes and angles of holes, and their shapes. What is not: their places.
#include "geometry/planned_hole.h"

#include <numeric>
#include <utility>

#include "geometry/random.h"

namespace perfora::geometry {
namespace {

/// A random permutation of 0 ... count - 1 (Fisher and Yates).
std::vector<std::size_t> random_ranks(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> ranks(count);
  std::iota(ranks.begin(), ranks.end(), std::size_t{0});
  for (std::size_t k = count; k > 1; --k) {
    const double u = uniform_pair(seed, RandomStream::hole_size, k)[0];
    std::swap(ranks[k - 1], ranks[static_cast<std::size_t>(u * static_cast<double>(k))]);
  }
  return ranks;
}

bool same_shape(const PlannedHole& a, const PlannedHole& b) {
  return a.length == b.length && a.breadth == b.breadth && a.angle == b.angle;
}

ShapeSize size_of(const PlannedHole& hole, const LayoutOptions& options, const std::vector<Point>& outline) {
  return {hole.length, hole.breadth, hole.angle, options.corner_radius, outline};
}

}  // namespace

double breadth_for(const LayoutOptions& options, double length) {
  if (options.breadth > 0.0) return options.breadth;
  if (options.shape == ShapeKind::polygon && options.aspect == 1.0) return 0.0;
  return length / options.aspect;
}

PlannedHole plain_hole(const LayoutOptions& options, double x, double y) {
  return {x, y, options.diameter, breadth_for(options, options.diameter), options.angle};
}

void spread(std::vector<PlannedHole>& holes, const LayoutOptions& options, std::uint64_t seed) {
  const std::size_t count = holes.size();
  if (options.size_spread > 0.0) {
    const std::vector<std::size_t> ranks = random_ranks(count, seed);
    for (std::size_t k = 0; k < count; ++k) {
      const double place = (2.0 * static_cast<double>(ranks[k]) + 1.0) / static_cast<double>(count) - 1.0;
      holes[k].length *= 1.0 + options.size_spread * place;
      holes[k].breadth *= 1.0 + options.size_spread * place;
    }
  }
  if (options.angle_spread > 0.0)
    for (std::size_t k = 0; k < count; ++k)
      holes[k].angle += options.angle_spread * (2.0 * uniform_pair(seed, RandomStream::hole_angle, k)[0] - 1.0);
}

std::optional<ShapeFault> first_fault(const std::vector<PlannedHole>& holes, const LayoutOptions& options,
                                      const std::vector<Point>& outline) {
  const PlannedHole* last = nullptr;
  for (const PlannedHole& hole : holes) {
    if (last && same_shape(hole, *last)) continue;
    if (auto fault = fault_of(options.shape, size_of(hole, options, outline))) return fault;
    last = &hole;
  }
  return std::nullopt;
}

std::vector<Perforation> shaped(const std::vector<PlannedHole>& holes, const LayoutOptions& options,
                                const std::vector<Point>& outline) {
  std::vector<Perforation> made;
  made.reserve(holes.size());
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const PlannedHole& hole = holes[k];
    const bool again = k > 0 && same_shape(hole, holes[k - 1]);
    made.push_back(
        {hole.x, hole.y, again ? made.back().shape : make_shape(options.shape, size_of(hole, options, outline))});
  }
  return made;
}

}  // namespace perfora::geometry
