// What is here: every question asked of a perforation, against closed forms of the circle and against brute force on
// its rim and its inside. A new shape is one more entry of samples().
#include "geometry/perforation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/make_shape.h"
#include "rim_oracle.h"

namespace perfora::geometry {
namespace {

using brute_force::Uniform;

const Perforation hole{1.0, 2.0, Circle{0.6}};

TEST(Circle, ContainsPointsNearerThanItsRadius) {
  EXPECT_TRUE(hole.contains(1.0, 2.0));
  EXPECT_TRUE(hole.contains(1.29, 2.0));
  EXPECT_FALSE(hole.contains(1.31, 2.0));
  EXPECT_TRUE(hole.contains(1.31, 2.0, 0.02));
  EXPECT_FALSE(hole.contains(1.31, 2.0, 0.005));
}

TEST(Circle, SegmentDepthIsRadiusMinusDistanceToTheSegment) {
  EXPECT_DOUBLE_EQ(hole.segment_depth(0.0, 2.1, 2.0, 2.1), 0.3 - 0.1);  // a chord at 0.1 from the centre
  EXPECT_DOUBLE_EQ(hole.segment_depth(0.0, 2.5, 2.0, 2.5), 0.0);        // passes outside
  EXPECT_NEAR(hole.segment_depth(0.0, 2.0, 0.8, 2.0), 0.1, 1e-15);      // ends inside, 0.2 from the centre
  EXPECT_DOUBLE_EQ(hole.segment_depth(0.0, 2.0, 0.5, 2.0), 0.0);        // points at it and stops before
  EXPECT_NEAR(hole.segment_depth(1.1, 2.0, 1.1, 2.0), 0.2, 1e-15);      // a point
}

TEST(Circle, SignedGapOfApartOverlappingNestedAndEqualHoles) {
  const Perforation other{2.0, 2.0, Circle{0.4}};
  EXPECT_NEAR(hole.signed_gap(other, 0.0, 0.0), 1.0 - 0.3 - 0.2, 1e-15);
  EXPECT_NEAR(hole.signed_gap(other, -0.9, 0.0), 0.1 - 0.5, 1e-15);
  EXPECT_NEAR(hole.signed_gap(other, 3.0, 3.0), std::hypot(4.0, 3.0) - 0.5, 1e-15);
  const Perforation inner{1.05, 2.0, Circle{0.2}};
  EXPECT_LE(hole.signed_gap(inner, 0.0, 0.0), -0.2);
  EXPECT_DOUBLE_EQ(hole.signed_gap(hole, 0.0, 0.0), -0.6);
}

TEST(Circle, AreaExtentsChordsAndLens) {
  EXPECT_NEAR(hole.area(), std::numbers::pi * 0.09, 1e-15);
  EXPECT_DOUBLE_EQ(hole.largest_extent(), 0.6);
  EXPECT_DOUBLE_EQ(hole.level_chord(0.18), 0.48);  // 3-4-5: half chord 0.24 at 0.18 of a radius of 0.30
  EXPECT_DOUBLE_EQ(hole.upright_chord(-0.24), 0.36);
  EXPECT_EQ(hole.level_chord(0.31), 0.0);
  EXPECT_NEAR(hole.shared_area(0.0), hole.area(), 1e-15);
  // Centres one radius apart: 2 pi/3 - sqrt(3)/2 of the square of the radius.
  EXPECT_NEAR(hole.shared_area(0.3), 0.09 * (2.0 * std::numbers::pi / 3.0 - 0.5 * std::numbers::sqrt3), 1e-15);
  EXPECT_EQ(hole.shared_area(0.6), 0.0);
}

/// Holes of every kind, about 0.1 to 1 wide, in the unit square.
std::vector<Perforation> samples(std::uint64_t seed) {
  Uniform u(seed);
  std::vector<Perforation> holes;
  for (const ShapeKind kind : {ShapeKind::circle, ShapeKind::slot, ShapeKind::ellipse, ShapeKind::diamond,
                               ShapeKind::triangle, ShapeKind::teardrop, ShapeKind::polygon}) {
    ShapeSize size{
        .length = u(0.4, 1.0), .breadth = u(0.1, 0.39), .angle = u(-7.0, 7.0), .corner_radius = 0.0, .outline = {}};
    if (kind != ShapeKind::polygon) size.corner_radius = u(0.0, 0.5) * size.breadth;
    // An arrow without a shaft: not convex.
    if (kind == ShapeKind::polygon) size.outline = {{3.0, 0.0}, {0.0, 1.0}, {1.0, 0.0}, {0.0, -1.0}};
    holes.push_back({u(0.0, 1.0), u(0.0, 1.0), make_shape(kind, size)});
  }
  return holes;
}

/// Points along the rim, anticlockwise; how far apart: see `spacing`.
std::vector<Point> rim(const Perforation& of) {
  std::vector<Point> points;
  constexpr double step = 2e-3, turn = 5e-3;
  const std::vector<Arc> outline = of.outline(1e-6);
  const auto on = [](const Arc& arc, double angle) {
    return Point{arc.centre.x + arc.radius * std::cos(angle), arc.centre.y + arc.radius * std::sin(angle)};
  };
  for (std::size_t piece = 0; piece < outline.size(); ++piece) {
    const Arc &arc = outline[piece], &next = outline[(piece + 1) % outline.size()];
    const double angle = arc.to - arc.from;
    const int steps = arc.radius == 0.0
                          ? 1
                          : std::max(1, static_cast<int>(std::ceil(angle * std::max(arc.radius / step, 1.0 / turn))));
    for (int k = 0; k < steps; ++k) points.push_back(on(arc, arc.from + angle * k / steps));
    const Point a = on(arc, arc.to), b = on(next, next.from);
    const int along = static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / step);
    for (int k = 0; k <= along; ++k)
      points.push_back({a.x + (b.x - a.x) * k / (along + 1), a.y + (b.y - a.y) * k / (along + 1)});
  }
  return points;
}

double distance_to(const std::vector<Point>& points, double x, double y) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point& p : points) least = std::min(least, std::hypot(p.x - x, p.y - y));
  return least;
}

