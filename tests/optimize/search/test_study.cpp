// What is here: study files read into variables, arms and shares; what is wrong with bad ones. Expected numbers are
// worked out by hand. What is not: the search.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "io/text.h"
#include "optimize/search/study_arms.h"
#include "optimize/search/study_plan.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

class StudyFile : public testing::Test {
 protected:
  StudyFolder folder;
  Study read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return read_study(folder.file("study.toml", text), overrides);
  }
  std::string error(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const std::string message = input_error([&] { read(text, overrides); });
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  }
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<std::string> names(const Study& study) {
  std::vector<std::string> all;
  for (const Arm& arm : study.arms) all.push_back(arm.name);
  return all;
}

std::vector<int> fractions(const Study& study) {
  std::vector<int> all;
  for (const Arm& arm : study.arms) all.push_back(arm.maxeval);
  return all;
}

TEST_F(StudyFile, ReadsVariablesTargetAndWindow) {
  const Study study = read(study_text("maxeval = 12\nalgorithm = \"NLOPT_LN_SBPLX\""));
  ASSERT_EQ(study.variables.size(), 2U);
  EXPECT_EQ(study.variables[0].key, "layout.diameter");
  EXPECT_DOUBLE_EQ(study.variables[0].low, 0.014);
  EXPECT_DOUBLE_EQ(study.variables[0].high, 0.021);
  EXPECT_EQ(study.keys.algorithm, "LN_SBPLX");
  EXPECT_DOUBLE_EQ(study.target.plateau_stress, 2e5);
  EXPECT_DOUBLE_EQ(study.until(), 0.45);
  EXPECT_DOUBLE_EQ(study.start->design().measures.plateau_end, 0.4);
  EXPECT_EQ(names(study), std::vector<std::string>{"all"});
  // The start of a local algorithm is the design: 16 mm lies 2/7 up the bounds.
  EXPECT_NEAR(study.arms[0].start[0], 2.0 / 7.0, 1e-12);
  EXPECT_EQ(study.arms[0].start[1], 0.0);
}

TEST_F(StudyFile, MapsTheUnitCubeOntoTheBoundsAndBack) {
  const Study study = read(study_text("maxeval = 12"));
  EXPECT_EQ(study.values_at(std::vector{0.0, 1.0}), (std::vector{0.014, 0.001}));
  EXPECT_EQ(study.values_at(std::vector{0.5, 0.25}), (std::vector{0.0175, 0.00025}));
  EXPECT_EQ(study.values_at(std::vector{-1e-12, 2.0}), (std::vector{0.014, 0.001}));
  for (int k = 0; k < 100; ++k) {
    const auto x = halton_point(k, 2);
    const auto back = study.point_of(study.values_at(x));
    EXPECT_NEAR(back[0], x[0], 1e-9);
    EXPECT_NEAR(back[1], x[1], 1e-9);
    EXPECT_EQ(study.values_at(back), study.values_at(study.point_of(study.values_at(back))));
  }
}

TEST_F(StudyFile, RoundsToTwelveDigits) {
  EXPECT_EQ(io::rounded(0.1 + 0.2), 0.3);
  EXPECT_EQ(io::rounded(1.23456789012345e-3), 1.23456789012e-3);
  EXPECT_EQ(io::rounded(0.0), 0.0);
  EXPECT_EQ(io::rounded(-2.0 / 3.0), -0.666666666667);
}

TEST_F(StudyFile, EnumeratesArmsAndSharesMaxeval) {
  const Study study =
      read(study_text("maxeval = 11", "family = [\"square\", \"staggered\"]\nrows = [1, 2]\ncolumns = [2, 2]"));
  // staggered with one row is no periodic pattern, or is one: what the layout says counts, so only the square arms are
  // fixed here.
  const auto all = names(study);
  EXPECT_EQ(all[0], "family=square rows=1 columns=2");
  EXPECT_EQ(all[1], "family=square rows=2 columns=2");
  int sum = 0;
  for (const int fraction : fractions(study)) sum += fraction;
  EXPECT_EQ(sum, 11);
  std::set<std::uint32_t> seeds;
  for (const Arm& arm : study.arms) seeds.insert(arm.seed);
  EXPECT_EQ(seeds.size(), study.arms.size());
}

TEST_F(StudyFile, WholeNumbersOfArmsMayBeWrittenWithAPoint) {
  EXPECT_EQ(names(read(study_text("maxeval = 4", "rows = [2.0, 3.0, 2]"))), (std::vector<std::string>{"rows=2", "rows=3"}));
}

