// What is here: packings of the public face held against those of the rooms, bit by bit; files read back. What is not:
// how packings are made (tests/geometry).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "optimize/evaluate/evaluation.h"
#include "perfora/pack.h"
#include "tests/perfora/face_support.h"

namespace perfora {
namespace {

TEST(PublicPacking, IsThatOfTheRoomsToTheLastBit) {
  PackOptions options;
  options.threads = 1;
  options.replicate = 1;
  const Packing packing = pack(small_block(), options);
  const auto file = optimize::DesignFile::from_toml(optimize::small_design, "design");
  const optimize::PackedDesign wanted = optimize::pack_design(file, {}, 1);
  EXPECT_EQ(packing.status, Status::completed);
  EXPECT_EQ(packing.discs.x, wanted.clipped.x);
  EXPECT_EQ(packing.discs.y, wanted.clipped.y);
  EXPECT_EQ(packing.discs.radius, wanted.clipped.radius);
  EXPECT_EQ(packing.periodic.x, wanted.periodic.x);
  EXPECT_EQ(packing.measure("solid_fraction"), wanted.summary.solid_fraction);
  EXPECT_EQ(packing.measure("discs"), static_cast<double>(wanted.clipped.size()));
  EXPECT_EQ(packing.measure("bonds_per_disc"), wanted.summary.bonds_per_disc);
  EXPECT_EQ(packing.width, 0.012);
}

// A hole of 6 mm in 12 x 12 mm: pi/16 of the cell, a wall of 6 mm to its own image.
TEST(PublicPacking, HoleIsAPolygonOfItsArea) {
  const Packing packing = pack(small_block());
  EXPECT_NEAR(packing.measure("porosity"), std::numbers::pi / 16.0, 1e-12);
  EXPECT_NEAR(packing.measure("thinnest_wall"), 0.006, 1e-12);
  ASSERT_EQ(packing.openings.size(), 1U);
  const Outline& rim = packing.openings.front();
  ASSERT_GE(rim.x.size(), 32U);
  double area = 0.0;
  for (std::size_t k = 0; k < rim.x.size(); ++k) {
    const std::size_t next = (k + 1) % rim.x.size();
    area += 0.5 * (rim.x[k] * rim.y[next] - rim.x[next] * rim.y[k]);
  }
  const double circle = 0.25 * std::numbers::pi * 0.006 * 0.006;
  EXPECT_NEAR(area / circle, 1.0, 1e-3);  // positive: anticlockwise
  EXPECT_LT(area, circle);
}

TEST(PublicPacking, FileHoldsThePackingThatWasGiven) {
  const DesignFolder folder;
  PackOptions options;
  options.file = folder / "p.h5";
  const Packing made = pack(small_block(), options);
  const Packing read = read_packing(options.file);
  EXPECT_EQ(read.discs.x, made.discs.x);
  EXPECT_EQ(read.periodic.radius, made.periodic.radius);
  EXPECT_EQ(read.openings.front().x, made.openings.front().x);
  ASSERT_EQ(read.measures.size(), made.measures.size());
  for (const Measure& measure : made.measures) EXPECT_EQ(read.measure(measure.key), measure.value) << measure.key;
  EXPECT_THAT(error_of([&] { static_cast<void>(pack(small_block(), options)); }),
              ::testing::HasSubstr("already exists; `force` replaces it"));
  options.force = true;
  EXPECT_EQ(error_of([&] { static_cast<void>(pack(small_block(), options)); }), "");
}

TEST(PublicPacking, ErrorsCarryNoPrivateType) {
  const DesignFolder folder;
  EXPECT_NE(error_of([&] { static_cast<void>(read_packing(folder / "none.h5")); }), "");
  EXPECT_NE(error_of([&] { static_cast<void>(read_packing(folder.file("text.h5", "no HDF5"))); }), "");
  const Packing packing = pack(small_block());
  EXPECT_THAT(error_of([&] { static_cast<void>(packing.measure("porosty")); }),
              ::testing::HasSubstr("did you mean \"porosity\"?"));
}

}  // namespace
}  // namespace perfora
