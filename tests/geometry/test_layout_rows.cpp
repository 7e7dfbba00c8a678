// What is here: rows with profiles, weak ends, ribs, spreads and the oblique family against plane geometry. What is
// not: random placement (test_layout_points.cpp), the other lattices (test_layout_lattice.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "geometry/layout.h"
#include "geometry/layout_rows.h"
#include "geometry/wall.h"
#include "io/error.h"

namespace perfora::geometry {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pointwise;

/// Rounding of coordinates in a cell of 0.15 m.
constexpr double rounding = 1e-15;

LayoutOptions in_rows(LayoutFamily family, int rows, int columns, double diameter) {
  LayoutOptions options;
  options.family = family;
  options.width = 0.150;
  options.height = 0.100;
  options.rows = rows;
  options.columns = columns;
  options.diameter = diameter;
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

std::vector<double> lengths(const PerforationLayout& layout) {
  std::vector<double> found;
  for (const Perforation& hole : layout.perforations) found.push_back(hole.largest_extent());
  return found;
}

TEST(RowProfile, IsLinearBetweenControlValuesAtEqualDistances) {
  const auto profile = [](const std::vector<double>& values, int rows) {
    std::vector<double> found;
    for (int row = 0; row < rows; ++row) found.push_back(row_profile(values, row, rows));
    return found;
  };
  EXPECT_THAT(profile({8.0}, 3), ElementsAre(8.0, 8.0, 8.0));
  EXPECT_THAT(profile({8.0, 10.0}, 5), ElementsAre(8.0, 8.5, 9.0, 9.5, 10.0));
  EXPECT_THAT(profile({8.0, 10.0}, 1), ElementsAre(9.0));
  EXPECT_THAT(profile({1.0, 3.0, 2.0}, 5), ElementsAre(1.0, 2.0, 3.0, 2.5, 2.0));
  EXPECT_THAT(profile({1.0, 3.0, 2.0}, 1), ElementsAre(3.0));
  EXPECT_THAT(profile({1.0, 3.0, 2.0}, 2), ElementsAre(1.0, 2.0));
  // As many values as rows: each its own, to the last bit, also where 1/(rows - 1) is no binary fraction.
  const std::vector<double> own{0.1, 0.7, 0.3, 0.9, 0.2, 0.8, 0.6};
  EXPECT_EQ(profile(own, 7), own);
}

TEST(RowProfile, KeepsItsFormWhenTheNumberOfRowsChanges) {
  const std::vector<double> values{5.0, 9.0, 6.0};
  for (int rows : {3, 5, 9, 17})
    for (int row = 0; row < rows; ++row)
      EXPECT_NEAR(row_profile(values, row, rows), row_profile(values, 2 * row, 2 * rows - 1), 1e-14);
}

TEST(Rows, WithoutProfilesAreTheStaggeredFamilyToTheLastBit) {
  for (int rows : {2, 6, 10}) {
    LayoutOptions options = in_rows(LayoutFamily::rows, rows, 7, 0.004);
    options.stagger = 0.37;
    options.jitter = 0.0005;
    const auto own = place_perforations(options, 5).perforations;
    options.family = LayoutFamily::staggered;
    EXPECT_EQ(own, place_perforations(options, 5).perforations);
  }
}

TEST(Rows, WithOneProfileValueARowAreTheGradedFamily) {
  LayoutOptions graded = in_rows(LayoutFamily::graded, 5, 6, 0.010);
  graded.grading = 0.4;
  LayoutOptions own = in_rows(LayoutFamily::rows, 5, 6, 0.010);
  own.stagger = 0.0;
  own.row_diameter = {0.008, 0.012};
  const auto expected = make_layout(graded, 1).perforations, found = make_layout(own, 1).perforations;
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].x, expected[k].x);
    EXPECT_EQ(found[k].y, expected[k].y);
    EXPECT_NEAR(found[k].largest_extent(), expected[k].largest_extent(), rounding);
  }
}

