// What is here: labels beside points hide nothing where there is room, and as little as they can where there is not.
// What is not: how they are drawn (test_plot.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "report/label_places.h"

namespace perfora::report {
namespace {

constexpr double radius = 5.0, width = 16.0, height = 11.0;
const Box area{100.0, 50.0, 400.0, 300.0};

double overlap(const Box& a, const Box& b) {
  return std::max(0.0, std::min(a.right(), b.right()) - std::max(a.x, b.x)) *
         std::max(0.0, std::min(a.bottom(), b.bottom()) - std::max(a.y, b.y));
}

struct Point {
  double x, y;
};

Box square(const Point& point) {
  return {point.x - radius, point.y - radius, 2.0 * radius, 2.0 * radius};
}

std::vector<Box> place_all(const std::vector<Point>& points) {
  LabelPlaces places(area);
  for (const Point& point : points) places.keep_clear(point.x, point.y, radius);
  std::vector<Box> labels;
  for (const Point& point : points) labels.push_back(places.place(point.x, point.y, radius, width, height));
  return labels;
}

TEST(LabelPlaces, ALonePointHasItsLabelOnTheUpperRight) {
  const auto labels = place_all({{300.0, 200.0}});
  EXPECT_GT(labels[0].x, 300.0 + radius);
  EXPECT_LT(labels[0].bottom(), 200.0 - radius);
}

// Two points nearer than their labels are wide, in any direction: 24 places leave room for both.
TEST(LabelPlaces, PairsOfNearPointsHideNothing) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(area.x, area.right()), y(area.y, area.bottom()), shift(-12.0, 12.0);
    Point first{x(random), y(random)};
    Point second{std::clamp(first.x + shift(random), area.x, area.right()),
                 std::clamp(first.y + shift(random), area.y, area.bottom())};
    const auto labels = place_all({first, second});
    for (const Box& label : labels) {
      EXPECT_EQ(overlap(label, square(first)), 0.0) << "seed " << seed;
      EXPECT_EQ(overlap(label, square(second)), 0.0) << "seed " << seed;
      EXPECT_NEAR(overlap(label, area), width * height, 1e-9) << "seed " << seed;
    }
    EXPECT_EQ(overlap(labels[0], labels[1]), 0.0) << "seed " << seed;
  }
}

// Points too many for the room around them still get a label each, within reach of the point.
TEST(LabelPlaces, CrowdedPointsKeepTheirLabelsNear) {
  const std::vector<Point> points(40, Point{300.0, 200.0});
  for (const Box& label : place_all(points)) {
    EXPECT_NEAR(label.x + 0.5 * width, 300.0, radius + 18.0 + 0.5 * width + 1e-9);
    EXPECT_NEAR(label.y + 0.5 * height, 200.0, radius + 18.0 + 0.5 * height + 1e-9);
  }
}

// Three points in a row, so near that the labels beside the outer ones would cover them: all three labels are free, and
// what always standing on the upper right would cover is not.
TEST(LabelPlaces, ChoosesWhatCoversLeast) {
  const std::vector<Point> points{{300.0, 200.0}, {306.0, 194.0}, {312.0, 188.0}};
  const auto labels = place_all(points);
  double covered = 0.0, naive = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k)
    for (std::size_t l = 0; l < points.size(); ++l) {
      covered += overlap(labels[k], square(points[l])) + (k < l ? overlap(labels[k], labels[l]) : 0.0);
      const Box upper_right{points[k].x + radius, points[k].y - radius - height, width, height};
      naive += overlap(upper_right, square(points[l]));
    }
  EXPECT_EQ(covered, 0.0);
  EXPECT_GT(naive, 20.0);
}

}  // namespace
}  // namespace perfora::report
