// What is here: properties every packing must have, over seeds and by brute force, and measures of lattices known by
// hand.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "geometry/make_packing.h"
#include "geometry/packing.h"
#include "io/error.h"
#include "tests/geometry/brute_force.h"

namespace perfora::geometry {
namespace {

constexpr double side = 0.02;  // m: about 1,300 discs of Table 1's law at fraction 0.719, 1,550 at jamming

Packing pack(double fraction, std::uint64_t seed, PackingProtocol protocol = PackingProtocol::dilate) {
  PackingOptions options;
  options.solid_fraction = fraction;
  options.protocol = protocol;
  return make_packing(options, side, side, seed, 1);
}

double area_fraction(const Packing& packing) {
  double area = 0.0;
  for (double r : packing.radius) area += std::numbers::pi * r * r;
  return area / (packing.width * packing.height);
}

TEST(Packing, DilatedMeetsItsFractionWithoutOverlap) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (double fraction : {0.5, 0.719}) {
      const Packing packing = pack(fraction, seed);
      EXPECT_TRUE(packing.quality.reached) << packing.quality.reason;
      EXPECT_NEAR(area_fraction(packing), fraction, 1e-9);
      EXPECT_NEAR(packing.mean_diameter(), 0.5044e-3, 5e-4 * 0.5044e-3);
      EXPECT_LE(brute_force::max_overlap_ratio(packing), 0.0);
      EXPECT_TRUE(brute_force::all_inside(packing));
      EXPECT_EQ(packing.quality.coordination_number, 0.0);
      EXPECT_EQ(packing.quality.rattler_fraction, 1.0);
    }
}

TEST(Packing, JammedIsNearlyIsostaticAndKeepsTheOverlapLimit) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Packing packing = pack(0.0, seed);
    EXPECT_TRUE(packing.quality.reached) << packing.quality.reason;
    EXPECT_LE(brute_force::max_overlap_ratio(packing), 1e-3);
    EXPECT_NEAR(brute_force::max_overlap_ratio(packing), packing.quality.max_overlap_ratio, 1e-9);
    EXPECT_TRUE(brute_force::all_inside(packing));
    // docs/user/theory.md: 0.84 to 0.86 for this law; 1,500 discs scatter by about 0.002.
    EXPECT_GT(packing.quality.solid_fraction, 0.84);
    EXPECT_LT(packing.quality.solid_fraction, 0.86);
    EXPECT_NEAR(packing.quality.jamming_fraction, packing.quality.solid_fraction, 1e-9);
    EXPECT_NEAR(packing.mean_diameter(), 0.5044e-3, 3e-3 * 0.5044e-3);
    // Frictionless discs at jamming: 2 d = 4 contacts a disc (isostatic, O'Hern et al. 2003).
    EXPECT_NEAR(packing.quality.coordination_number, 4.0, 0.15);
    EXPECT_LT(packing.quality.rattler_fraction, 0.15);
  }
}

TEST(Packing, ContactsPointEverywhereAlike) {
  // Second and fourth moments of the contact angle; about 9,000 contacts, standard error 0.0075 of a mean cosine.
  double cos2 = 0.0, sin2 = 0.0, cos4 = 0.0;
  int contacts = 0;
  for (std::uint64_t seed = 11; seed <= 13; ++seed) {
    const Packing packing = pack(0.0, seed);
    for (std::size_t i = 0; i < packing.x.size(); ++i)
      for (std::size_t j = i + 1; j < packing.x.size(); ++j) {
        if (brute_force::periodic_distance(packing, i, j) >= packing.radius[i] + packing.radius[j]) continue;
        const double angle = std::atan2(std::remainder(packing.y[i] - packing.y[j], packing.height),
                                        std::remainder(packing.x[i] - packing.x[j], packing.width));
        cos2 += std::cos(2.0 * angle);
        sin2 += std::sin(2.0 * angle);
        cos4 += std::cos(4.0 * angle);
        ++contacts;
      }
  }
  // <cos^2> = (1 + <cos 2a>)/2: 2 % of 1/2 is 0.02 of <cos 2a>; three standard errors here.
  EXPECT_NEAR(cos2 / contacts, 0.0, 0.025);
  EXPECT_NEAR(sin2 / contacts, 0.0, 0.025);
  EXPECT_NEAR(cos4 / contacts, 0.0, 0.025);
}

TEST(Packing, QuenchMeetsItsFractionWithinTheOverlapLimit) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Packing packing = pack(0.719, seed, PackingProtocol::quench);
    EXPECT_TRUE(packing.quality.reached) << packing.quality.reason;
    EXPECT_NEAR(area_fraction(packing), 0.719, 1e-9);
    EXPECT_LE(brute_force::max_overlap_ratio(packing), 1e-3);
    EXPECT_TRUE(brute_force::all_inside(packing));
  }
}