// The pattern of 20 rows and 12 columns at a pitch of 12.5 mm: lengths 8.5 to 10.5 mm, walls beside the slots 4 to 2 mm
// and 3 mm between rows.
TEST(Rows, GradedSlotsHaveTheWallsOfTheirLengths) {
  LayoutOptions options = in_rows(LayoutFamily::rows, 20, 12, 0.0095);
  options.shape = ShapeKind::slot;
  options.breadth = 0.002;
  options.row_diameter = {0.0085, 0.0105};
  const PerforationLayout layout = make_layout(options, 1);
  ASSERT_EQ(layout.perforations.size(), 240U);
  double area = 0.0;
  for (int row = 0; row < 20; ++row) {
    const double length = 0.0085 + 0.002 * row / 19.0;
    area += 12 * (0.002 * (length - 0.002) + std::numbers::pi * 0.001 * 0.001);
    for (int column = 0; column < 12; ++column) {
      const Perforation& hole = layout.perforations[static_cast<std::size_t>(row * 12 + column)];
      EXPECT_NEAR(hole.largest_extent(), length, rounding);
      EXPECT_NEAR(hole.smallest_extent(), 0.002, rounding);
      EXPECT_NEAR(hole.y, 0.0025 + 0.005 * row, 2 * rounding);
      EXPECT_NEAR(std::remainder(hole.x - (column + (row % 2 == 0 ? 0.5 : 1.0)) * 0.0125, 0.150), 0.0, 4 * rounding);
    }
  }
  EXPECT_NEAR(1.0 - layout.solid_area_fraction(), area / 0.015, 1e-12);
  EXPECT_NEAR(thinnest_wall(layout).thickness, 0.002, 1e-12);  // beside the slots of the top row
}

TEST(Rows, HaveTheirOwnHeightShiftCountAndAngle) {
  LayoutOptions options = in_rows(LayoutFamily::rows, 3, 5, 0.004);
  options.shape = ShapeKind::ellipse;
  options.row_aspect = {2.0, 4.0};
  options.row_angle = {0.0, std::numbers::pi / 2.0};
  options.row_columns = {4.0, 9.0};
  options.row_height = {1.0, 2.0, 1.0};
  options.row_shift = {0.0, 0.25};
  options.stagger = 0.5;
  const PerforationLayout layout = make_layout(options, 1);
  ASSERT_EQ(layout.perforations.size(), 4U + 7U + 9U);  // 6.5 is rounded up
  EXPECT_EQ(hole_count(options), 20);
  const std::vector<int> counts{4, 7, 9};
  const std::vector<double> centres{0.0125, 0.050, 0.0875}, shifts{0.0, 0.125 + 0.5, 0.25}, aspects{2.0, 3.0, 4.0};
  std::size_t k = 0;
  for (std::size_t row = 0; row < 3; ++row)
    for (int column = 0; column < counts[row]; ++column, ++k) {
      const Perforation& hole = layout.perforations[k];
      EXPECT_NEAR(hole.y, centres[row], 4 * rounding);
      EXPECT_NEAR(std::remainder(hole.x - (column + 0.5 + shifts[row]) * 0.150 / counts[row], 0.150), 0.0,
                  4 * rounding);
      EXPECT_NEAR(hole.area(), std::numbers::pi / 4.0 * 0.004 * 0.004 / aspects[row], 1e-9);
    }
  const Bounds upright = layout.perforations.back().bounds();
  EXPECT_NEAR(upright.height(), 0.004, 2.0 * curve_tolerance);
  EXPECT_NEAR(upright.width(), 0.001, 2.0 * curve_tolerance);
}

TEST(Rows, ShiftAtRandomStaysWithinItsSpreadAndFollowsTheSeed) {
  LayoutOptions options = in_rows(LayoutFamily::rows, 40, 6, 0.001);
  options.shift_spread = 0.2;
  const LayoutOptions still = [&] {
    LayoutOptions copy = options;
    copy.shift_spread = 0.0;
    return copy;
  }();
  const auto base = place_perforations(still, 1).perforations;
  double sum = 0.0, farthest = 0.0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto moved = place_perforations(options, seed).perforations;
    EXPECT_EQ(moved, place_perforations(options, seed).perforations);
    for (std::size_t row = 0; row < 40; ++row) {
      const double by = std::remainder(moved[row * 6].x - base[row * 6].x, 0.150) / 0.025;
      for (std::size_t column = 0; column < 6; ++column)
        EXPECT_NEAR(std::remainder(moved[row * 6 + column].x - base[row * 6 + column].x, 0.150) / 0.025, by, 1e-10);
      sum += by;
      farthest = std::max(farthest, std::abs(by));
    }
  }
  EXPECT_LE(farthest, 0.2 + 1e-10);
  EXPECT_GT(farthest, 0.19);
  EXPECT_NEAR(sum / 2000.0, 0.0, 4.0 * 0.2 / std::sqrt(3.0 * 2000.0));  // four standard errors of a uniform spread
}