/// No point of the rim is farther than half of this from the next of rim().
constexpr double spacing = 2e-3;

TEST(Perforation, TheOutlineRunsAlongTheEdgeOfWhatIsContained) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const Perforation& one : samples(seed)) {
      const std::vector<Point> points = rim(one);
      double twice_area = 0.0;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const Point &p = points[k], &q = points[(k + 1) % points.size()];
        twice_area += p.x * q.y - q.x * p.y;
        EXPECT_TRUE(one.contains(p.x, p.y, 1e-6));
        EXPECT_FALSE(one.contains(p.x, p.y, -1e-6));
      }
      EXPECT_NEAR(0.5 * twice_area, one.area(), 1e-4 * one.area());  // positive: anticlockwise
    }
}

TEST(Perforation, BoundsReachAndExtentsAreThoseOfTheRim) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const Perforation& one : samples(seed)) {
      const std::vector<Point> points = rim(one);
      const auto extent = [&](double angle) {
        double low = 1e9, high = -1e9;
        for (const Point& p : points) {
          const double along = p.x * std::cos(angle) + p.y * std::sin(angle);
          low = std::min(low, along);
          high = std::max(high, along);
        }
        return std::pair{low, high};
      };
      const Bounds box = one.bounds();
      EXPECT_NEAR(box.left, extent(0.0).first, spacing * spacing);
      EXPECT_NEAR(box.right, extent(0.0).second, spacing * spacing);
      EXPECT_NEAR(box.bottom, extent(0.5 * std::numbers::pi).first, spacing * spacing);
      EXPECT_NEAR(box.top, extent(0.5 * std::numbers::pi).second, spacing * spacing);
      double reach = 0.0, largest = 0.0, smallest = 1e9;
      for (const Point& p : points) reach = std::max(reach, std::hypot(p.x - one.x, p.y - one.y));
      constexpr double turn = std::numbers::pi / 90;
      for (int k = 0; k < 90; ++k) {
        const auto [low, high] = extent(turn * k);
        largest = std::max(largest, high - low);
        smallest = std::min(smallest, high - low);
      }
      EXPECT_NEAR(one.reach(), reach, spacing * spacing);
      EXPECT_NEAR(one.largest_extent(), largest, 1e-3 * largest);
      // Half a step off the narrowest direction a hole is wider by at most its length times the angle.
      EXPECT_LE(one.smallest_extent(), smallest + spacing * spacing);
      EXPECT_GE(one.smallest_extent(), smallest - 0.5 * turn * largest);
    }
}

