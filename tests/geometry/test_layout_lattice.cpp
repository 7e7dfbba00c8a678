// What is here: the rotated and the graded family against plane geometry: neighbours, symmetry, periods, diameters,
// walls, porosity. What is not: the other families (test_layout.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/layout.h"
#include "geometry/wall.h"
#include "io/error.h"

namespace perfora::geometry {
namespace {

using testing::HasSubstr;

/// Rounding of coordinates in a cell of 0.15 m: a few units in the last place of double.
constexpr double rounding = 1e-15;

struct Vector {
  double x, y;
};

LayoutOptions rotated(int rows, int columns, int turn) {
  LayoutOptions options;
  options.family = LayoutFamily::rotated;
  options.rows = rows;
  options.columns = columns;
  options.turn = turn;
  options.diameter = 0.001;
  return options;
}

LayoutOptions graded(int rows, int columns, double diameter, double grading) {
  LayoutOptions options;
  options.family = LayoutFamily::graded;
  options.rows = rows;
  options.columns = columns;
  options.diameter = diameter;
  options.grading = grading;
  return options;
}

std::string refusal(const LayoutOptions& options) {
  try {
    make_layout(options, 1);
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "";
}

/// Steps from hole `from` to every other hole and to all their images in the cells around, its own included.
std::vector<Vector> steps_from(const PerforationLayout& layout, std::size_t from) {
  std::vector<Vector> steps;
  const Perforation& own = layout.perforations[from];
  for (std::size_t k = 0; k < layout.perforations.size(); ++k)
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b) {
        const Perforation& hole = layout.perforations[k];
        if (k != from || a != 0 || b != 0)
          steps.push_back({hole.x - own.x + a * layout.width, hole.y - own.y + b * layout.height});
      }
  return steps;
}

/// Whether a hole stands at (x, y), periods taken.
bool hole_at(const PerforationLayout& layout, double x, double y) {
  for (const Perforation& hole : layout.perforations)
    if (std::hypot(std::remainder(hole.x - x, layout.width), std::remainder(hole.y - y, layout.height)) < 4 * rounding)
      return true;
  return false;
}

TEST(Rotated, WithoutATurnIsTheSquareFamilyToTheLastBit) {
  for (int rows : {1, 3, 6, 7})
    for (int columns : {1, 2, 5, 6, 11}) {
      LayoutOptions options = rotated(rows, columns, 0);
      options.jitter = 0.0005;
      const auto turned = place_perforations(options, 3).perforations;
      options.family = LayoutFamily::square;
      EXPECT_EQ(turned, place_perforations(options, 3).perforations) << rows << " x " << columns;
    }
}

TEST(Rotated, EveryHoleHasFourNeighboursAtRightAnglesAndTheTurn) {
  for (int side = 1; side <= 7; ++side)
    for (int turn = -8; turn <= 8; ++turn) {
      SCOPED_TRACE(std::to_string(side) + " turned by " + std::to_string(turn));
      const PerforationLayout layout = make_layout(rotated(side, side, turn), 1);
      const auto holes = static_cast<std::size_t>(side * side + turn * turn);
      ASSERT_EQ(layout.perforations.size(), holes);
      // n holes in a square cell of side L, each at the corner of squares of area L^2/n.
      const double pitch = layout.width / std::sqrt(static_cast<double>(holes));
      for (std::size_t k = 0; k < holes; ++k) {
        std::vector<Vector> nearest;
        for (const Vector& step : steps_from(layout, k)) {
          const double distance = std::hypot(step.x, step.y);
          ASSERT_GT(distance, pitch - 4 * rounding);
          if (distance < pitch + 4 * rounding) nearest.push_back(step);
        }
        ASSERT_EQ(nearest.size(), 4u);
        const double angle = std::atan2(turn, side);
        for (const Vector& step : nearest)  // along the turned axes: an angle of turn plus quarters of a circle
          EXPECT_NEAR(std::sin(2.0 * (std::atan2(step.y, step.x) - angle)), 0.0, 1e-12);
        int along = 0;
        for (const Vector& step : nearest)
          along += std::hypot(step.x - pitch * std::cos(angle), step.y - pitch * std::sin(angle)) < 4 * rounding;
        EXPECT_EQ(along, 1);  // and so the other three: four directions at multiples of a right angle
      }
      EXPECT_NEAR(thinnest_wall(layout).thickness, pitch - 0.001, 4 * rounding);
    }
}

TEST(Rotated, CellIsStretchedWithTheLattice) {
  // Steps (W rows, H turn)/n and (-W turn, H columns)/n of any cell; n holes that all of them lead to one another.
  for (const auto& [rows, columns, turn] :
       {std::array{3, 5, 1}, {4, 2, 3}, {6, 3, -2}, {6, 4, 2}, {1, 1, 9}, {8, 6, -4}, {2, 9, 6}}) {
    SCOPED_TRACE(testing::Message() << rows << " x " << columns << " turned by " << turn);
    LayoutOptions options = rotated(rows, columns, turn);
    options.width = 0.12;
    options.height = 0.20;
    options.diameter = 1e-4;
    const PerforationLayout layout = make_layout(options, 1);
    const int holes = rows * columns + turn * turn;
    ASSERT_EQ(layout.perforations.size(), static_cast<std::size_t>(holes));
    for (const Perforation& hole : layout.perforations) {
      EXPECT_TRUE(hole.x >= 0.0 && hole.x < layout.width && hole.y >= 0.0 && hole.y < layout.height);
      EXPECT_TRUE(hole_at(layout, hole.x + 0.12 * rows / holes, hole.y + 0.20 * turn / holes));
      EXPECT_TRUE(hole_at(layout, hole.x - 0.12 * turn / holes, hole.y + 0.20 * columns / holes));
    }
    EXPECT_GT(thinnest_wall(layout).thickness, 0.0);  // so no two of them are the same
    EXPECT_NEAR(layout.solid_area_fraction(), 1.0 - holes * std::numbers::pi * 0.25e-8 / 0.024, 1e-14);
  }
}

TEST(Rotated, WallOfAStretchedLatticeIsThatOfItsShortestStep) {
  // 3 x 3 turned by 1 in 200 x 100 mm: steps of (60, 10) and (-20, 30) mm; their sums are longer.
  LayoutOptions options = rotated(3, 3, 1);
  options.width = 0.2;
  options.height = 0.1;
  options.diameter = 0.02;
  EXPECT_NEAR(thinnest_wall(make_layout(options, 1)).thickness, std::hypot(0.02, 0.03) - 0.02, 4 * rounding);
}

TEST(Rotated, TurnedTheOtherWayIsTheMirrorImage) {
  for (int turn : {1, 2, 3, 5}) {
    const PerforationLayout left = make_layout(rotated(4, 6, turn), 1), right = make_layout(rotated(4, 6, -turn), 1);
    ASSERT_EQ(left.perforations.size(), right.perforations.size());
    for (const Perforation& hole : left.perforations) EXPECT_TRUE(hole_at(right, left.width - hole.x, hole.y)) << turn;
  }
}

TEST(Rotated, JitterMovesEveryHoleWithinItsRadius) {
  LayoutOptions options = rotated(5, 5, 3);
  const PerforationLayout regular = place_perforations(options, 1);
  options.jitter = 0.002;
  double farthest = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PerforationLayout moved = place_perforations(options, seed);
    for (std::size_t k = 0; k < moved.perforations.size(); ++k) {
      const Perforation &from = regular.perforations[k], &to = moved.perforations[k];
      farthest =
          std::max(farthest, std::hypot(std::remainder(to.x - from.x, 0.15), std::remainder(to.y - from.y, 0.15)));
    }
  }
  EXPECT_LE(farthest, 0.002 + rounding);
  EXPECT_GT(farthest, 0.0018);
}

TEST(Rotated, RefusesTooManyAndTooLargeHolesByTheirKey) {
  LayoutOptions options = rotated(6, 6, 101);
  EXPECT_THAT(refusal(options), HasSubstr("layout.turn: 10237 holes are too many"));  // 36 + 101^2
  options = rotated(101, 100, 1);
  EXPECT_THAT(refusal(options), HasSubstr("layout.rows: 10101 holes are too many"));
  options = rotated(2, 2, std::numeric_limits<int>::min());
  EXPECT_THAT(refusal(options), HasSubstr("holes are too many"));
  options = rotated(6, 6, 2);  // 40 holes: a pitch of 150/sqrt(40) = 23.717 mm
  options.diameter = 0.024;
  EXPECT_THAT(refusal(options), HasSubstr("layout.diameter: holes "));
  EXPECT_THAT(refusal(options), HasSubstr("overlap by 282.9 um"));
  options.rows = 0;
  EXPECT_THAT(refusal(options), HasSubstr("layout.rows"));
}

TEST(Graded, DiametersAreLinearFromTheBottomRowToTheTop) {
  for (int rows : {2, 3, 6, 9})
    for (double grading : {-0.5, 0.0, 0.3, 0.9}) {
      const auto holes = place_perforations(graded(rows, 4, 0.008, grading), 1).perforations;
      ASSERT_EQ(holes.size(), static_cast<std::size_t>(4 * rows));
      double sum = 0.0;
      for (const Perforation& hole : holes) {
        // The share of the height that the row is at, from 0 at the lowest centre to 1 at the highest.
        const double fraction = (hole.y - 0.075 / rows) / (0.15 - 0.15 / rows);
        EXPECT_NEAR(hole.largest_extent(), 0.008 * (1.0 + grading * (fraction - 0.5)), rounding);
        sum += hole.largest_extent();
      }
      EXPECT_NEAR(sum / (4.0 * rows), 0.008, rounding);
      EXPECT_NEAR(holes.front().largest_extent(), 0.008 * (1.0 - grading / 2.0), rounding);
      EXPECT_LT(holes.front().y, holes.back().y);
    }
}

TEST(Graded, StandsWhereTheSquareFamilyStands) {
  LayoutOptions options = graded(5, 7, 0.010, 0.0);
  options.jitter = 0.001;
  const auto without = place_perforations(options, 2).perforations;
  options.grading = 0.6;
  const auto with = place_perforations(options, 2).perforations;
  options.family = LayoutFamily::square;
  EXPECT_EQ(without, place_perforations(options, 2).perforations);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t k = 0; k < with.size(); ++k) {
    EXPECT_EQ(with[k].x, without[k].x);
    EXPECT_EQ(with[k].y, without[k].y);
  }
}