TEST(Rows, WeakEndsHaveLongerHolesOfTheGivenBreadthOrAspect) {
  LayoutOptions options = in_rows(LayoutFamily::square, 5, 4, 0.006);
  options.shape = ShapeKind::slot;
  options.aspect = 3.0;
  options.weak_end = WeakEnd::bottom;
  options.weak_rows = 2;
  options.weak_factor = 1.5;
  const auto long_rows = [](const LayoutOptions& of) {
    std::vector<bool> found;
    const PerforationLayout layout = make_layout(of, 1);
    for (int row = 0; row < of.rows; ++row)
      found.push_back(layout.perforations[static_cast<std::size_t>(row * of.columns)].largest_extent() > 0.007);
    return found;
  };
  EXPECT_THAT(long_rows(options), ElementsAre(true, true, false, false, false));
  EXPECT_NEAR(make_layout(options, 1).perforations[0].largest_extent(), 0.009, rounding);
  EXPECT_NEAR(make_layout(options, 1).perforations[0].smallest_extent(), 0.003, rounding);
  options.aspect = 1.0;
  options.breadth = 0.002;
  options.weak_end = WeakEnd::both;
  options.weak_rows = 1;
  EXPECT_THAT(long_rows(options), ElementsAre(true, false, false, false, true));
  EXPECT_NEAR(make_layout(options, 1).perforations[0].smallest_extent(), 0.002, rounding);
  options.weak_end = WeakEnd::top;
  EXPECT_THAT(long_rows(options), ElementsAre(false, false, false, false, true));
}

// 6 rows with a rib of 4 mm above the second, fourth and sixth: the rows share 100 - 12 mm.
TEST(Rows, RibsStandBetweenGroupsOfRows) {
  LayoutOptions options = in_rows(LayoutFamily::staggered, 6, 4, 0.008);
  options.rib_every = 2;
  options.rib_thickness = 0.004;
  const PerforationLayout layout = make_layout(options, 1);
  for (int row = 0; row < 6; ++row)
    EXPECT_NEAR(layout.perforations[static_cast<std::size_t>(row * 4)].y, (row + 0.5) * 0.088 / 6.0 + 0.004 * (row / 2),
                2 * rounding);
  options.rib_thickness = 0.034;
  EXPECT_THAT(refusal(options), HasSubstr("layout.rib_thickness: 3 ribs of 34 mm leave no room"));
}

TEST(Spreads, SizesAreEvenSoThatTheMeanStaysAndSeedsShuffleThem) {
  LayoutOptions options = in_rows(LayoutFamily::square, 5, 8, 0.008);
  options.size_spread = 0.25;
  std::vector<double> expected;
  for (int k = 0; k < 40; ++k) expected.push_back(0.008 * (1.0 + 0.25 * ((2.0 * k + 1.0) / 40.0 - 1.0)));
  std::set<std::vector<double>> orders;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<double> found = lengths(make_layout(options, seed));
    orders.insert(found);
    std::sort(found.begin(), found.end());
    EXPECT_THAT(found, Pointwise(DoubleNear(rounding), expected));
  }
  EXPECT_EQ(orders.size(), 20U);
}