TEST(Perforation, SegmentDepthIsTheDeepestOfManyPoints) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Uniform u(100 + seed);
    for (const Perforation& one : samples(seed)) {
      const std::vector<Point> points = rim(one);
      for (int k = 0; k < 20; ++k) {
        const double ax = u(-0.5, 1.5), ay = u(-0.5, 1.5), bx = u(-0.5, 1.5), by = u(-0.5, 1.5);
        double deepest = 0.0;
        constexpr int steps = 400;
        for (int s = 0; s <= steps; ++s) {
          const double x = ax + (bx - ax) * s / steps, y = ay + (by - ay) * s / steps;
          if (one.contains(x, y)) deepest = std::max(deepest, distance_to(points, x, y));
        }
        // Of segments up to 2.9 long no point is farther than 3.6e-3 from the next sample.
        EXPECT_NEAR(one.segment_depth(ax, ay, bx, by), deepest, 4e-3);
      }
    }
  }
}

// The deepest dip of a length is that of a chord: both ends on the rim.
TEST(Perforation, NoSegmentFromOutsideDipsDeeperThanItsLengthAllows) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Uniform u(200 + seed);
    for (const Perforation& one : samples(seed)) {
      const std::vector<Point> points = rim(one);
      const double length = u(0.05, 1.2), bound = one.deepest_dip(length);
      double deepest = 0.0;
      const std::size_t starts = points.size() / 25, ends = points.size() / 200;
      for (std::size_t k = 0; k < points.size(); k += starts)
        for (std::size_t m = 0; m < points.size(); m += ends)
          if (std::hypot(points[m].x - points[k].x, points[m].y - points[k].y) <= length)
            deepest = std::max(deepest, one.segment_depth(points[k].x, points[k].y, points[m].x, points[m].y));
      EXPECT_LE(deepest, bound + 1e-12);
      const bool round = one.shape.index() == 0 || std::get<RoundedPolygon>(one.shape).core->corners().size() == 2;
      if (round) {  // a bound far too high would cost time
        EXPECT_GE(deepest, 0.8 * bound);
      }
    }
  }
}

TEST(Perforation, SignedGapIsTheLeastDistanceOfTheRims) {
  int apart = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Uniform u(300 + seed);
    const std::vector<Perforation> holes = samples(seed), others = samples(seed + 50);
    for (const Perforation& a : holes)
      for (const Perforation& b : others) {
        const double shift_x = u(-2.0, 2.0), shift_y = u(-2.0, 2.0);
        const Perforation moved = b.moved_by(shift_x, shift_y);
        const double gap = a.signed_gap(b, shift_x, shift_y);
        EXPECT_NEAR(gap, moved.signed_gap(a, 0.0, 0.0), 1e-12);
        const std::vector<Point> edge = rim(a);
        double least = std::numeric_limits<double>::infinity();
        bool overlap = false;
        for (const Point& p : edge) overlap = overlap || moved.contains(p.x, p.y);
        for (const Point& p : rim(moved)) {
          least = std::min(least, distance_to(edge, p.x, p.y));
          overlap = overlap || a.contains(p.x, p.y);
        }
        if (overlap) {
          EXPECT_LT(gap, 0.0);
        } else {
          EXPECT_NEAR(gap, least, spacing * spacing / least + 1e-4);
          ++apart;
        }
      }
  }
  EXPECT_GT(apart, 20);
}

TEST(Perforation, GapToItsImageIsThatOfTwoHoles) {
  Uniform u(400);
  for (const Perforation& one : samples(4))
    for (int k = 0; k < 20; ++k) {
      const double shift_x = u(-2.0, 2.0), shift_y = u(-2.0, 2.0);
      EXPECT_NEAR(one.gap_to_image(shift_x, shift_y), one.signed_gap(one, shift_x, shift_y), 1e-14);
    }
}

// A slot of length l and breadth b = 2 r, turned by t: its level chord through the centre is b / sin(t) where the flat
// sides bound it; lying, it is l - b + 2 sqrt(r^2 - d^2) at the height d.
TEST(Perforation, ChordsOfASlotAreExact) {
  constexpr double half = 0.4, radius = 0.1;
  const auto slot = [&](double angle) {
    const Point end{half * std::cos(angle), half * std::sin(angle)};
    return RoundedPolygon{std::make_shared<const PolygonCore>(std::vector<Point>{{-end.x, -end.y}, end}), radius};
  };
  const RoundedPolygon lying = slot(0.0);
  for (const double d : {-0.09, 0.0, 0.06})
    EXPECT_NEAR(lying.level_chord(d), 2.0 * half + 2.0 * std::sqrt(radius * radius - d * d), 1e-15) << d;
  EXPECT_EQ(lying.level_chord(0.11), 0.0);
  EXPECT_NEAR(lying.upright_chord(0.3), 2.0 * radius, 1e-15);
  EXPECT_NEAR(lying.upright_chord(0.46), 2.0 * std::sqrt(radius * radius - 0.06 * 0.06), 1e-15);
  for (const double angle : {0.5, 1.0, 2.0}) {
    EXPECT_NEAR(slot(angle).level_chord(0.0), 2.0 * radius / std::sin(angle), 1e-14) << angle;
    EXPECT_NEAR(slot(angle).upright_chord(0.0), 2.0 * radius / std::abs(std::cos(angle)), 1e-14) << angle;
  }
}

