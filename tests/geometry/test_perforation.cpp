// What is here: the three questions asked of a circular hole, against plane geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/perforation.h"

namespace perfora::geometry {
namespace {

const Perforation hole{1.0, 2.0, 0.6};

TEST(Perforation, ContainsPointsNearerThanItsRadius) {
  EXPECT_TRUE(hole.contains(1.0, 2.0));
  EXPECT_TRUE(hole.contains(1.29, 2.0));
  EXPECT_FALSE(hole.contains(1.31, 2.0));
}

TEST(Perforation, SegmentDepthIsRadiusMinusDistanceToTheSegment) {
  EXPECT_DOUBLE_EQ(hole.segment_depth(0.0, 2.1, 2.0, 2.1), 0.3 - 0.1);  // a chord at 0.1 from the centre
  EXPECT_DOUBLE_EQ(hole.segment_depth(0.0, 2.5, 2.0, 2.5), 0.0);        // passes outside
  EXPECT_NEAR(hole.segment_depth(0.0, 2.0, 0.8, 2.0), 0.1, 1e-15);      // ends inside, 0.2 from the centre
  EXPECT_DOUBLE_EQ(hole.segment_depth(0.0, 2.0, 0.5, 2.0), 0.0);        // points at it and stops before
  EXPECT_NEAR(hole.segment_depth(1.1, 2.0, 1.1, 2.0), 0.2, 1e-15);      // a point
}

TEST(Perforation, SignedGapOfApartOverlappingNestedAndEqualHoles) {
  EXPECT_NEAR(hole.signed_gap({2.0, 2.0, 0.4}, 0.0, 0.0), 1.0 - 0.3 - 0.2, 1e-15);
  EXPECT_NEAR(hole.signed_gap({2.0, 2.0, 0.4}, -0.9, 0.0), 0.1 - 0.5, 1e-15);
  EXPECT_NEAR(hole.signed_gap({2.0, 2.0, 0.4}, 3.0, 3.0), std::hypot(4.0, 3.0) - 0.5, 1e-15);
  const Perforation inner{1.05, 2.0, 0.2};
  EXPECT_LE(hole.signed_gap(inner, 0.0, 0.0), -inner.diameter);
  EXPECT_DOUBLE_EQ(hole.signed_gap(hole, 0.0, 0.0), -hole.diameter);
}

TEST(PerforationLayout, SolidAreaIsCellMinusCircles) {
  const PerforationLayout layout{2.0, 3.0, {{0.5, 0.5, 1.0}, {1.5, 2.0, 0.5}}};
  EXPECT_NEAR(layout.solid_area_fraction(), 1.0 - std::numbers::pi * (0.25 + 0.0625) / 6.0, 1e-15);
}

}  // namespace
}  // namespace perfora::geometry