// A stagger moves the rows of a staggered pattern and says nothing to a square one.
TEST_F(StudyFile, AVariableWithoutEffectIsTold) {
  const Study study = read(
      "[study]\ndesign = \"design.toml\"\nmaxeval = 4\n[target]\nplateau_stress = \"0.2 MPa\"\n[variables]\n"
      "\"layout.stagger\" = [0.1, 0.5]\n[arms]\nfamily = [\"square\", \"staggered\"]\n");
  std::vector<std::string> told;
  for (const std::string& warning : study.warnings)
    if (has(warning, "has no effect")) told.push_back(warning);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(has(told[0], "variables.layout.stagger has no effect on arm family=square")) << told[0];
}

// However many arms it bears on, one variable is one line.
TEST_F(StudyFile, AVariableWithoutEffectOnManyArmsIsOneWarning) {
  const Study study = read(
      "[study]\ndesign = \"design.toml\"\nmaxeval = 9\n[target]\nplateau_stress = \"0.2 MPa\"\n[variables]\n"
      "\"layout.stagger\" = [0.1, 0.5]\n[arms]\nfamily = [\"square\"]\nrows = [1, 2, 3, 4, 5]\n");
  std::vector<std::string> told;
  for (const std::string& warning : study.warnings)
    if (has(warning, "has no effect")) told.push_back(warning);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(has(told[0], "on arms family=square rows=1, family=square rows=2, family=square rows=3 and ")) << told[0];
}

TEST_F(StudyFile, TurnsAreArmsOfTheRotatedFamilyOnly) {
  // Two rows of two turned by 0 are the square holes, and a turn does not change the square ones.
  const Study study = read(study_text("maxeval = 9", "family = [\"square\", \"rotated\"]\nturn = [0, 1, -2]"));
  EXPECT_EQ(names(study),
            (std::vector<std::string>{"family=square turn=0", "family=rotated turn=1", "family=rotated turn=-2"}));
  EXPECT_EQ(fractions(study), (std::vector<int>{3, 3, 3}));
  const auto left_out = [](const std::string& warning) {
    return has(warning, "3 arms are left out, as another arm has the same holes: ") &&
           has(warning, "family=square turn=1 (as family=square turn=0)");
  };
  EXPECT_EQ(std::count_if(study.warnings.begin(), study.warnings.end(), left_out), 1);
  const LayoutMeasure measure = measure_layout(study.design_at(&study.arms[1], std::vector{0.016, 0.0}));
  ASSERT_TRUE(measure.placed);
  // Five holes at a pitch of 50 mm/sqrt(5).
  EXPECT_NEAR(measure.thinnest_wall, 0.05 / std::sqrt(5.0) - 0.016, 1e-12);
  EXPECT_NEAR(measure.porosity, 5.0 * std::numbers::pi * 0.008 * 0.008 / 0.0025, 1e-12);
}

TEST_F(StudyFile, ArmsWithTheSameHolesAndOtherStartsStay) {
  const Study study = read(study_text("maxeval = 12\nstarts = 2", "turn = [1, 2]"));
  EXPECT_EQ(names(study), (std::vector<std::string>{"turn=1 start=1", "turn=1 start=2"}));
}

TEST_F(StudyFile, GradingIsAVariableAndOneRowIsLeftOut) {
  const Study study = read(
      "[study]\ndesign = \"design.toml\"\nmaxeval = 4\nuntil = 0.45\n[target]\nplateau_stress = 2e5\n"
      "[variables]\nlayout.diameter = [0.010, 0.012]\ngrading = [-0.4, \"80 %\"]\n"
      "[arms]\nfamily = [\"graded\"]\nrows = [1, 2]\n");
  EXPECT_EQ(names(study), (std::vector<std::string>{"family=graded rows=2"}));
  ASSERT_EQ(study.variables.size(), 2U);
  EXPECT_EQ(study.variables[1].key, "layout.grading");
  EXPECT_DOUBLE_EQ(study.variables[1].low, -0.4);
  EXPECT_DOUBLE_EQ(study.variables[1].high, 0.8);
  EXPECT_TRUE(std::any_of(study.warnings.begin(), study.warnings.end(), [](const std::string& warning) {
    return has(warning, "arm family=graded rows=1 is left out: one row cannot be graded");
  }));
  // 2 x 2 holes at a pitch of 25 mm, 12 (1 + 0.8/2) mm in the upper row.
  const LayoutMeasure measure = measure_layout(study.design_at(&study.arms[0], std::vector{0.012, 0.8}));
  EXPECT_NEAR(measure.thinnest_wall, 0.025 - 0.0168, 1e-12);
}