TEST(Perforation, ChordsAndSharedAreasAreThoseOfManyPoints) {
  for (const Perforation& one : samples(5)) {
    Uniform u(500);
    constexpr int steps = 2000;
    for (int k = 0; k < 10; ++k) {
      const double offset = u(-0.6, 0.6);
      int level = 0, upright = 0;
      for (int s = 0; s < steps; ++s) {
        const double along = 2.0 * (s + 0.5) / steps - 1.0;
        level += one.contains(one.x + along, one.y + offset) ? 1 : 0;
        upright += one.contains(one.x + offset, one.y + along) ? 1 : 0;
      }
      EXPECT_NEAR(one.level_chord(offset), 2.0 * level / steps, 2e-3);
      EXPECT_NEAR(one.upright_chord(offset), 2.0 * upright / steps, 2e-3);
    }
    const double distance = u(0.0, 1.0) * one.largest_extent();
    int shared = 0;
    constexpr int points = 200000;
    for (int k = 0; k < points; ++k) {  // in a box of 1.4 x 1.4 around the hole, the hole moved in any direction
      const double x = one.x + u(-0.7, 0.7), y = one.y + u(-0.7, 0.7), angle = u(0.0, 2.0 * std::numbers::pi);
      if (one.contains(x, y) && one.contains(x - distance * std::cos(angle), y - distance * std::sin(angle))) ++shared;
    }
    const double sampled = 1.96 * shared / points;  // standard error at most 1.96 x 0.5/sqrt(200000) = 0.0022
    EXPECT_NEAR(one.shared_area(distance), sampled, 5.0 * 0.0022);
  }
}

TEST(Perforation, ClearedOfDiscsItTouchesTheNearestOne) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Uniform u(600 + seed);
    for (const Perforation& one : samples(seed)) {
      std::vector<NearDisc> discs;
      while (discs.size() < 60) {
        const NearDisc disc{{u(-1.0, 1.0), u(-1.0, 1.0)}, u(0.01, 0.05)};
        if (!one.contains(one.x + disc.centre.x, one.y + disc.centre.y)) discs.push_back(disc);
      }
      const Perforation clear = one.clear_of(discs, 1.0);
      int touched = 0;
      for (const NearDisc& disc : discs) {
        const double x = one.x + disc.centre.x, y = one.y + disc.centre.y;
        EXPECT_FALSE(clear.contains(x, y, disc.radius - 1e-9));
        touched += clear.contains(x, y, disc.radius + 1e-9) ? 1 : 0;
      }
      EXPECT_GE(touched, 1);
      EXPECT_NEAR(one.clear_of({}, 0.7).reach(), 0.7, 1e-15);
    }
  }
}

TEST(PerforationLayout, SolidAreaIsCellMinusCircles) {
  const PerforationLayout layout{2.0, 3.0, {{0.5, 0.5, Circle{1.0}}, {1.5, 2.0, Circle{0.5}}}};
  EXPECT_NEAR(layout.solid_area_fraction(), 1.0 - std::numbers::pi * (0.25 + 0.0625) / 6.0, 1e-15);
}

// A hole over the corner has three images there; one over the lower edge an image at the upper one.
TEST(PerforationLayout, CutOutHasTheImagesThatReachIn) {
  const PerforationLayout layout{2.0, 3.0, {{0.1, 0.1, Circle{0.6}}, {1.0, 0.1, Circle{0.6}}, {1.0, 1.5, Circle{0.6}}}};
  EXPECT_EQ(layout.cut_out(false, false), layout.perforations);
  EXPECT_EQ(layout.cut_out(true, true).size(), 4u + 2u + 1u);
  EXPECT_EQ(layout.cut_out(true, false).size(), 2u + 1u + 1u);
  const auto upright = layout.cut_out(false, true);
  ASSERT_EQ(upright.size(), 2u + 2u + 1u);
  EXPECT_EQ(upright[1], (Perforation{0.1, 3.1, Circle{0.6}}));
  // One that just touches an edge from outside does not reach in.
  EXPECT_EQ((PerforationLayout{2.0, 2.0, {{0.25, 1.0, Circle{0.5}}}}).cut_out(true, false).size(), 1u);
}

}  // namespace
}  // namespace perfora::geometry