TEST(Packing, AFractionThatIsNotReachedIsAStatus) {
  for (PackingProtocol protocol : {PackingProtocol::dilate, PackingProtocol::quench}) {
    const Packing packing = pack(0.89, 1, protocol);
    EXPECT_FALSE(packing.quality.reached);
    EXPECT_FALSE(packing.quality.reason.empty());
  }
  EXPECT_THAT(pack(0.89, 1).quality.reason, testing::HasSubstr("wanted solid fraction 89 %, compaction reached 8"));
}

TEST(Packing, SameBitsForAnyNumberOfThreads) {
  PackingOptions options;
  options.protocol = PackingProtocol::quench;
  options.solid_fraction = 0.70;
  const double large = 0.06;  // about 11,500 discs: enough for two threads
  const Packing one = make_packing(options, large, large, 5, 1), two = make_packing(options, large, large, 5, 2);
  EXPECT_EQ(one.x, two.x);
  EXPECT_EQ(one.y, two.y);
  EXPECT_EQ(one.radius, two.radius);
  EXPECT_EQ(one.quality.iterations, two.quality.iterations);
}

TEST(Packing, SeedsGiveOtherPlacesOfEquallyManyDiscs) {
  const Packing first = pack(0.719, 1, PackingProtocol::quench), again = pack(0.719, 1, PackingProtocol::quench),
                other = pack(0.719, 2, PackingProtocol::quench);
  EXPECT_EQ(first.x, again.x);
  EXPECT_NE(first.x, other.x);
  EXPECT_EQ(first.size(), other.size());
  PackingOptions options;
  options.solid_fraction = 0.719;
  EXPECT_EQ(first.size(), expected_discs(options, side, side));
}

TEST(Packing, OneSizeAndSmallOrLongCells) {
  PackingOptions options;
  options.mean_diameter = options.maximum_diameter = 1e-3;
  options.size_ratio = 1.0;
  options.solid_fraction = 0.6;
  for (auto [width, height] : {std::pair{0.005, 0.005}, {0.05, 0.004}, {0.004, 0.03}}) {
    const Packing packing = make_packing(options, width, height, 1, 2);
    EXPECT_TRUE(packing.quality.reached) << packing.quality.reason;
    EXPECT_LE(brute_force::max_overlap_ratio(packing), 1e-3);
    EXPECT_NEAR(area_fraction(packing), 0.6, 1e-9);
  }
}

TEST(Packing, RefusesWhatCannotBe) {
  const auto refusal = [](PackingOptions options, double width) -> std::string {
    try {
      make_packing(options, width, 0.02, 1, 1);
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "";
  };
  PackingOptions options;
  EXPECT_THAT(refusal(options, 0.002), testing::HasSubstr("packing.maximum_diameter"));
  EXPECT_THAT(refusal(options, 0.0), testing::HasSubstr("the cell has no size"));
  EXPECT_THAT(refusal(options, 1000.0), testing::HasSubstr("at most 5000000 discs"));
  options.solid_fraction = 1e-6;
  EXPECT_THAT(refusal(options, 0.02), testing::HasSubstr("fewer than 16 discs"));
  options.solid_fraction = -0.1;
  EXPECT_THAT(refusal(options, 0.02), testing::HasSubstr("packing.solid_fraction"));
  options = {};
  options.protocol = PackingProtocol::quench;
  EXPECT_THAT(refusal(options, 0.02), testing::HasSubstr("packing.solid_fraction: a quench"));
  options = {};
  options.mean_diameter = 2e-3;
  EXPECT_THAT(refusal(options, 0.02), testing::HasSubstr("packing.mean_diameter"));
}

TEST(MeasurePacking, TriangularLatticeHasSixContacts) {
  constexpr int columns = 8, rows = 8;
  Packing packing;
  packing.width = columns;
  packing.height = rows * std::sqrt(0.75);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      packing.x.push_back(column + (row % 2 == 1 ? 0.5 : 0.0));
      packing.y.push_back(row * std::sqrt(0.75));
      packing.radius.push_back(0.5 * (1.0 + 1e-4));
    }
  const PackingQuality quality = measure_packing(packing);
  EXPECT_NEAR(quality.coordination_number, 6.0, 1e-12);
  EXPECT_EQ(quality.rattler_fraction, 0.0);
  EXPECT_NEAR(quality.max_overlap_ratio, 1e-4, 1e-7);
  EXPECT_NEAR(quality.solid_fraction, std::numbers::pi / std::sqrt(12.0) * (1.0 + 1e-4) * (1.0 + 1e-4), 1e-12);
}