TEST_F(StudyFile, VariesAnyNumberOfTheDesignAndElementsOfLists) {
  folder.file("rows.toml",
              "[cell]\nwidth = \"50 mm\"\nheight = \"50 mm\"\n[layout]\nfamily = \"rows\"\nrow_diameter = [\"9 mm\", "
              "\"8 mm\"]\nrows = 4\ncolumns = 4\n[packing]\nmean_diameter = \"0.5044 mm\"\n");
  const Study study = read(
      "[study]\ndesign = \"rows.toml\"\nmaxeval = 4\nuntil = 0.45\n[target]\nplateau_stress = 2e5\n"
      "[variables]\n\"layout.row_diameter[1]\" = [\"6 mm\", \"9 mm\"]\ncell.height = [\"48 mm\", \"60 mm\"]\n"
      "material.critical_normal_displacement = [1e-6, 2e-6]\n[arms]\nherringbone = [false, true]\n"
      "noise.kind = [\"none\", \"weibull\"]\n");
  ASSERT_EQ(study.variables.size(), 3U);
  EXPECT_EQ(study.variables[0].key, "layout.row_diameter[1]");
  EXPECT_EQ(study.variables[0].dimension, io::Dimension::length);
  // Circles have no angle: arms that differ in herringbone are one; those that differ in the noise are two.
  EXPECT_EQ(names(study), (std::vector<std::string>{"herringbone=false kind=none", "herringbone=false kind=weibull"}));
  EXPECT_TRUE(std::none_of(study.warnings.begin(), study.warnings.end(),
                           [](const std::string& warning) { return has(warning, "has no effect"); }));
  const DesignFile made = study.design_at(&study.arms[1], std::vector{0.007, 0.055, 1.5e-6});
  // As best.toml holds it: the whole list.
  const Design design = DesignFile::from_toml(made.schema().to_toml(), "best.toml").design();
  EXPECT_EQ(design.layout.row_diameter, (std::vector<double>{0.009, 0.007}));
  EXPECT_EQ(design.layout.height, 0.055);
  EXPECT_EQ(design.solver.material.critical_normal_displacement, 1.5e-6);
  EXPECT_EQ(design.solver.noise.kind, solver::NoiseKind::weibull);
  EXPECT_NEAR(study.arms[0].start[0], (0.008 - 0.006) / 0.003, 1e-12);
  EXPECT_NEAR(study.arms[0].start[1], (0.050 - 0.048) / 0.012, 1e-12);
}

TEST_F(StudyFile, WholeNumbersInVariablesAreRanges) {
  const Study study = read(
      "[study]\ndesign = \"design.toml\"\nmaxeval = 7\nuntil = 0.45\n[target]\nplateau_stress = "
      "2e5\n[variables]\nlayout.diameter = [0.010, 0.012]\n"
      "layout.rows = [1, 3]\n");
  EXPECT_EQ(names(study), (std::vector<std::string>{"rows=1", "rows=2", "rows=3"}));
  EXPECT_EQ(fractions(study), (std::vector<int>{3, 2, 2}));
}

TEST_F(StudyFile, TakesAListOfSharesAndStarts) {
  const Study study = read(study_text("maxeval = 12\nallocation = [4, 8]\nstarts = 2"));
  EXPECT_EQ(names(study), (std::vector<std::string>{"start=1", "start=2"}));
  EXPECT_EQ(fractions(study), (std::vector<int>{4, 8}));
  EXPECT_NE(study.arms[0].start, study.arms[1].start);
}

TEST_F(StudyFile, SharesInProportionToWhatKeepsTheConstraints) {
  // Porosity 4 pi d^2/4 / 50^2 mm2 <= 0.38494 holds up to d = 17.5 mm: half of the bounds. With one row the porosity is
  // half of that: all of them.
  const Study study =
      read(study_text("maxeval = 30\nallocation = \"proportional\"", "rows = [1, 2]", "porosity = [0.01, 0.38485]"));
  const auto counts = fractions(study);
  EXPECT_EQ(counts[0] + counts[1], 30);
  EXPECT_NEAR(counts[0], 20, 1);
}

