// What is here: reading a design, its resolved form. Expected numbers: the paper's Table 1 and
// plain unit arithmetic.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "geometry/size_law.h"
#include "optimize/evaluate/design.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path designs = std::filesystem::path(PERFORA_SOURCE_DIR) / "designs";

TEST(DesignFile, HasAllSections) {
  const DesignFile design;
  const std::vector<std::string> wanted = {"cell",     "layout",   "packing",      "material",      "noise",
                                           "loading",  "dynamics", "boundary",     "output",        "material_test",
                                           "measures", "target",   "target.limit", "target.weight", "seeds"};
  EXPECT_EQ(design.schema().section_names(), wanted);
}

TEST(DesignFile, DefaultsAreTableOne) {
  // Table 1 of the paper.
  const DesignFile defaults;
  const Design& design = defaults.design();
  EXPECT_DOUBLE_EQ(design.layout.width, 0.150);
  EXPECT_DOUBLE_EQ(design.layout.height, 0.150);
  EXPECT_DOUBLE_EQ(design.layout.diameter, 0.020);
  EXPECT_DOUBLE_EQ(design.packing.mean_diameter, 0.5044e-3);
  EXPECT_DOUBLE_EQ(design.solver.material.normal_stiffness, 2.195e7);
  EXPECT_DOUBLE_EQ(design.solver.material.tangential_stiffness, 8.246e6);
  EXPECT_DOUBLE_EQ(design.solver.material.critical_normal_displacement, 1.529e-6);
  EXPECT_DOUBLE_EQ(design.solver.material.rupture_delay, 1.1);
  EXPECT_EQ(design.seeds.seed, 1);
}

TEST(DesignFile, FlagsWinOverTheFileInTheirOrder) {
  const DesignFolder folder;
  const auto path = folder.file("design.toml", small_design);
  const DesignFile design(path, {"layout.diameter=5 mm", "seeds.seed=9", "layout.diameter=\"7 mm\""});
  EXPECT_DOUBLE_EQ(design.design().layout.diameter, 0.007);
  EXPECT_DOUBLE_EQ(design.design().layout.width, 0.012);
  EXPECT_EQ(design.design().seeds.seed, 9);
}

TEST(DesignFile, ResolvedTextIsTheSameDesign) {
  const DesignFolder folder;
  const DesignFile design(folder.file("design.toml", small_design),
                          {"noise.kind=perlin", "output.frame_strains=[0.1, 0.2]"});
  const std::string text = design.schema().to_toml();
  const DesignFile again = DesignFile::from_toml(text, "text");
  EXPECT_EQ(again.schema().to_toml(), text);
  EXPECT_EQ(again.design().solver.noise.kind, solver::NoiseKind::perlin);
  EXPECT_EQ(again.design().solver.output.frame_strains, (std::vector<double>{0.1, 0.2}));
}

TEST(DesignFile, SurvivesAMove) {
  DesignFile design = DesignFile::from_toml("[layout]\nrows = 3\n", "text");
  DesignFile moved = std::move(design);
  moved.schema().set_number("layout.rows", 4.0, {"test", 0, "layout.rows"});
  EXPECT_EQ(moved.design().layout.rows, 4);
}

TEST(ExampleDesigns, ArrangementsHaveThePorosityOfTableOne) {
  // 36 holes of 20 mm in 150 x 150 mm; diameters are written to a hundredth of a millimetre: 0.001 of the area.
  for (const std::string name : {"staggered", "rotated", "graded"}) {
    const DesignFile design(designs / (name + ".toml"));
    const auto layout = geometry::make_layout(design.design().layout, 1);
    EXPECT_NEAR(1.0 - layout.solid_area_fraction(), 36 * std::numbers::pi * 100.0 / 22500.0, 5e-4) << name;
    EXPECT_TRUE(design.validate().empty()) << name;  // walls of two horizons among others
  }
}

TEST(ExampleDesigns, OnlyTheQuickOneIsCoarse) {
  EXPECT_TRUE(DesignFile(designs / "table1.toml").validate().empty());
  const auto warnings = DesignFile(designs / "quick.toml").validate();
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_THAT(warnings[0], HasSubstr("two horizons (6 mm)"));
  EXPECT_THAT(warnings[1], HasSubstr("1.98 times the reference"));
}

TEST(ExampleDesigns, QuickKeepsTheSizeLaw) {
  // A law scaled as a whole keeps its exponent (docs/user/theory.md: 2.90 for 0.5044 mm and 1 mm).
  const DesignFile quick(designs / "quick.toml");
  const auto& packing = quick.design().packing;
  EXPECT_NEAR(geometry::size_law_exponent(packing.mean_diameter, packing.maximum_diameter, packing.size_ratio),
              geometry::size_law_exponent(0.5044e-3, 1e-3, 3.0), 1e-3);
}

}  // namespace
}  // namespace perfora::optimize
