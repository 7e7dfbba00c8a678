// What is here: rules across keys: what is refused, what is warned about, and the words. Expected numbers: lengths
// worked out by hand from the keys.
#include <gmock/gmock.h>

#include <chrono>

#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string refusal(const std::string& text) {
  return complaint([&] { static_cast<void>(DesignFile::from_toml(text, "design.toml").validate()); });
}

std::string warnings_of(const std::string& text) {
  std::string joined;
  for (const std::string& warning : DesignFile::from_toml(text, "design.toml").validate()) joined += warning + "\n";
  return joined;
}

TEST(DesignChecks, WallThinnerThanTheHorizonIsRefused) {
  // 25 mm pitch less 23.6 mm: 1.4 mm, under 3 x 0.5044 = 1.5132 mm.
  const std::string text = refusal("[layout]\ndiameter = \"23.6 mm\"\n");
  EXPECT_THAT(text, StartsWith("design.toml:2: layout.diameter:"));
  EXPECT_THAT(text, HasSubstr("1.4 mm"));
  EXPECT_THAT(text, HasSubstr("horizon of 1.513 mm"));
}

TEST(DesignChecks, WallOfTwoHorizonsIsTheLimitOfTheWarning) {
  EXPECT_THAT(warnings_of("[layout]\ndiameter = \"22 mm\"\n"), HasSubstr("thinner than two horizons (3.026 mm)"));
  EXPECT_EQ(warnings_of("[layout]\ndiameter = \"21.9 mm\"\n"), "");
}

TEST(DesignChecks, HorizonIsThatOfTheMaterial) {
  EXPECT_THAT(warnings_of("[layout]\ndiameter = \"21.9 mm\"\n[material]\nhorizon = 3.5\n"), HasSubstr("two horizons"));
  EXPECT_EQ(warnings_of("[layout]\ndiameter = \"22 mm\"\n[material]\nhorizon = 2\n"), "");
}