TEST(Graded, WallsBetweenRowsShrinkTowardsTheLargeOnes) {
  const int rows = 6;
  const double diameter = 0.015, grading = 0.4, pitch = 0.025;
  const auto holes = make_layout(graded(rows, 6, diameter, grading), 1).perforations;
  for (int row = 0; row + 1 < rows; ++row) {
    const auto below = static_cast<std::size_t>(6 * row);
    EXPECT_NEAR(holes[below].signed_gap(holes[below + 6], 0.0, 0.0),
                pitch - diameter * (1.0 + grading * ((row + 0.5) / (rows - 1) - 0.5)), 4 * rounding);
  }
  // Across the border the largest row meets the smallest: their mean is the mean of all.
  EXPECT_NEAR(holes.back().signed_gap(holes[5], 0.0, 0.15), pitch - diameter, 4 * rounding);
}

TEST(Graded, ThinnestWallLiesAlongTheLargestRowOrBelowIt) {
  for (double grading : {-0.4, 0.3})
    for (int columns : {4, 6}) {  // pitches of 37.5 and 25 mm along a row, 25 mm between rows
      const double along = 0.15 / columns - 0.02 * (1.0 + std::abs(grading) / 2.0);
      const double between = 0.025 - 0.02 * (1.0 + std::abs(grading) * (0.5 - 0.1));  // of the two largest of six rows
      const PerforationLayout layout = place_perforations(graded(6, columns, 0.02, grading), 1);
      EXPECT_NEAR(thinnest_wall(layout).thickness, std::min(along, between), 4 * rounding);
      EXPECT_NEAR(thinnest_wall_apollonius(layout).thickness, std::min(along, between), 4 * rounding);
    }
}

