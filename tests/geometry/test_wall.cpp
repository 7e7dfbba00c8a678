// What is here: the thinnest wall: closed forms, and the Apollonius graph against the definition over many random
// layouts.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/layout.h"
#include "geometry/random.h"
#include "geometry/wall.h"

namespace perfora::geometry {
namespace {

/// Holes at random; `scale` is their mean diameter over the mean spacing, so that above 1 many overlap and nest.
PerforationLayout random_layout(int count, double scale, std::uint64_t seed) {
  PerforationLayout layout{0.15, 0.10, {}};
  const double spacing = std::sqrt(layout.width * layout.height / count);
  for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(count); ++k) {
    const auto place = uniform_pair(seed, RandomStream::hole_place, k);
    const auto size = uniform_pair(seed, RandomStream::hole_jitter, k);
    // A third power: a few large holes, many small ones, which is what nests.
    const double diameter = spacing * scale * (0.05 + 2.0 * size[0] * size[0] * size[0]);
    layout.perforations.push_back({place[0] * layout.width, place[1] * layout.height, Circle{diameter}});
  }
  return layout;
}

void expect_same(const PerforationLayout& layout, const std::string& what) {
  const ThinnestWall exact = thinnest_wall_brute_force(layout), graph = thinnest_wall_apollonius(layout);
  EXPECT_NEAR(graph.thickness, exact.thickness, 1e-12) << what;
  EXPECT_GE(graph.first, 0);
  EXPECT_LE(graph.first, graph.second);
}

TEST(ThinnestWall, NoHolesNoWall) {
  for (const ThinnestWall& wall :
       {thinnest_wall_brute_force({1.0, 1.0, {}}), thinnest_wall_apollonius({1.0, 1.0, {}})}) {
    EXPECT_TRUE(std::isinf(wall.thickness));
    EXPECT_EQ(wall.first, -1);
  }
}

TEST(ThinnestWall, OneHoleFacesItsOwnImage) {
  const PerforationLayout layout{0.15, 0.10, {{0.02, 0.03, Circle{0.04}}}};
  for (const ThinnestWall& wall : {thinnest_wall_brute_force(layout), thinnest_wall_apollonius(layout)}) {
    EXPECT_NEAR(wall.thickness, 0.06, 1e-15);
    EXPECT_EQ(wall.first, 0);
    EXPECT_EQ(wall.second, 0);
  }
}

TEST(ThinnestWall, AcrossThePeriodicBoundary) {
  const PerforationLayout layout{0.15, 0.10, {{0.001, 0.05, Circle{0.01}}, {0.14, 0.05, Circle{0.002}}}};
  for (const ThinnestWall& wall : {thinnest_wall_brute_force(layout), thinnest_wall_apollonius(layout)})
    EXPECT_NEAR(wall.thickness, 0.011 - 0.006, 1e-15);
}

TEST(ThinnestWall, NestedAndEqualHoles) {
  const PerforationLayout nested{
      1.0, 1.0, {{0.5, 0.5, Circle{0.4}}, {0.55, 0.5, Circle{0.1}}, {0.1, 0.1, Circle{0.05}}}};
  EXPECT_NEAR(thinnest_wall_apollonius(nested).thickness, 0.05 - 0.2 - 0.05, 1e-15);
  const PerforationLayout nested_first{
      1.0, 1.0, {{0.55, 0.5, Circle{0.1}}, {0.5, 0.5, Circle{0.4}}, {0.1, 0.1, Circle{0.05}}}};
  EXPECT_NEAR(thinnest_wall_apollonius(nested_first).thickness, 0.05 - 0.2 - 0.05, 1e-15);
  const PerforationLayout equal{1.0, 1.0, {{0.5, 0.5, Circle{0.4}}, {0.5, 0.5, Circle{0.4}}}};
  EXPECT_NEAR(thinnest_wall_apollonius(equal).thickness, -0.4, 1e-15);
}

TEST(ThinnestWall, ApolloniusAgreesWithTheDefinitionOverRandomLayouts) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
    for (double scale : {0.3, 1.0, 2.0}) {
      PerforationLayout layout = random_layout(2 + static_cast<int>(seed % 40), scale, seed);
      expect_same(layout, "seed " + std::to_string(seed) + ", scale " + std::to_string(scale));
      layout.perforations.push_back(layout.perforations.front());  // an equal hole
      expect_same(layout, "with an equal hole, seed " + std::to_string(seed));
      Perforation inner = layout.perforations[1];  // one that touches another from inside
      inner.x += 0.25 * inner.largest_extent();
      inner.shape = Circle{0.5 * inner.largest_extent()};
      if (inner.x < layout.width) layout.perforations.push_back(inner);
      expect_same(layout, "with a nested hole, seed " + std::to_string(seed));
    }
}

TEST(ThinnestWall, ApolloniusAgreesOnLattices) {
  for (int side : {2, 3, 6}) {  // every gap is met by ties, and four holes are equally near
    LayoutOptions options;
    options.rows = options.columns = side;
    expect_same(place_perforations(options, 1), "square");
  }
}

TEST(ThinnestWall, ManyHolesUseTheGraph) {
  const PerforationLayout layout = random_layout(600, 0.3, 5);
  EXPECT_NEAR(thinnest_wall(layout).thickness, thinnest_wall_brute_force(layout).thickness, 1e-12);
}

}  // namespace
}  // namespace perfora::geometry
