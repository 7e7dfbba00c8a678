// What is here: points at even distances, and random placement of unequal holes and shapes, over many seeds. What is
// not: equal circles at random (test_layout.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/cell_grid.h"
#include "geometry/layout.h"
#include "geometry/layout_points.h"
#include "geometry/wall.h"
#include "io/error.h"

namespace perfora::geometry {
namespace {

using testing::HasSubstr;

constexpr double width = 0.150, height = 0.100;

double smallest_distance(const std::vector<Point>& points, double w, double h) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = a + 1; b < points.size(); ++b)
      smallest = std::min(smallest, std::hypot(std::remainder(points[a].x - points[b].x, w),
                                               std::remainder(points[a].y - points[b].y, h)));
  return smallest;
}

bool inside(const std::vector<Point>& points, double w, double h) {
  return std::all_of(points.begin(), points.end(),
                     [&](const Point& p) { return p.x >= 0.0 && p.x < w && p.y >= 0.0 && p.y < h; });
}

// The triangular lattice of pitch 1 has one point on sqrt(3)/2.
TEST(Points, LargestDistanceIsThatOfTheTriangularLattice) {
  EXPECT_DOUBLE_EQ(largest_distance(10.0, 8.0 * std::sqrt(3.0) / 2.0, 80), 1.0);
}

// Lagae and Dutre 2008 call point sets of relative radius 0.65 to 0.85 good Poisson-disc sets; random sequential
// addition jams at 0.777. Independent points have some 0.02.
TEST(Points, BlueNoiseHasARelativeRadiusAbove070OverManySeeds) {
  for (const int count : {12, 60, 200})
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      const std::vector<Point> points = blue_noise_points(width, height, count, seed);
      ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
      EXPECT_TRUE(inside(points, width, height));
      EXPECT_GE(smallest_distance(points, width, height) / largest_distance(width, height, count), 0.70)
          << count << " points, seed " << seed;
      EXPECT_EQ(points, blue_noise_points(width, height, count, seed));
    }
  EXPECT_NE(blue_noise_points(width, height, 60, 1), blue_noise_points(width, height, 60, 2));
}

/// Second moment of the points' Voronoi cells about their points over (area of a cell)^2 and number of points, and the
/// largest distance of a point from the centroid of its cell, by the nearest point of every node of a fine grid.
struct CellMeasures {
  double moment = 0.0, off_centre = 0.0;
};

CellMeasures cells_of(const std::vector<Point>& points, double w, double h, int nodes) {
  const std::size_t n = points.size();
  std::vector<double> sum_x(n), sum_y(n), count(n);
  double squares = 0.0;
  for (int a = 0; a < nodes; ++a)
    for (int b = 0; b < nodes; ++b) {
      const double x = (a + 0.5) * w / nodes, y = (b + 0.5) * h / nodes;
      std::size_t nearest = 0;
      double best = std::numeric_limits<double>::infinity(), best_x = 0.0, best_y = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const double dx = nearest_image(x - points[k].x, w, 0.5 * w), dy = nearest_image(y - points[k].y, h, 0.5 * h);
        if (dx * dx + dy * dy < best) best = dx * dx + dy * dy, nearest = k, best_x = dx, best_y = dy;
      }
      squares += best;
      sum_x[nearest] += best_x, sum_y[nearest] += best_y, count[nearest] += 1.0;
    }
  CellMeasures found;
  const double cell = w * h / static_cast<double>(n);
  found.moment = 0.5 * squares / (static_cast<double>(nodes) * nodes) / cell;
  for (std::size_t k = 0; k < n; ++k)
    found.off_centre = std::max(found.off_centre, std::hypot(sum_x[k], sum_y[k]) / count[k]);
  return found;
}

// A centroidal tessellation has each point at the centroid of its cell. The second moment a dimension of a cell over
// its area squared is least for the regular hexagon, 5/(36 sqrt(3)) = 0.0802 (Newman 1982), and 1/12 for the square.
TEST(Points, VoronoiPointsAreTheCentroidsOfTheirCells) {
  for (const int count : {9, 40, 90})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const std::vector<Point> points = voronoi_points(width, height, count, seed);
      ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
      EXPECT_TRUE(inside(points, width, height));
      EXPECT_EQ(points, voronoi_points(width, height, count, seed));
      const CellMeasures cells = cells_of(points, width, height, 400);
      EXPECT_LT(cells.off_centre, 0.01 * largest_distance(width, height, count)) << count << ", seed " << seed;
      EXPECT_GT(cells.moment, 0.0801);
      EXPECT_LT(cells.moment, 1.0 / 12.0);
      EXPECT_GT(smallest_distance(points, width, height) / largest_distance(width, height, count), 0.75);
    }
}

