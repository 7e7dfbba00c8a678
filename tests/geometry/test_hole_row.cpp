// What is here: holes as rows of numbers and back. What is not: the records they stand in (results).
#include "geometry/hole_row.h"

#include <gtest/gtest.h>

#include "geometry/make_shape.h"

namespace perfora::geometry {
namespace {

TEST(HoleRow, EveryShapeComesBack) {
  for (const ShapeKind kind : {ShapeKind::circle, ShapeKind::ellipse, ShapeKind::slot, ShapeKind::diamond,
                               ShapeKind::triangle, ShapeKind::teardrop}) {
    const Perforation hole{0.01, 0.02, make_shape(kind, {8e-3, 3e-3, 0.4, 1e-3, {}})};
    const auto again = hole_of(hole_row(hole));
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(*again, hole);
  }
  EXPECT_EQ(hole_row({0.01, 0.02, Circle{0.003}}).numbers, (std::vector<double>{0.01, 0.02, 0.003}));
}

TEST(HoleRow, WhatIsNoHoleIsNothing) {
  EXPECT_FALSE(hole_of({"star", {1, 2, 3}}).has_value());
  EXPECT_FALSE(hole_of({"circle", {1, 2}}).has_value());
  EXPECT_FALSE(hole_of({"polygon", {0, 0, 1, 0, 0}}).has_value());
  EXPECT_FALSE(hole_of({"polygon", {0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 1}}).has_value());  // crosses itself
}

}  // namespace
}  // namespace perfora::geometry
