// What is here: the 150 x 150 mm packing of Table 1. Numbers from the paper's Table 1 and
// docs/user/theory.md.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/cell_grid.h"
#include "geometry/clip.h"
#include "geometry/layout.h"
#include "geometry/make_packing.h"

namespace perfora::geometry {
namespace {

constexpr double mean_diameter = 0.5044e-3;

/// Pairs with a centre distance of at most three mean diameters, twice, over the discs.
double bonds_per_disc(const Packing& packing) {
  const double reach = 3.0 * mean_diameter;
  struct Point {
    double x, y;
  };
  const CellGrid grid(packing.width, packing.height, reach, packing.x.size(), [&](std::size_t i) {
    return Point{packing.x[i], packing.y[i]};
  });
  std::int64_t ends = 0;
  for (std::size_t i = 0; i < packing.x.size(); ++i)
    grid.for_each_near(packing.x[i], packing.y[i], [&](std::int32_t other) {
      const std::size_t j = static_cast<std::size_t>(other);
      const double dx = std::remainder(packing.x[i] - packing.x[j], packing.width);
      const double dy = std::remainder(packing.y[i] - packing.y[j], packing.height);
      if (j != i && dx * dx + dy * dy <= reach * reach) ++ends;
    });
  return static_cast<double>(ends) / packing.size();
}

TEST(Table1Packing, CountsSizesAndBonds) {
  PackingOptions options;
  options.solid_fraction = 0.719;
  const Packing packing = make_packing(options, 0.15, 0.15, 1, 2);
  EXPECT_TRUE(packing.quality.reached) << packing.quality.reason;
  EXPECT_EQ(packing.quality.max_overlap_ratio, 0.0);
  EXPECT_NEAR(bonds_per_disc(packing), 23.0, 0.5);  // the paper's text: "23"
  const Packing clipped = clip_packing(packing, make_layout({}, 1), ClipRule::centre);
  EXPECT_NEAR(clipped.size(), 36607, 366);
  EXPECT_NEAR(clipped.mean_diameter(), mean_diameter, 3e-3 * mean_diameter);
  EXPECT_NEAR(bonds_per_disc(clipped), 21.03, 0.03 * 21.03);
}

TEST(Table1Packing, JammedKeepsItsMeanDiameterAndOverlapLimit) {
  const PackingOptions options;
  const Packing packing = make_packing(options, 0.15, 0.15, 1, 2);
  EXPECT_TRUE(packing.quality.reached) << packing.quality.reason;
  EXPECT_LE(packing.quality.max_overlap_ratio, 1e-3);
  EXPECT_NEAR(packing.mean_diameter(), mean_diameter, 3e-3 * mean_diameter);
  EXPECT_NEAR(packing.quality.coordination_number, 4.0, 0.1);
}

}  // namespace
}  // namespace perfora::geometry
