// What is here: gaps, walls and depths of a thousand random layouts of all shapes against searches along the rims, to
// 1e-6 of the mean disc diameter. What is not: closed forms (test_make_shape.cpp), rough checks of every question
// (test_perforation.cpp).
#include <gtest/gtest.h>

#include "geometry/make_shape.h"
#include "geometry/perforation.h"
#include "geometry/wall.h"
#include "rim_oracle.h"

namespace perfora::geometry {
namespace {

using brute_force::least_of;
using brute_force::Rim;
using brute_force::rim_distance;
using brute_force::Uniform;

constexpr double mean_diameter = 0.5e-3, exact = 1e-6 * mean_diameter;

/// Of any kind, 3 to 16 mm long and 1 to 6 mm broad.
Shape random_shape(Uniform& u) {
  const auto kind = static_cast<ShapeKind>(static_cast<int>(u(0.0, 7.0)));
  ShapeSize size{
      .length = u(3e-3, 16e-3), .breadth = u(1e-3, 6e-3), .angle = u(-7.0, 7.0), .corner_radius = 0.0, .outline = {}};
  if (kind == ShapeKind::circle) size.length = size.breadth;
  if (kind == ShapeKind::teardrop) size.length = std::max(size.length, 1.2 * size.breadth);
  if (kind != ShapeKind::polygon && u(0.0, 1.0) < 0.5)
    size.corner_radius = u(0.0, 0.5) * std::min(size.length, size.breadth);
  if (kind == ShapeKind::polygon) {
    size.outline = u(0.0, 1.0) < 0.5 ? std::vector<Point>{{3, 0}, {0, 1}, {1, 0}, {0, -1}}
                                     : std::vector<Point>{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}};
    if (u(0.0, 1.0) < 0.5) size.corner_radius = 0.05 * size.breadth;
    if (fault_of(kind, size)) size.corner_radius = 0.0;
  }
  return make_shape(kind, size);
}

/// Two to five holes in a cell that some of them nearly fill along one side.
PerforationLayout random_layout(std::uint64_t seed) {
  Uniform u(seed);
  PerforationLayout layout{u(18e-3, 45e-3), u(18e-3, 45e-3), {}};
  for (int holes = 2 + static_cast<int>(u(0.0, 4.0)); holes > 0; --holes)
    layout.perforations.push_back({u(0.0, layout.width), u(0.0, layout.height), random_shape(u)});
  return layout;
}

bool overlap(const Perforation& a, const Rim& rim_of_a, const Perforation& b, Point shift) {
  constexpr int samples = 100;
  const Perforation moved = b.moved_by(shift.x, shift.y);
  if (a.contains(moved.x, moved.y) && moved.contains(moved.x, moved.y)) return true;
  for (int k = 0; k < samples; ++k) {
    const Point p = rim_of_a.at(static_cast<double>(k) / samples);
    if (moved.contains(p.x, p.y)) return true;
  }
  return false;
}

struct Found {
  double wall = std::numeric_limits<double>::infinity();
  bool overlap = false;
};

/// Over all images up to two periods away.
Found wall_along_the_rims(const PerforationLayout& layout) {
  std::vector<Rim> rims;
  for (const Perforation& hole : layout.perforations) rims.emplace_back(hole);
  Found found;
  for (std::size_t i = 0; i < rims.size(); ++i)
    for (std::size_t j = i; j < rims.size(); ++j)
      for (int a = -2; a <= 2; ++a)
        for (int b = -2; b <= 2; ++b) {
          if (i == j && a == 0 && b == 0) continue;
          const Point shift{a * layout.width, b * layout.height};
          const Perforation &first = layout.perforations[i], &second = layout.perforations[j];
          const double apart = std::hypot(second.x + shift.x - first.x, second.y + shift.y - first.y);
          if (apart - first.reach() - second.reach() > std::min(found.wall, 1.0)) continue;
          found.overlap = found.overlap || overlap(first, rims[i], second, shift);
          if (found.overlap) return found;
          found.wall = std::min(found.wall, rim_distance(rims[i], rims[j], shift, 160));
        }
  return found;
}

TEST(ShapesExact, ThinnestWallOfAThousandLayoutsAcrossTheEdges) {
  int apart = 0, overlapping = 0;
  for (std::uint64_t seed = 1; apart < 1000; ++seed) {
    const PerforationLayout layout = random_layout(seed);
    const ThinnestWall wall = thinnest_wall(layout), by_definition = thinnest_wall_brute_force(layout);
    ASSERT_NEAR(wall.thickness, by_definition.thickness, 1e-15) << "seed " << seed;
    if (wall.thickness < exact) {
      if (++overlapping <= 200) {
        ASSERT_TRUE(wall_along_the_rims(layout).overlap || wall.thickness > -1e-4) << "seed " << seed;
      }
      continue;
    }
    ++apart;
    const Found found = wall_along_the_rims(layout);
    ASSERT_FALSE(found.overlap) << "seed " << seed;
    ASSERT_NEAR(wall.thickness, found.wall, exact) << "seed " << seed;
    // Its place: on both rims, as far from each other as the wall is thick.
    EXPECT_NEAR(std::hypot(wall.to.x - wall.from.x, wall.to.y - wall.from.y), wall.thickness, 1e-14);
    const auto on_rim = [&](int hole, Point p) {
      const Perforation& of = layout.perforations[static_cast<std::size_t>(hole)];
      const Rim rim(of);
      double least = std::numeric_limits<double>::infinity();
      for (int a = -2; a <= 2; ++a)
        for (int b = -2; b <= 2; ++b)
          least = std::min(least, rim.distance_to({p.x - a * layout.width, p.y - b * layout.height}));
      return least;
    };
    EXPECT_LT(on_rim(wall.first, wall.from), exact) << "seed " << seed;
    EXPECT_LT(on_rim(wall.second, wall.to), exact) << "seed " << seed;
  }
  EXPECT_GT(overlapping, 100);
}

// Segments as long as bonds near the rim, and longer ones through the hole.
TEST(ShapesExact, DepthOfSegments) {
  int entering = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Uniform u(seed);
    const Perforation hole{0.0, 0.0, random_shape(u)};
    const Rim rim(hole);
    const Point p = rim.at(u(0.0, 1.0));
    const double length = u(0.5e-3, seed % 4 == 0 ? 12e-3 : 1.5e-3), angle = u(0.0, 2.0 * std::numbers::pi);
    const double back = u(0.0, 1.0) * length, off = u(-0.3e-3, 0.3e-3);
    const Point a{p.x + off - back * std::cos(angle), p.y + off - back * std::sin(angle)};
    const Point b{a.x + length * std::cos(angle), a.y + length * std::sin(angle)};
    const double deepest = -least_of(
        [&](double t) {
          const Point q{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
          return hole.contains(q.x, q.y) ? -rim.distance_to(q) : 0.0;
        },
        0.0, 1.0, 200);
    ASSERT_NEAR(hole.segment_depth(a.x, a.y, b.x, b.y), deepest, exact) << "seed " << seed;
    entering += deepest > exact ? 1 : 0;
  }
  EXPECT_GT(entering, 500);
}

// Of convex shapes that overlap the gap is minus the least move that takes them apart: over all directions the largest
// distance of two lines across it, one before the second hole and one behind the first.
TEST(ShapesExact, OverlapsAreTheLeastMoveApart) {
  int overlapping = 0;
  for (std::uint64_t seed = 1; overlapping < 300; ++seed) {
    Uniform u(seed);
    const Perforation a{0.0, 0.0, random_shape(u)}, b{u(-4e-3, 4e-3), u(-4e-3, 4e-3), random_shape(u)};
    const auto convex = [](const Perforation& hole) {
      const auto* polygon = std::get_if<RoundedPolygon>(&hole.shape);
      return !polygon || polygon->core->convex();
    };
    const Gap gap = a.gap_to(b, 0.0, 0.0);
    if (!convex(a) || !convex(b) || gap.length >= 0.0) continue;
    ++overlapping;
    const auto farthest = [](const Perforation& hole, double nx, double ny) {
      double most = -1.0;
      for (const Arc& arc : hole.outline(0.0))
        most = std::max(most, nx * arc.centre.x + ny * arc.centre.y + arc.radius);
      return most;
    };
    const double apart = -least_of(
        [&](double angle) {
          const double nx = std::cos(angle), ny = std::sin(angle);
          return farthest(b, -nx, -ny) + farthest(a, nx, ny);
        },
        0.0, 2.0 * std::numbers::pi, 720);
    ASSERT_NEAR(gap.length, apart, exact) << "seed " << seed;
    EXPECT_NEAR(gap.length, b.gap_to(a, 0.0, 0.0).length, 1e-15);
    EXPECT_NEAR(std::hypot(gap.to.x - gap.from.x, gap.to.y - gap.from.y), -gap.length, 1e-14);
    // Moved apart by that they touch.
    const Perforation moved = b.moved_by(gap.from.x - gap.to.x, gap.from.y - gap.to.y);
    EXPECT_NEAR(a.signed_gap(moved, 0.0, 0.0), 0.0, exact) << "seed " << seed;
  }
}

// The sweep against all pairs where there are hundreds, overlapping ones too.
TEST(ShapesExact, SweepOverManyHolesFindsThePairOfTheDefinition) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Uniform u(seed);
    PerforationLayout layout{0.3, 0.2, {}};
    for (int k = 0; k < 60; ++k) layout.perforations.push_back({u(0.0, 0.3), u(0.0, 0.2), random_shape(u)});
    if (seed % 2 == 0)  // far apart
      for (int k = 0; k < 60; ++k)
        layout.perforations[static_cast<std::size_t>(k)] = layout.perforations[static_cast<std::size_t>(k)].moved_by(
            (k % 10 + 0.5) * 0.03 + u(0.0, 8e-3) - layout.perforations[static_cast<std::size_t>(k)].x,
            (k / 10 + 0.5) * 0.2 / 6 - layout.perforations[static_cast<std::size_t>(k)].y);
    const ThinnestWall wall = thinnest_wall(layout), by_definition = thinnest_wall_brute_force(layout);
    EXPECT_EQ(wall.thickness, by_definition.thickness);
    EXPECT_EQ(wall.first, by_definition.first);
    EXPECT_EQ(wall.second, by_definition.second);
  }
}

}  // namespace
}  // namespace perfora::geometry