TEST(Points, FewPointsAndNarrowCellsWork) {
  for (const int count : {1, 2, 3, 5})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      EXPECT_EQ(blue_noise_points(0.150, 0.010, count, seed).size(), static_cast<std::size_t>(count));
      const std::vector<Point> points = voronoi_points(0.150, 0.010, count, seed);
      EXPECT_EQ(points.size(), static_cast<std::size_t>(count));
      EXPECT_TRUE(inside(points, 0.150, 0.010));
    }
}

LayoutOptions at_random(int count, double diameter) {
  LayoutOptions options;
  options.family = LayoutFamily::random;
  options.width = width;
  options.height = height;
  options.count = count;
  options.diameter = diameter;
  return options;
}

TEST(RandomPlacement, UnequalCirclesKeepTheMinimumWallOverManySeeds) {
  LayoutOptions options = at_random(40, 0.010);
  options.size_spread = 0.5;
  options.minimum_wall = 0.0016;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const PerforationLayout layout = make_layout(options, seed);
    ASSERT_EQ(layout.perforations.size(), 40U);
    EXPECT_GE(thinnest_wall_brute_force(layout).thickness, 0.0016 - 1e-12);
    EXPECT_EQ(layout.perforations, make_layout(options, seed).perforations);
    // 40 sizes spread evenly from 5 to 15 mm: sum of squares (1 + s^2 (1 - 1/n^2)/3) n d^2.
    EXPECT_NEAR(1.0 - layout.solid_area_fraction(),
                std::numbers::pi / 4.0 * 40 * 1e-4 * (1.0 + 0.25 / 3.0 * (1.0 - 1.0 / 1600.0)) / 0.015, 1e-12);
  }
}

// Walls and discs cover 68 % of the cell: beyond where random sequential addition gets.
TEST(RandomPlacement, UnequalCirclesGoBeyondWhereSequentialAdditionSticks) {
  LayoutOptions options = at_random(60, 0.013);
  options.size_spread = 0.3;
  options.minimum_wall = 0.0016;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    EXPECT_GE(thinnest_wall_brute_force(make_layout(options, seed)).thickness, 0.0016 - 1e-12);
}

TEST(RandomPlacement, SlotsAtRandomAnglesKeepTheMinimumWall) {
  LayoutOptions options = at_random(60, 0.0075);
  options.shape = ShapeKind::slot;
  options.breadth = 0.0022;
  options.angle_spread = 0.7;
  options.minimum_wall = 0.0016;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PerforationLayout layout = make_layout(options, seed);
    EXPECT_GE(thinnest_wall_brute_force(layout).thickness, 0.0016 - 1e-12);
    EXPECT_EQ(layout.perforations, make_layout(options, seed).perforations);
  }
}

TEST(RandomPlacement, ThatDoesNotFitSaysSo) {
  LayoutOptions options = at_random(400, 0.0075);
  options.shape = ShapeKind::slot;
  options.breadth = 0.0060;
  std::string told;
  try {
    make_layout(options, 1);
  } catch (const io::InputError& error) {
    told = error.what();
  }
  EXPECT_THAT(told, HasSubstr("layout.count: 400 holes"));
  EXPECT_THAT(told, HasSubstr("do not fit at random"));
}

TEST(RandomPlacement, PlacesOfBlueNoiseAndVoronoiTakeEveryShape) {
  for (const Placement placement : {Placement::blue_noise, Placement::voronoi}) {
    LayoutOptions options = at_random(60, 0.008);
    options.placement = placement;
    options.shape = ShapeKind::diamond;
    options.aspect = 1.5;
    const auto points = placement == Placement::voronoi ? voronoi_points(width, height, 60, 9)
                                                        : blue_noise_points(width, height, 60, 9);
    const PerforationLayout layout = make_layout(options, 9);
    for (std::size_t k = 0; k < 60; ++k)
      EXPECT_EQ((Point{layout.perforations[k].x, layout.perforations[k].y}), points[k]);
    EXPECT_NEAR(1.0 - layout.solid_area_fraction(), 60 * 0.5 * 0.008 * 0.008 / 1.5 / 0.015, 1e-12);
  }
}

}  // namespace
}  // namespace perfora::geometry