TEST(Graded, PorosityExceedsThatOfEqualHolesByTheVarianceOfTheRows) {
  // Of n evenly spread numbers from -1/2 to 1/2 the mean square is (n + 1)/(12 (n - 1)).
  for (int rows : {2, 5, 6}) {
    const PerforationLayout layout = place_perforations(graded(rows, 6, 0.012, 0.8), 1);
    const double spread = 0.8 * 0.8 * (rows + 1.0) / (12.0 * (rows - 1.0));
    const double porosity = 6 * rows * std::numbers::pi * 0.25 * 0.012 * 0.012 * (1.0 + spread) / 0.0225;
    EXPECT_NEAR(1.0 - layout.solid_area_fraction(), porosity, 1e-14);
  }
}

TEST(Graded, RefusesWhatCannotBe) {
  EXPECT_THAT(refusal(graded(1, 6, 0.01, 0.3)),
              HasSubstr("layout.rows: one row cannot be graded from bottom to top; 2 or more rows"));
  for (double grading : {1.9, -1.9, 5.0, std::nan("")})
    EXPECT_THAT(refusal(graded(6, 6, 0.01, grading)), HasSubstr("layout.grading"));
  EXPECT_EQ(refusal(graded(6, 6, 0.01, 1.8)), "");
  EXPECT_THAT(refusal(graded(2, 1, 0.12, 0.6)),
              HasSubstr("layout.diameter: hole 2 of 156 mm is larger than the cell; less than 150 mm; "
                        "lower the diameter, take a grading nearer to 0 or enlarge the cell"));
  EXPECT_THAT(refusal(graded(6, 6, 0.02, 0.6)), HasSubstr("overlap by 1 mm"));  // the top row: 26 mm, pitch 25 mm
  LayoutOptions thin = graded(6, 6, 0.02, 0.3);
  thin.minimum_wall = 0.003;
  EXPECT_THAT(refusal(thin), HasSubstr("is 2 mm; at least the minimum wall of 3 mm"));
}

}  // namespace
}  // namespace perfora::geometry
