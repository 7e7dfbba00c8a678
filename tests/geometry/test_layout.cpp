// What is here: families of layouts against plane geometry, and the messages of what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "geometry/layout.h"
#include "geometry/wall.h"
#include "io/error.h"

namespace perfora::geometry {
namespace {

using testing::HasSubstr;

/// The sentence an InputError says, or "" when nothing is refused.
std::string refusal(const LayoutOptions& options, std::uint64_t seed = 1) {
  try {
    make_layout(options, seed);
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "";
}

class TemporaryCsv {
 public:
  explicit TemporaryCsv(const std::string& text)
      : path_(std::filesystem::path(testing::TempDir()) / ("holes-" + std::to_string(::getpid()) + ".csv")) {
    std::ofstream(path_) << text;
  }
  ~TemporaryCsv() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(Layout, Table1SquareHas36HolesAndWallsOf5Millimetres) {
  const PerforationLayout layout = make_layout({}, 1);
  ASSERT_EQ(layout.perforations.size(), 36u);
  EXPECT_NEAR(thinnest_wall(layout).thickness, 0.005, 1e-15);  // pitch 25 mm, holes 20 mm
  EXPECT_NEAR(layout.solid_area_fraction(), 1.0 - 36 * std::numbers::pi * 1e-4 / 0.0225, 1e-14);
  EXPECT_NEAR(layout.perforations[0].x, 0.0125, 1e-15);
}

TEST(Layout, StaggeredShiftsEveryOtherRow) {
  LayoutOptions options;
  options.family = LayoutFamily::staggered;
  for (double stagger : {0.0, 0.2, 0.5, 1.0}) {
    options.stagger = stagger;
    options.columns = 5;  // pitch 30 mm along a row, 25 mm between rows
    const PerforationLayout layout = make_layout(options, 1);
    const double shift = std::min(stagger, 1.0 - stagger) * 0.030;
    EXPECT_NEAR(thinnest_wall(layout).thickness, std::min(0.030, std::hypot(shift, 0.025)) - 0.020, 1e-15);
  }
}

TEST(Layout, OddRowsBreakAStagger) {
  LayoutOptions options;
  options.family = LayoutFamily::staggered;
  options.rows = 5;
  EXPECT_THAT(refusal(options), HasSubstr("layout.rows: 5 rows shifted in turn do not repeat periodically"));
  options.stagger = 1.0;
  EXPECT_EQ(refusal(options), "");
}

TEST(Layout, JitterStaysWithinItsRadiusAndFollowsTheSeed) {
  LayoutOptions options;
  options.jitter = 0.002;
  const PerforationLayout regular = place_perforations({}, 1);
  double farthest = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PerforationLayout layout = place_perforations(options, seed);
    for (std::size_t k = 0; k < layout.perforations.size(); ++k)
      farthest = std::max(farthest, std::hypot(layout.perforations[k].x - regular.perforations[k].x,
                                               layout.perforations[k].y - regular.perforations[k].y));
  }
  EXPECT_LE(farthest, 0.002 + 1e-15);
  EXPECT_GT(farthest, 0.0018);
  EXPECT_EQ(place_perforations(options, 3).perforations[7].x, place_perforations(options, 3).perforations[7].x);
  EXPECT_NE(place_perforations(options, 3).perforations[7].x, place_perforations(options, 4).perforations[7].x);
}

TEST(Layout, RandomKeepsTheMinimumWall) {
  LayoutOptions options;
  options.family = LayoutFamily::random;
  options.minimum_wall = 0.003;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    options.count = 1 + static_cast<int>(seed % 25);
    const PerforationLayout layout = make_layout(options, seed);
    EXPECT_EQ(layout.perforations.size(), static_cast<std::size_t>(options.count));
    EXPECT_GE(thinnest_wall(layout).thickness, 0.003) << "seed " << seed;
    for (const Perforation& hole : layout.perforations)
      EXPECT_TRUE(hole.x >= 0.0 && hole.x < layout.width && hole.y >= 0.0 && hole.y < layout.height);
  }
}

TEST(Layout, RandomGoesBeyondWhereSequentialAdditionSticks) {
  // Random sequential addition of equal discs stops near 0.547 of the area (Hinrichsen et al. 1986); 0.75 needs more.
  LayoutOptions options;
  options.family = LayoutFamily::random;
  options.diameter = 0.010;
  options.minimum_wall = 0.001;
  options.count = static_cast<int>(0.75 * 0.0225 / (0.25 * std::numbers::pi * 0.011 * 0.011));
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_GE(thinnest_wall(make_layout(options, seed)).thickness, 0.001) << "seed " << seed;
}

TEST(Layout, RandomThatDoesNotFitSaysSo) {
  LayoutOptions options;
  options.family = LayoutFamily::random;
  for (int count : {66, 200}) {  // 0.92 of the area: beyond the densest packing; far beyond
    options.count = count;
    EXPECT_THAT(refusal(options), HasSubstr("layout.count: " + std::to_string(count) + " holes of 20 mm"));
    EXPECT_EQ(place_perforations(options, 1).perforations.size(), static_cast<std::size_t>(count));
  }
}

TEST(Layout, ListInlineAndFromCsv) {
  LayoutOptions options;
  options.family = LayoutFamily::list;
  options.holes = {0.03, 0.04, 0.02, 0.10, 0.11, 0.03};
  const PerforationLayout inline_layout = make_layout(options, 1);
  const TemporaryCsv csv("# holes\ny, diameter, x\n0.04, 0.02, 0.03\n0.11, 0.03, 0.10\n");
  options.holes.clear();
  options.file = csv.path();
  const PerforationLayout file_layout = make_layout(options, 1);
  ASSERT_EQ(file_layout.perforations.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(file_layout.perforations[k].x, inline_layout.perforations[k].x);
    EXPECT_EQ(file_layout.perforations[k].y, inline_layout.perforations[k].y);
    EXPECT_EQ(file_layout.perforations[k].shape, inline_layout.perforations[k].shape);
  }
}

// One and the same two holes: in metres, with units in the header, with units in the fields, in file_unit with and
// without a header.
TEST(Layout, ListsFromCsvTakeUnits) {
  const auto read = [](const std::string& text, const std::string& unit) {
    const TemporaryCsv csv(text);
    LayoutOptions options;
    options.family = LayoutFamily::list;
    options.file = csv.path();
    options.file_unit = unit;
    return make_layout(options, 1).perforations;
  };
  const auto metres = read("x,y,diameter\n0.03,0.04,0.02\n0.1,0.11,0.03\n", "");
  ASSERT_EQ(metres.size(), 2u);
  for (const auto& [text, unit] :
       std::vector<std::pair<std::string, std::string>>{{"X [mm],y (mm),diameter [cm]\n30,40,2\n100,110,3\n", ""},
                                                        {"x,y,diameter\n30 mm,4 cm,0.02\n0.1,110 mm,30 mm\n", ""},
                                                        {"x,y,diameter\n30,40,20\n100,110,30\n", "mm"},
                                                        {"30,40,20\n100,110,30\n", "mm"}}) {
    const auto holes = read(text, unit);
    ASSERT_EQ(holes.size(), 2u) << text;
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(holes[k].x, metres[k].x, 1e-15) << text;
      EXPECT_NEAR(holes[k].y, metres[k].y, 1e-15) << text;
      EXPECT_NEAR(holes[k].largest_extent(), metres[k].largest_extent(), 1e-15) << text;
    }
  }
  LayoutOptions options;
  options.family = LayoutFamily::list;
  const auto refused = [&](const std::string& text, const std::string& unit) {
    const TemporaryCsv csv(text);
    options.file = csv.path();
    options.file_unit = unit;
    return refusal(options);
  };
  EXPECT_THAT(refused("x [mm],y [mm],diameter [mm]\n30,40,20\n", "mm"),
              HasSubstr("layout.file_unit: the header names units already"));
  EXPECT_THAT(refused("x,z,diameter\n0.03,0.04,0.02\n", ""),
              HasSubstr("has no column y; its columns are x, z, diameter"));
}

TEST(Layout, ListErrorsNameFileAndLine) {
  const TemporaryCsv csv("x,y,diameter\n0.03,0.04,0.02\n30,40,20\n");
  LayoutOptions options;
  options.family = LayoutFamily::list;
  options.file = csv.path();
  EXPECT_THAT(refusal(options), HasSubstr(csv.path().string() + ":3: layout.file: hole 2"));
  options.file.clear();
  EXPECT_THAT(refusal(options), HasSubstr("layout.holes"));
  options.holes = {0.03, 0.04, 0.02, 0.04, 0.04, 0.02};
  EXPECT_THAT(refusal(options), HasSubstr("holes 1 and 2 overlap by 10 mm"));
  options.holes = {0.03, 0.04, -0.02};
  EXPECT_THAT(refusal(options), HasSubstr("hole 1 has no size"));
  options.holes = {0.03, 0.04, 0.2};
  EXPECT_THAT(refusal(options), HasSubstr("larger than the cell"));
}

TEST(Layout, RefusesWhatCannotBe) {
  LayoutOptions options;
  options.diameter = 0.026;
  EXPECT_THAT(refusal(options), HasSubstr("overlap by 1 mm"));
  options.diameter = 0.2;
  EXPECT_THAT(refusal(options), HasSubstr("layout.diameter: a hole of 200 mm is larger than the cell"));
  options.diameter = 0.0;
  EXPECT_THAT(refusal(options), HasSubstr("layout.diameter"));
  options.diameter = std::nan("");
  EXPECT_THAT(refusal(options), HasSubstr("layout.diameter"));
  options = {};
  options.minimum_wall = 0.006;
  EXPECT_THAT(refusal(options), HasSubstr("is 5 mm; at least the minimum wall of 6 mm"));
  options.minimum_wall = 0.005;
  EXPECT_EQ(refusal(options), "");
  options = {};
  options.rows = options.columns = 1000;
  EXPECT_THAT(refusal(options), HasSubstr("1000000 holes are too many"));
  options = {};
  options.rows = 0;
  EXPECT_THAT(refusal(options), HasSubstr("layout.rows"));
  options = {};
  options.family = LayoutFamily::random;
  options.count = 0;
  EXPECT_THAT(refusal(options), HasSubstr("layout.count"));
  options.count = 1000000;
  EXPECT_THAT(refusal(options), HasSubstr("at most 10000 holes"));
  options = {};
  options.width = -1.0;
  EXPECT_THAT(refusal(options), HasSubstr("cell.width"));
}

TEST(Layout, PlacingForAStudyDoesNotRefuseThinWalls) {
  LayoutOptions options;
  options.diameter = 0.026;
  EXPECT_NEAR(thinnest_wall(place_perforations(options, 1)).thickness, -0.001, 1e-15);
}

// Doubling is exact in binary: every length of the layout has the same digits, whatever the family draws at random.
TEST(Layout, ScaleMultipliesEveryLength) {
  const TemporaryCsv csv("x,y,diameter\n0.02,0.03,0.008\n0.1,0.1,0.012\n");
  for (const LayoutFamily family :
       {LayoutFamily::none, LayoutFamily::square, LayoutFamily::staggered, LayoutFamily::rotated, LayoutFamily::graded,
        LayoutFamily::random, LayoutFamily::oblique, LayoutFamily::rows, LayoutFamily::list}) {
    LayoutOptions options;
    options.family = family;
    options.diameter = 0.012;
    options.jitter = 0.001;
    options.minimum_wall = 0.002;
    if (family == LayoutFamily::oblique || family == LayoutFamily::rows) {
      options.shape = ShapeKind::slot;
      options.aspect = 3.0;
    }
    if (family == LayoutFamily::list) options.file = csv.path();
    const PerforationLayout plain = make_layout(options, 7);
    options.scale = 2.0;
    const PerforationLayout larger = make_layout(options, 7);
    EXPECT_EQ(larger.width, 2.0 * plain.width);
    EXPECT_EQ(larger.height, 2.0 * plain.height);
    EXPECT_EQ(options.cell_width(), larger.width);
    ASSERT_EQ(larger.perforations.size(), plain.perforations.size());
    for (std::size_t k = 0; k < plain.perforations.size(); ++k) {
      EXPECT_EQ(larger.perforations[k].x, 2.0 * plain.perforations[k].x);
      EXPECT_EQ(larger.perforations[k].y, 2.0 * plain.perforations[k].y);
      EXPECT_EQ(larger.perforations[k].largest_extent(), 2.0 * plain.perforations[k].largest_extent());
    }
    if (family != LayoutFamily::none) {
      EXPECT_DOUBLE_EQ(thinnest_wall(larger).thickness, 2.0 * thinnest_wall(plain).thickness);
    }
    EXPECT_EQ(place_perforations(options, 7).perforations, larger.perforations);
  }
}

TEST(Layout, NoneIsASolidBlock) {
  LayoutOptions options;
  options.family = LayoutFamily::none;
  EXPECT_TRUE(make_layout(options, 1).perforations.empty());
  EXPECT_EQ(make_layout(options, 1).solid_area_fraction(), 1.0);
}

}  // namespace
}  // namespace perfora::geometry