TEST(Spreads, AnglesLieWithinTheirSpreadAndHerringboneTurnsEveryOtherRow) {
  LayoutOptions options = in_rows(LayoutFamily::square, 4, 5, 0.008);
  options.shape = ShapeKind::slot;
  options.breadth = 0.002;
  options.angle = 0.3;
  options.herringbone = true;
  // A slot at an angle a is (L - B) cos a + B wide; the sign of a shows in which way its box leans: by the chord above
  // the middle, which lies to the right for a > 0.
  const auto leans_right = [](const Perforation& hole) { return hole.contains(hole.x + 0.0025, hole.y + 0.0009); };
  const PerforationLayout layout = make_layout(options, 1);
  for (std::size_t k = 0; k < 20; ++k) {
    const Bounds box = layout.perforations[k].bounds();
    EXPECT_NEAR(box.right - box.left, 0.006 * std::cos(0.3) + 0.002, 1e-12);
    EXPECT_EQ(leans_right(layout.perforations[k]), k / 5 % 2 == 0);
  }
  options.herringbone = false;
  options.angle = 0.0;
  options.angle_spread = 0.5;
  double smallest = 1.0, largest = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const Perforation& hole : make_layout(options, seed).perforations) {
      const Bounds box = hole.bounds();
      const double angle = std::acos(std::min(1.0, (box.right - box.left - 0.002) / 0.006));
      smallest = std::min(smallest, angle);
      largest = std::max(largest, angle);
    }
  EXPECT_LE(largest, 0.5 + 1e-9);
  EXPECT_GT(largest, 0.48);
  EXPECT_LT(smallest, 0.05);
  EXPECT_EQ(place_perforations(options, 3).perforations, place_perforations(options, 3).perforations);
}

TEST(Oblique, ColumnsRiseByTheirShareOfAPitchAndMeetAcrossTheWidth) {
  for (int climb : {-3, 1, 2, 5}) {
    LayoutOptions options = in_rows(LayoutFamily::oblique, 4, 6, 0.002);
    options.climb = climb;
    const PerforationLayout layout = make_layout(options, 1);
    ASSERT_EQ(layout.perforations.size(), 24U);
    const double pitch_x = 0.025, pitch_y = 0.025;
    const auto hole_at = [&](double x, double y) {
      return std::any_of(layout.perforations.begin(), layout.perforations.end(), [&](const Perforation& hole) {
        return std::hypot(std::remainder(hole.x - x, 0.150), std::remainder(hole.y - y, 0.100)) < 1e-14;
      });
    };
    for (const Perforation& hole : layout.perforations) {
      EXPECT_TRUE(hole_at(hole.x + pitch_x, hole.y + climb * pitch_y / 6.0));  // also from the last column to the first
      EXPECT_TRUE(hole_at(hole.x, hole.y + pitch_y));
    }
  }
  LayoutOptions options = in_rows(LayoutFamily::oblique, 4, 6, 0.002);
  options.climb = 0;
  const auto upright = place_perforations(options, 1).perforations;
  options.family = LayoutFamily::square;
  EXPECT_EQ(upright, place_perforations(options, 1).perforations);
}

// Neighbours lie a pitch above each other and (width/columns, climb/columns pitches) aside.
TEST(Oblique, ThinnestWallIsThatOfItsLattice) {
  LayoutOptions options = in_rows(LayoutFamily::oblique, 4, 6, 0.010);
  options.climb = 2;
  EXPECT_NEAR(thinnest_wall(make_layout(options, 1)).thickness, 0.025 - 0.010, 1e-15);
  options.columns = 10;  // 15 mm apart, each a fifth of 25 mm higher
  EXPECT_NEAR(thinnest_wall(make_layout(options, 1)).thickness, std::hypot(0.015, 0.005) - 0.010, 1e-15);
}

TEST(Sizes, RefuseWhatContradictsItself) {
  LayoutOptions options = in_rows(LayoutFamily::square, 4, 5, 0.008);
  options.aspect = 2.0;
  EXPECT_THAT(refusal(options), HasSubstr("layout.aspect: a circle is as broad as it is long"));
  options.shape = ShapeKind::ellipse;
  EXPECT_EQ(refusal(options), "");
  options.breadth = 0.003;
  EXPECT_THAT(refusal(options), HasSubstr("layout.breadth: the breadth follows from layout.aspect already"));
  options.aspect = 1.0;
  EXPECT_EQ(refusal(options), "");
  options.family = LayoutFamily::rows;
  options.row_breadth = {0.003};
  options.row_aspect = {2.0};
  EXPECT_THAT(refusal(options), HasSubstr("layout.row_breadth: the breadth follows from layout.row_aspect already"));
  options.row_aspect.clear();
  options.row_diameter = {0.008, 0.032};
  EXPECT_THAT(refusal(options), HasSubstr("layout.row_diameter: holes"));
}

}  // namespace
}  // namespace perfora::geometry