TEST(ShareOut, KeepsTheTotalByLargestRemainders) {
  EXPECT_EQ(share_out(10, {1.0, 1.0, 1.0}), (std::vector<int>{4, 3, 3}));
  EXPECT_EQ(share_out(7, {0.0, 0.0}), (std::vector<int>{4, 3}));
  EXPECT_EQ(share_out(10, {0.0, 2.0, 3.0}), (std::vector<int>{0, 4, 6}));
  for (int total = 0; total < 40; ++total) {
    const auto counts = share_out(total, {0.3, 1.7, 0.01, 5.0});
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), total);
  }
}

TEST(Halton, IsTheRadicalInverse) {
  // Bases 2 and 3 of 1, 2, 3: 1/2 1/3; 1/4 2/3; 3/4 1/9.
  EXPECT_EQ(halton_point(0, 2), (std::vector{1.0 / 2.0, 1.0 / 3.0}));
  EXPECT_DOUBLE_EQ(halton_point(1, 2)[1], 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(halton_point(2, 2)[0], 0.75);
  EXPECT_DOUBLE_EQ(halton_point(2, 2)[1], 1.0 / 9.0);
}

TEST_F(StudyFile, MeasuresConstraintsOnTheLayout) {
  const Study study = read(study_text("maxeval = 12", "", "thinnest_wall = \"6 mm\"\nporosity = [0.2, 0.4]"));
  const std::vector<double> values{0.018, 0.0};
  const DesignFile design = study.design_at(&study.arms[0], values);
  const LayoutMeasure measure = measure_layout(design);
  ASSERT_TRUE(measure.placed);
  // 2 x 2 holes at a pitch of 25 mm.
  EXPECT_NEAR(measure.thinnest_wall, 0.007, 1e-12);
  const double porosity = 4.0 * std::numbers::pi * 0.25 * 0.018 * 0.018 / (0.05 * 0.05);
  EXPECT_NEAR(measure.porosity, porosity, 1e-12);
  const auto g = constraint_values(study.constraints, design, measure);
  ASSERT_EQ(g.size(), 3U);
  EXPECT_NEAR(g[0], (0.006 - 0.007) / 0.006, 1e-9);
  EXPECT_NEAR(g[1], (0.2 - porosity) / 0.4, 1e-9);
  EXPECT_NEAR(g[2], (porosity - 0.4) / 0.4, 1e-9);
  EXPECT_NEAR(violation(g), std::max(0.0, g[2]), 1e-15);
}

// 4 x 4 slots, 10 mm long in the bottom row and 8 mm in the top row, at a pitch of 12.5 mm: the thinnest wall stands
// beside the longest.
TEST_F(StudyFile, MeasuresConstraintsOnSlots) {
  folder.file(
      "slots.toml",
      "[cell]\nwidth = \"50 mm\"\nheight = \"50 mm\"\n[layout]\nfamily = \"rows\"\nshape = \"slot\"\nbreadth = "
      "\"2 mm\"\nrow_diameter = [\"9 mm\", \"8 mm\"]\nrows = 4\ncolumns = 4\n[packing]\nmean_diameter = \"0.5044 "
      "mm\"\n");
  const Study study = read(
      "[study]\ndesign = \"slots.toml\"\nmaxeval = 4\nuntil = 0.45\n[target]\nplateau_stress = 2e5\n"
      "[constraints]\nthinnest_wall = \"2 mm\"\n[variables]\n\"row_diameter[0]\" = [\"8 mm\", \"12 mm\"]\n");
  const LayoutMeasure measure = measure_layout(study.design_at(&study.arms[0], std::vector{0.010}));
  EXPECT_NEAR(measure.thinnest_wall, 0.0025, 1e-12);
  // Lengths beside the half circles: 8, 22/3, 20/3 and 6 mm, 28 mm a column.
  EXPECT_NEAR(measure.porosity, 4.0 * (0.002 * 0.028 + 4.0 * std::numbers::pi * 0.001 * 0.001) / 0.0025, 1e-12);
}

TEST_F(StudyFile, TheHorizonIsAConstraintByItself) {
  // r_H = 3 x 0.5044 mm; a wall of 1 mm is (1.5132 - 1)/1.5132 too thin.
  const Study study = read(study_text("maxeval = 12"));
  const DesignFile design = study.design_at(&study.arms[0], std::vector{0.024, 0.0});
  const auto g = constraint_values(study.constraints, design, measure_layout(design));
  EXPECT_NEAR(violation(g), (1.5132 - 1.0) / 1.5132, 1e-9);
}

TEST_F(StudyFile, OverridesReachStudyAndDesign) {
  const Study study = read(study_text("maxeval = 12"),
                           {"study.maxeval=5", "seeds.seed=7", "variables.\"layout.diameter\"=[0.015, 0.016]"});
  EXPECT_EQ(study.keys.maxeval, 5);
  EXPECT_EQ(study.start->design().seeds.seed, 7);
  EXPECT_DOUBLE_EQ(study.variables.back().high == 0.016 ? 0.016 : study.variables.front().high, 0.016);
}

TEST_F(StudyFile, SetsKeysOfTheDesignBelowTheCommandLine) {
  const std::string text =
      study_text("maxeval = 12") + "[set]\nloading.transits = 11\nmaterial.friction_coefficient = 0.3\n";
  const Study study = read(text, {"loading.transits=13"});
  EXPECT_DOUBLE_EQ(study.start->design().solver.loading.transits, 13.0);
  EXPECT_DOUBLE_EQ(study.start->design().solver.material.friction_coefficient, 0.3);
  EXPECT_NE(study.resolved(), read(study_text("maxeval = 12")).resolved());
  EXPECT_TRUE(has(error(study_text("maxeval = 12") + "[set]\nloading.transit = 11\n"), "loading.transits"));
}

TEST_F(StudyFile, ResolvesToTheSameTextUnlessSomethingThatMattersChanges) {
  const auto first = read(study_text("maxeval = 12")).resolved();
  EXPECT_EQ(read(study_text("maxeval = 12\nworkers = 3")).resolved(), first);
  EXPECT_EQ(read(study_text("maxeval = 12"), {"output.checkpoint_interval=5"}).resolved(), first);
  EXPECT_NE(read(study_text("maxeval = 12\nreplicates = 2")).resolved(), first);
  EXPECT_NE(read(study_text("maxeval = 12"), {"material.horizon=2.9"}).resolved(), first);
  EXPECT_NE(read(study_text("maxeval = 12"), {"seeds.seed=2"}).resolved(), first);
}

TEST_F(StudyFile, CountsWhatWouldRun) {
  const auto path = folder.file(
      "study.toml",
      study_text("maxeval = 12\nreplicates = 2\nfinal_replicates = 5\nrefine = \"LN_SBPLX\"\nrefine_maxeval = 4"));
  const StudyPlan plan = plan_of(read_study(path));
  std::int64_t candidates = 0;
  for (const PlannedStage& stage : plan.stages)
    if (stage.name == "search" || stage.name == "refine") candidates += stage.designs;
  EXPECT_EQ(candidates, 16);
  EXPECT_EQ(plan.runs(), 17 * 2 + 10 + 5) << "five more where the start is recommended";
}

TEST_F(StudyFile, RefusesWhatIsWrongByKeyAndRemedy) {
  struct Bad {
    std::string text;
    std::vector<std::string> parts;
  };
  const std::string target = "\n[target]\nplateau_stress = 2e5\n",
                    variables = "[variables]\nlayout.diameter = [0.014, 0.02]\n";
  const std::string head = "[study]\ndesign = \"design.toml\"\nuntil = 0.45\nmaxeval = 4\n";
  const std::vector<Bad> bads{
      {study_text("maxeval = 12\nalgorithm = \"LD_MMA\""),
       {"study.toml:5", "study.algorithm", "gradients", "GN_DIRECT_L"}},
      {study_text("maxeval = 12\nalgorithm = \"GN_DIRECTL\""), {"study.algorithm", "has no algorithm", "GN_DIRECT_L"}},
      {study_text("maxeval = 12\nrefine = \"GN_ISRES\"\nrefine_maxeval = 3"), {"study.refine", "not a local"}},
      {study_text("maxeval = 12\nrefine = \"LN_SBPLX\""), {"study.refine_maxeval"}},
      {study_text(""), {"study.maxeval", "no number of candidates"}},
      {study_text("maxeval = 0"), {"study.maxeval"}},
      {study_text("maxeval = -3"), {"study.maxeval"}},
      {study_text("maxeval = 12\nmaxevall = 3"), {"study.toml:5", "maxevall", "maxeval"}},
      {study_text("maxeval = 1", "rows = [1, 2]"), {"1 for 2 arms"}},
      {study_text("maxeval = 12\nallocation = [1, 2, 3]"), {"study.allocation", "3 numbers are given for 1 arms"}},
      {study_text("maxeval = 12\nallocation = [11]"), {"adds up to 11"}},
      {study_text("maxeval = 12\nallocation = \"fair\""), {"no allocation"}},
      {study_text("maxeval = 12", "rows = [2.5]"), {"rows"}},
      {study_text("maxeval = 12", "diameter = [\"20 mm\"]"), {"arms.diameter", "[variables]"}},
      {study_text("maxeval = 12", "colour = [2]"), {"arms.colour", "no such key"}},
      {study_text("maxeval = 12", "family = [\"square\", \"hexagonal\"]"), {"family", "hexagonal"}},
      {study_text("maxeval = 12", "", "porosity = [0.5, 0.2]"), {"constraints.porosity"}},
      {study_text("maxeval = 12", "", "thinnest_wall = \"-1 mm\""), {"constraints.thinnest_wall"}},
      {head + variables, {"target.plateau_stress", "nothing is wished"}},
      {head + "[target]\nplateau_stress = 0\n" + variables, {"target.plateau_stress"}},
      {head + "[target]\nplateau_stress = \"2 mm\"\n" + variables, {"target.plateau_stress"}},
      {head + "[target]\nplateau_stress = 2e5\nwindow = [0.4, 0.2]\n" + variables, {"target.window"}},
      {head + "[target]\nplateau_stress = 2e5\nwindow = [0.2, 0.5]\n" + variables, {"study.until", "0.45"}},
      {head + target, {"variables", "no continuous variable"}},
      {head + target + "[variables]\nlayout.diameter = [0.02, 0.014]\n",
       {"variables.layout.diameter", "nothing lies between"}},
      {head + target + "[variables]\nlayout.diameter = [0.02, 0.02]\n", {"nothing lies between"}},
      {head + target + "[variables]\nlayout.diameter = [\"2 MPa\", 0.02]\n", {"variables.layout.diameter"}},
      {head + target + "[variables]\nlayout.diameter = [nan, 0.02]\n", {"variables.layout.diameter"}},
      {head + target + "[variables]\nlayout.diameter = [-0.01, 0.02]\n", {"variables.layout.diameter", "out of range"}},
      {head + target + "[variables]\nlayout.diameter = 0.02\n", {"a list is wanted"}},
      {head + target + "[variables]\nlayout.diametre = [0.01, 0.02]\n", {"layout.diametre", "layout.diameter"}},
      {head + target + "[variables]\nmaterial.horison = [2, 3]\n", {"no such key", "did you mean material.horizon?"}},
      {head + target + "[variables]\noutput.history_interval = [0.001, 0.002]\n", {"cannot vary", "not the result"}},
      {head + target + "[variables]\nloading.until = [0.5, 0.6]\n", {"loading.until", "study.until"}},
      {head + target + "[variables]\ntarget.tolerance = [0.1, 0.2]\n", {"target.tolerance", "for all candidates"}},
      {head + target + "[variables]\nmaterial_test.past_peak = [1.5, 2]\n", {"a run does not look at it"}},
      {head + target + "[variables]\nrow_diameter = [0.014, 0.02]\n",
       {"variables.row_diameter", "this is a list", "\"layout.row_diameter[0]\""}},
      {head + target + "[variables]\n\"row_diameter[0]\" = [0.014, 0.02]\n",
       {"the list has 0 values", "give the design layout.row_diameter"}},
      {head + target + "[variables]\n\"diameter[0]\" = [0.014, 0.02]\n", {"variables.diameter[0]", "cannot vary"}},
      {head + target + "[variables]\nnoise.kind = [1, 2]\n", {"noise.kind", "[arms]"}},
      {head + target + "[variables]\nlayout.family = [\"square\"]\n", {"layout.family", "[arms]"}},
      {"[study]\nmaxeval = 4\n" + target + variables, {"study.design"}},
      {"[study]\ndesign = \"missing.toml\"\nmaxeval = 4\n" + target + variables, {"missing.toml"}},
      {head + "algorithm = \"LN_NEWUOA_BOUND\"" + target + variables, {"LN_NEWUOA_BOUND needs at least 2"}},
  };
  for (const Bad& bad : bads) {
    SCOPED_TRACE(bad.text);
    const std::string message = error(bad.text);
    for (const std::string& part : bad.parts) EXPECT_TRUE(has(message, part)) << part << " is not in: " << message;
  }
}

}  // namespace
}  // namespace perfora::optimize