TEST(DesignChecks, HopelessNumbersOfHolesAreRefusedAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(refusal("[layout]\nrows = 1000\ncolumns = 1000\n"), HasSubstr("1000000 holes"));
  EXPECT_THAT(refusal("[layout]\nfamily = \"random\"\ncount = 1000000\ndiameter = \"1 mm\"\n"),
              HasSubstr("layout.count"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST(DesignChecks, TooManyHolesOfATurnedLatticeAreTheFaultOfTheLargerNumber) {
  EXPECT_THAT(refusal("[layout]\nfamily = \"rotated\"\nturn = 1000\n"), HasSubstr("layout.turn: 1000036 holes"));
  EXPECT_THAT(refusal("[layout]\nfamily = \"rotated\"\nturn = -7\n"), HasSubstr("layout.turn: 85 holes"));
  EXPECT_THAT(refusal("[layout]\nfamily = \"rotated\"\nrows = 10\n"), HasSubstr("layout.rows: 61 holes"));
}

TEST(DesignChecks, WallsOfGradedRowsAreHeldAgainstTheHorizon) {
  // The top row: 20 (1 + 0.4/2) = 24 mm at a pitch of 25 mm.
  const std::string text = refusal("[layout]\nfamily = \"graded\"\ngrading = 0.4\n");
  EXPECT_THAT(text, HasSubstr("layout.diameter"));
  EXPECT_THAT(text, HasSubstr("the thinnest wall, 1 mm between holes 3"));
  EXPECT_THAT(refusal("[layout]\nfamily = \"graded\"\nrows = 101\ncolumns = 100\n"),
              HasSubstr("layout.rows: 10100 holes are too many"));
}

TEST(DesignChecks, TheBoundOnHolesRefusesNoLayoutThatFits) {
  // 6 x 6 of 20 mm fit with 5 mm walls; so does every smaller number.
  for (int rows = 1; rows <= 6; ++rows)
    EXPECT_EQ(refusal("[layout]\nrows = " + std::to_string(rows) + "\ncolumns = 6\n"), "") << rows;
}

// 36 holes at a pitch of 25 mm: walls of 3 mm hold a horizon of 3 <d> twice at <d> = 0.5 mm.
TEST(DesignChecks, ThinWallsNameTheDiscsThatWouldDo) {
  EXPECT_THAT(warnings_of("[layout]\ndiameter = \"22 mm\"\n"), HasSubstr("a packing.mean_diameter of at most 0.5 mm"));
  EXPECT_THAT(refusal("[layout]\ndiameter = \"24 mm\"\n"), HasSubstr("a mean diameter of at most 333 um"));
}

TEST(DesignChecks, KeysOfOtherFamiliesAreTold) {
  EXPECT_THAT(warnings_of("[layout]\nrow_diameter = \"15 mm\"\n"), HasSubstr("layout.row_diameter has no effect"));
  EXPECT_THAT(warnings_of("[layout]\nweak_factor = 1.1\n"), HasSubstr("layout.weak_factor has no effect"));
  EXPECT_THAT(warnings_of("[layout]\nangle = \"20 deg\"\n"), HasSubstr("layout.angle has no effect"));
  EXPECT_THAT(warnings_of("[layout]\nfamily = \"rows\"\nrow_diameter = \"15 mm\"\ndiameter = \"16 mm\"\n"),
              HasSubstr("layout.diameter has no effect"));
  EXPECT_EQ(
      warnings_of("[layout]\nfamily = \"rows\"\nrow_diameter = \"15 mm\"\nstagger = 0.25\nminimum_wall = \"4 mm\"\n"),
      "");
}

TEST(DesignChecks, CrushedEndsLeaveSomethingOfTheBlock) {
  EXPECT_EQ(refusal("[boundary]\ncrushed_bottom = \"100 mm\"\n"), "");
  EXPECT_THAT(refusal("[boundary]\ncrushed_bottom = \"100 mm\"\ncrushed_top = \"50 mm\"\n"),
              HasSubstr("boundary.crushed_bottom: the crushed ends, 150 mm together, leave nothing"));
}

TEST(DesignChecks, SizesThatContradictEachOther) {
  EXPECT_THAT(refusal("[packing]\nmean_diameter = \"2 mm\"\n"), HasSubstr("outside the diameters of the size law"));
  EXPECT_THAT(refusal("[packing]\nmean_diameter = \"1 um\"\nmaximum_diameter = \"2 um\"\n"), HasSubstr("discs"));
  EXPECT_THAT(refusal("[cell]\nwidth = \"4 mm\"\n[layout]\nfamily = \"none\"\n"), HasSubstr("cell.width"));
  EXPECT_THAT(refusal("[cell]\nheight = \"6 mm\"\n[layout]\nfamily = \"none\"\n[loading]\nuntil = 0.8\n"),
              HasSubstr("loading.until"));
}

TEST(DesignChecks, CoarseDiscsAreWarnedAboutWithTheirPrice) {
  const std::string coarse =
      "[layout]\ndiameter = \"15 mm\"\n[packing]\nmean_diameter = \"1.0088 mm\"\nmaximum_diameter = \"2 "
      "mm\"\n[material]\n";
  EXPECT_THAT(warnings_of(coarse), HasSubstr("2.00 times as well"));
  EXPECT_THAT(warnings_of(coarse + "threshold_scaling = \"toughness\"\n"), HasSubstr("falls to 0.71"));  // 1/sqrt(2)
  EXPECT_THAT(warnings_of(coarse + "threshold_scaling = \"none\"\n"), HasSubstr("leaves them as they are"));
  EXPECT_EQ(warnings_of(coarse + "reference_mean_diameter = \"1.0088 mm\"\n"), "");
}

TEST(DesignChecks, AWindowBeyondTheEndIsWarnedAbout) {
  const std::string told = warnings_of("[loading]\nuntil = 0.3\n");
  EXPECT_THAT(told, HasSubstr("ends at 30 % strain, before the end of the plateau window at 40 %"));
  EXPECT_THAT(told, HasSubstr("set measures.plateau_start and measures.plateau_end"));
  EXPECT_EQ(warnings_of("[loading]\nuntil = 0.4\n"), "");
}

TEST(DesignChecks, MetresThatWereMeantAsMillimetresAreAskedAbout) {
  DesignFile design;
  design.schema().set_number("cell.width", 3.0, {});
  design.schema().set_number("cell.height", 0.05, {});
  design.schema().set_number("layout.diameter", 0.004, {});
  const std::vector<std::string> told = design.validate();
  EXPECT_THAT(told,
              ::testing::Contains(HasSubstr("cell.width is 3 m: plain numbers are in m; did you mean \"3 mm\"?")));
  EXPECT_THAT(told, ::testing::Not(::testing::Contains(HasSubstr("cell.height is"))));
}

TEST(DesignChecks, AKeyLeftOutIsStillTheFilesFault) {
  const DesignFolder folder;
  const auto path = folder.file("d.toml", "[cell]\nwidth = \"20 mm\"\n");
  const std::string text = complaint([&] { static_cast<void>(DesignFile(path).validate()); });
  EXPECT_THAT(text, HasSubstr("d.toml: "));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("default:")));
}

}  // namespace
}  // namespace perfora::optimize