TEST(MeasurePacking, DiscsThatLeanOnRattlersAreRattlersToo) {
  Packing chain;  // five in a row: the ends have one contact, then the next ones lose theirs
  chain.width = chain.height = 20.0;
  for (int k = 0; k < 5; ++k) {
    chain.x.push_back(3.0 + 0.999 * k);
    chain.y.push_back(5.0);
    chain.radius.push_back(0.5);
  }
  const PackingQuality quality = measure_packing(chain);
  EXPECT_EQ(quality.coordination_number, 0.0);
  EXPECT_EQ(quality.rattler_fraction, 1.0);
}

PackingOptions imported(const std::filesystem::path& file) {
  PackingOptions options;
  options.file = file;
  return options;
}

TEST(ImportPacking, ReadsWrapsAndMeasures) {
  const std::filesystem::path csv =
      std::filesystem::path(testing::TempDir()) / ("discs-" + std::to_string(::getpid()) + ".csv");
  std::ofstream(csv) << "x,y,radius\n0.001,0.001,0.0005\n0.0119,0.001,0.0005\n-0.001,0.011,0.0005\n";
  const Packing packing = import_packing(imported(csv), 0.01, 0.01);
  ASSERT_EQ(packing.size(), 3);
  EXPECT_NEAR(packing.x[1], 0.0019, 1e-15);
  EXPECT_NEAR(packing.x[2], 0.009, 1e-15);
  EXPECT_NEAR(packing.quality.max_overlap_ratio, 0.1, 1e-9);
  EXPECT_EQ(packing.key.protocol, "imported");
  PackingOptions options;
  options.file = csv;
  EXPECT_EQ(packing.key, packing_key(options, 0.01, 0.01, 7));
  EXPECT_EQ(make_packing(options, 0.01, 0.01, 7, 1).x, packing.x);
  std::ofstream(csv) << "x,y,radius\n0.001,0.001,0.0005\n0.001,0.002,-1\n";
  try {
    import_packing(imported(csv), 0.01, 0.01);
    FAIL();
  } catch (const io::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(csv.string() + ":3: packing.file"));
  }
  std::filesystem::remove(csv);
}

// What no packing can be: a disc twice, also as its own image across the boundary; a small disc within a large one;
// more discs than room; a disc that is wide for the cell.
TEST(ImportPacking, RefusesWhatIsNoPacking) {
  const std::filesystem::path csv =
      std::filesystem::path(testing::TempDir()) / ("no-packing-" + std::to_string(::getpid()) + ".csv");
  std::string frames = "x,y,radius\n";
  for (int k = 0; k < 300; ++k) frames += fmt::format("{},{},0.0004\n", 0.0001 * (k % 97), 0.0001 * (k % 89));
  const std::pair<std::string, std::string> cases[] = {
      {"x,y,radius\n0.001,0.001,0.0005\n0.005,0.005,0.0005\n0.001,0.001,0.0005\n",
       ":4: packing.file: this disc and the one of line 2"},
      {"x,y,radius\n0,0.001,0.0005\n0.01,0.001,0.0005\n", ":3: packing.file: this disc and the one of line 2"},
      {"x,y,radius\n0.001,0.001,0.001\n0.0012,0.001,0.0005\n", ":3: packing.file: this disc and the one of line 2"},
      {frames, "times the area of the cell"},
      {"x,y,radius\n0.001,0.001,0.0005\n0.005,0.005,0.0018\n", ":3: packing.file: a disc of this radius"}};
  for (const auto& [text, complaint] : cases) {
    std::ofstream(csv) << text;
    try {
      import_packing(imported(csv), 0.01, 0.01);
      ADD_FAILURE() << complaint;
    } catch (const io::InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(complaint));
    }
  }
  std::filesystem::remove(csv);
}

// Discs of one diameter: the densest lattice has pi/sqrt(12) = 0.9069; jammed at random they reach 0.82 to 0.90, and
// all have the diameter asked for.
TEST(MakePacking, DiscsOfOneDiameter) {
  PackingOptions options;
  options.mean_diameter = options.maximum_diameter = 1e-3;
  options.size_ratio = 1.0;
  options.solid_fraction = 0.719;
  const Packing packing = make_packing(options, 0.02, 0.02, 1, 1);
  EXPECT_TRUE(packing.quality.reached) << packing.quality.reason;
  EXPECT_NEAR(packing.quality.solid_fraction, 0.719, 1e-9);
  const auto [smallest, largest] = std::minmax_element(packing.radius.begin(), packing.radius.end());
  EXPECT_NEAR(*smallest, *largest, 1e-15);
}

}  // namespace
}  // namespace perfora::geometry
