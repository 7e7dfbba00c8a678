// What is here: shapes by name against closed forms, what is refused, outlines from text. What is not: distances
// (test_shapes_exact.cpp).
#include "geometry/make_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "geometry/outline_file.h"
#include "geometry/perforation.h"
#include "io/error.h"

namespace perfora::geometry {
namespace {

constexpr double pi = std::numbers::pi;

Perforation hole(ShapeKind kind, double length, double breadth, double angle = 0.0, double corner_radius = 0.0) {
  return {0.0, 0.0, make_shape(kind, {length, breadth, angle, corner_radius, {}})};
}

Perforation outlined(std::vector<Point> outline, double corner_radius = 0.0, double length = 0.0,
                     double breadth = 0.0) {
  return {0.0, 0.0, make_shape(ShapeKind::polygon, {length, breadth, 0.0, corner_radius, std::move(outline)})};
}

void expect_extents(const Perforation& one, double width, double height, double tolerance) {
  const Bounds box = one.bounds();
  EXPECT_NEAR(box.width(), width, tolerance);
  EXPECT_NEAR(box.height(), height, tolerance);
  EXPECT_NEAR(box.left, -0.5 * width, tolerance);
  EXPECT_NEAR(box.bottom, -0.5 * height, tolerance);
}

TEST(MakeShape, AreasAndExtentsAreThoseOfTheClosedForms) {
  const double l = 8e-3, b = 3e-3, r = 0.5e-3;
  EXPECT_NEAR(hole(ShapeKind::circle, l, 0.0).area(), 0.25 * pi * l * l, 1e-18);
  EXPECT_NEAR(hole(ShapeKind::slot, l, b).area(), (l - b) * b + 0.25 * pi * b * b, 1e-18);
  EXPECT_NEAR(hole(ShapeKind::ellipse, l, b).area(), 0.25 * pi * l * b, 1e-18);
  EXPECT_NEAR(hole(ShapeKind::diamond, l, b).area(), 0.5 * l * b, 1e-18);
  EXPECT_NEAR(hole(ShapeKind::triangle, l, b).area(), 0.5 * l * b, 1e-18);
  // Rounded: the core, its edges times the radius, a circle.
  const double edge = std::hypot(0.5 * l - r, 0.5 * b - r);
  EXPECT_NEAR(hole(ShapeKind::diamond, l, b, 0.3, r).area(),
              0.5 * (l - 2.0 * r) * (b - 2.0 * r) + 4.0 * edge * r + pi * r * r, 1e-17);
  // Two tangents from the tip to the circle, at cos(half angle) = radius/distance, and the rest of the circle.
  const double radius = 0.5 * b, distance = l - radius, half = std::acos(radius / distance);
  EXPECT_NEAR(hole(ShapeKind::teardrop, l, b).area(), radius * radius * (std::tan(half) + pi - half),
              curve_tolerance * 2.0 * pi * radius);
  for (const ShapeKind kind :
       {ShapeKind::slot, ShapeKind::diamond, ShapeKind::triangle, ShapeKind::ellipse, ShapeKind::teardrop})
    for (const double corner : {0.0, r, 0.5 * b}) {
      expect_extents(hole(kind, l, b, 0.0, corner), l, b, 2.0 * curve_tolerance);
      expect_extents(hole(kind, l, b, 0.5 * pi, corner), b, l, 2.0 * curve_tolerance);
    }
}

// The tip of a triangle and of a teardrop lies along the axis.
TEST(MakeShape, AnglesTurnAnticlockwiseFromTheXAxis) {
  for (const ShapeKind kind : {ShapeKind::triangle, ShapeKind::teardrop}) {
    const Perforation upright = hole(kind, 8e-3, 3e-3, 0.5 * pi);
    EXPECT_TRUE(upright.contains(0.0, 3.95e-3));
    EXPECT_FALSE(upright.contains(0.3e-3, 3.9e-3));
    EXPECT_FALSE(upright.contains(3.95e-3, 0.0));
  }
  const Perforation slot = hole(ShapeKind::slot, 8e-3, 2e-3, pi / 6.0);
  EXPECT_TRUE(slot.contains(3.9e-3 * std::cos(pi / 6.0), 3.9e-3 * std::sin(pi / 6.0)));
  EXPECT_FALSE(slot.contains(3.9e-3 * std::cos(pi / 6.0), -3.9e-3 * std::sin(pi / 6.0)));
}

TEST(MakeShape, RoundOnesOfEqualExtentsAreCircles) {
  for (const ShapeKind kind : {ShapeKind::ellipse, ShapeKind::slot, ShapeKind::teardrop})
    EXPECT_EQ(make_shape(kind, {5e-3, 5e-3, 0.4, 0.0, {}}), Shape(Circle{5e-3}));
  EXPECT_EQ(make_shape(ShapeKind::diamond, {5e-3, 5e-3, 0.4, 2.5e-3, {}}), Shape(Circle{5e-3}));
  // Rounder corners make a slot of a diamond.
  EXPECT_EQ(make_shape(ShapeKind::diamond, {8e-3, 2e-3, 0.0, 1e-3, {}}).index(), 1u);
  EXPECT_NEAR(hole(ShapeKind::diamond, 8e-3, 2e-3, 0.0, 1e-3).area(), hole(ShapeKind::slot, 8e-3, 2e-3).area(), 1e-18);
  EXPECT_NEAR(hole(ShapeKind::slot, 2e-3, 8e-3).area(), hole(ShapeKind::slot, 8e-3, 2e-3, 0.5 * pi).area(), 1e-18);
}

// Corners of the polygon and the middles of its edges, against the ellipse.
TEST(MakeShape, EllipsesAreWithinTheTolerance) {
  for (const double length : {1e-3, 6e-3, 20e-3, 79e-3})
    for (const double breadth : {0.05 * length, 0.4 * length, 0.9 * length, 1.5 * length}) {
      if (breadth > 79e-3) continue;
      const Perforation ellipse = hole(ShapeKind::ellipse, length, breadth);
      for (int k = 0; k < 4000; ++k) {
        const double t = 2.0 * pi * k / 4000, a = 0.5 * length, b = 0.5 * breadth;
        const double nx = b * std::cos(t), ny = a * std::sin(t), size = std::hypot(nx, ny);
        const auto off = [&](double by) {
          return ellipse.contains(a * std::cos(t) + by * nx / size, b * std::sin(t) + by * ny / size);
        };
        ASSERT_TRUE(off(-1.01 * curve_tolerance)) << length << " " << breadth << " " << t;
        ASSERT_FALSE(off(1.01 * curve_tolerance)) << length << " " << breadth << " " << t;
      }
    }
}

TEST(MakeShape, OutlinesAreStretchedAndRounded) {
  const std::vector<Point> square{{1.0, 1.0}, {3.0, 1.0}, {3.0, 3.0}, {1.0, 3.0}};
  expect_extents(outlined(square), 2.0, 2.0, 1e-15);
  expect_extents(outlined(square, 0.0, 8e-3), 8e-3, 8e-3, 1e-17);
  expect_extents(outlined(square, 0.0, 8e-3, 3e-3), 8e-3, 3e-3, 1e-17);
  EXPECT_NEAR(outlined(square, 0.25).area(), 4.0 - (4.0 - pi) * 0.0625, 1e-14);
  // Clockwise, with a corner that is none and one repeated: the same.
  EXPECT_NEAR(outlined({{1, 1}, {1, 3}, {3, 3}, {3, 3}, {3, 2}, {3, 1}}, 0.25).area(), 4.0 - (4.0 - pi) * 0.0625,
              1e-14);
  // An L has five corners that turn left and one that turns right, where the arc adds what it takes elsewhere.
  const std::vector<Point> ell{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}};
  EXPECT_NEAR(outlined(ell).area(), 6.0, 1e-14);
  EXPECT_NEAR(outlined(ell, 0.25).area(), 6.0 - 4.0 * (1.0 - 0.25 * pi) * 0.0625, 1e-5);
  EXPECT_NEAR(outlined(ell).gap_to_image(4.0, 0.0), 1.0, 1e-14);
  EXPECT_NEAR(outlined(ell).gap_to_image(1.5, 1.5), 0.5, 1e-14);  // in the bay
}

TEST(MakeShape, FaultsNameTheMember) {
  using Where = ShapeFault::Where;
  const auto where = [](ShapeKind kind, const ShapeSize& size) {
    const auto fault = fault_of(kind, size);
    EXPECT_TRUE(fault.has_value());
    EXPECT_THROW(static_cast<void>(make_shape(kind, size)), std::invalid_argument);
    return fault ? fault->where : Where::length;
  };
  EXPECT_EQ(where(ShapeKind::circle, {0.0, 1.0, 0.0, 0.0, {}}), Where::length);
  EXPECT_EQ(where(ShapeKind::slot, {1.0, 0.0, 0.0, 0.0, {}}), Where::breadth);
  EXPECT_EQ(where(ShapeKind::slot, {1.0, 0.5, std::nan(""), 0.0, {}}), Where::angle);
  EXPECT_EQ(where(ShapeKind::diamond, {1.0, 0.5, 0.0, 0.3, {}}), Where::corner_radius);
  EXPECT_EQ(where(ShapeKind::teardrop, {1.0, 1.5, 0.0, 0.0, {}}), Where::breadth);
  EXPECT_EQ(where(ShapeKind::polygon, {1.0, 0.0, 0.0, 0.0, {{0, 0}, {1, 0}}}), Where::outline);
  EXPECT_EQ(where(ShapeKind::polygon, {1.0, 0.0, 0.0, 0.0, {{0, 0}, {1, 1}, {2, 2}}}), Where::outline);
  EXPECT_EQ(where(ShapeKind::polygon, {1.0, 0.0, 0.0, 0.0, {{0, 0}, {1, 1}, {1, 0}, {0, 1}}}), Where::outline);
  EXPECT_EQ(where(ShapeKind::polygon, {0.0, 0.0, 0.0, 0.6, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}), Where::corner_radius);
}

TEST(OutlineFile, ReadsWktAndTables) {
  const auto read = parse_wkt_polygon(" polygon((0 0, 1e-3 0,\n 0.5e-3 2e-3, 0 0) ) ");
  ASSERT_EQ(read.index(), 0u);
  EXPECT_EQ(std::get<0>(read), (std::vector<Point>{{0, 0}, {1e-3, 0}, {0.5e-3, 2e-3}}));
  for (const char* text :
       {"POINT (1 2)", "POLYGON (0 0, 1 0, 1 1)", "POLYGON ((0 0, 1, 1 1))", "POLYGON ((0 0, 1 0 5))",
        "POLYGON ((0 0, 1 0, 1 1), (0.1 0.1, 0.2 0.1, 0.2 0.2))", "POLYGON ((0 0, 1 0, 1 1)) x", "POLYGON EMPTY", ""})
    EXPECT_EQ(parse_wkt_polygon(text).index(), 1u) << text;
  const auto path = std::filesystem::temp_directory_path() / "perfora_outline_of_this_test";
  std::ofstream(path) << "x,y\n0,0\n1,0\n1,1\n0,0\n";
  EXPECT_EQ(read_outline(path).size(), 3u);
  std::ofstream(path) << "POLYGON ((0 0, 1 0, 1 1, 0 0))\n";
  EXPECT_EQ(read_outline(path), (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}}));
  std::ofstream(path) << "POLYGON ((0 0, 1 0, 1 1, 0 0)\n";
  EXPECT_THROW(static_cast<void>(read_outline(path)), io::InputError);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace perfora::geometry
