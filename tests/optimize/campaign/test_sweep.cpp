// What is here: sweep files read to their cases: combinations, labels, what is wrong with them. What is not: their runs
// (test_sweep_run.cpp).
#include <gtest/gtest.h>

#include <set>

#include "tests/optimize/campaign/sweep_support.h"

namespace perfora::optimize {
namespace {

// Walls of 15, 3, 2.5 and 2 mm at a pitch of 25 mm; two horizons are 6 x 0.5044 = 3.03 mm.
TEST_F(SweepTest, TellsEachKindOfWarningOnce) {
  const auto warnings = [&](const std::string& values) {
    std::vector<std::string> walls;
    for (const std::string& text : sweep(sweep_text("[each]\nlayout.diameter = [" + values + "]\n")).warnings)
      if (text.find("the thinnest wall") != std::string::npos) walls.push_back(text);
    return walls;
  };
  const auto thin = warnings("\"10 mm\", \"22 mm\", \"22.5 mm\", \"23 mm\"");
  ASSERT_EQ(thin.size(), 1U);
  EXPECT_TRUE(thin[0].starts_with("case 2 (diameter 22 mm): the thinnest wall")) << thin[0];
  EXPECT_TRUE(thin[0].ends_with("; 2 more cases have a warning of this kind")) << thin[0];
  EXPECT_TRUE(warnings("\"22 mm\"")[0].starts_with("the thinnest wall")) << "every case has it";
}

TEST_F(SweepTest, MakesEveryCombinationThenOneAtATime) {
  const Sweep made = sweep(sweep_text(
      "[set]\nmaterial.rupture_delay = 1.2\n[rows]\nname = [\"soft\", \"stiff\"]\nmaterial.normal_stiffness = [1e7, "
      "2e7]\nmaterial.tangential_stiffness = [4e6, 8e6]\n[grid]\nmaterial.horizon = [2, 2.5, "
      "3]\n[each]\nlayout.diameter "
      "= [\"15 mm\", \"16 mm\"]\n",
      "replicates = 2\nbase = true"));
  ASSERT_EQ(made.cases.size(), 1U + 2U * 3U + 2U);
  EXPECT_EQ(made.cases[0].number, 0);
  EXPECT_TRUE(made.cases[0].settings.empty());
  EXPECT_EQ(made.cases[1].label, "soft, horizon 2");
  EXPECT_EQ(made.cases[6].label, "stiff, horizon 3");
  EXPECT_EQ(made.cases[6].number, 6);
  EXPECT_EQ(made.cases[7].label, "diameter 15 mm");
  EXPECT_EQ(made.cases[7].group, "layout.diameter");
  EXPECT_EQ(made.runs(), 2 * 8);  // a diameter of 16 mm is the design itself
  const solver::MaterialOptions& stiff = made.cases[6].design->solver.material;
  EXPECT_EQ(stiff.normal_stiffness, 2e7);
  EXPECT_EQ(stiff.tangential_stiffness, 8e6);
  EXPECT_EQ(stiff.horizon, 3.0);
  EXPECT_EQ(stiff.rupture_delay, 1.2);
  EXPECT_EQ(made.cases[7].design->layout.diameter, 0.015);
  EXPECT_EQ(made.columns, (std::vector<std::string>{"material.normal_stiffness", "material.tangential_stiffness",
                                                    "material.horizon", "layout.diameter"}));
}

TEST_F(SweepTest, ElementsOfListsAreKeys) {
  const Sweep made =
      sweep(sweep_text("[set]\nlayout.family = \"rows\"\nlayout.row_diameter = [\"9 mm\", \"10 mm\"]\n[grid]\n"
                       "\"layout.row_diameter[1]\" = [\"11 mm\", \"12 mm\"]\n"));
  ASSERT_EQ(made.cases.size(), 2U);
  EXPECT_EQ(made.cases[1].design->layout.row_diameter, (std::vector<double>{0.009, 0.012}));
  EXPECT_EQ(made.cases[1].label, "row_diameter[1] 12 mm");
  EXPECT_EQ(made.columns, (std::vector<std::string>{"layout.row_diameter[1]"}));
}

TEST_F(SweepTest, LabelsSayWhatTellsCasesApart) {
  const Sweep made = sweep(
      sweep_text("[grid]\nnoise.kind = [\"perlin\"]\nmaterial.horizon = [2, 3]\n[each]\nnoise.kind = [\"weibull\"]\n"));
  ASSERT_EQ(made.cases.size(), 3U);
  EXPECT_EQ(made.cases[0].label, "horizon 2");
  EXPECT_EQ(made.cases[2].label, "kind weibull");
  EXPECT_EQ(sweep(sweep_text("[grid]\nmaterial.horizon = [2]\n")).cases[0].label, "horizon 2");
}

TEST_F(SweepTest, TheCommandLineHasTheLastWord) {
  const auto path = folder.file("sweep.toml", sweep_text("[each]\nmaterial.horizon = [2, 3]\n"));
  const Sweep made =
      read_sweep(path, {"sweep.replicates=5", "each.material.horizon=[2.5]", "material.rupture_delay=1.3"});
  EXPECT_EQ(made.keys.replicates, 5);
  ASSERT_EQ(made.cases.size(), 1U);
  EXPECT_EQ(made.cases[0].design->solver.material.horizon, 2.5);
  EXPECT_EQ(made.cases[0].design->solver.material.rupture_delay, 1.3);
}

TEST_F(SweepTest, SaysWhatIsWrong) {
  EXPECT_NE(refused(sweep_text("[grid]\nmaterial.horizont = [2, 3]\n")).find("horizon"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[grid]\nmaterial.horizon = 2\n")).find("list"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[grid]\nmaterial.horizon = [2, -1]\n")).find("material.horizon"), std::string::npos);
  EXPECT_NE(refused(sweep_text("")).find("nothing is varied"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[rows]\nmaterial.horizon = [2, 3]\nnoise.amplitude = [1]\n")).find("equally long"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[rows]\nname = [\"a\"]\nmaterial.horizon = [2, 3]\n")).find("1 names for 2 rows"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[rows]\nmaterial.horizon = [2]\n[grid]\nmaterial.horizon = [2]\n")).find("one table"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[each]\nmaterial.horizon = [2]\n", "measures = \"plateau\"")).find("plateau_stress"),
            std::string::npos);
  EXPECT_NE(refused("[sweep]\nreplicates = 2\n[each]\nmaterial.horizon = [2]\n").find("sweep.design"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[grids]\nmaterial.horizon = [2]\n")).find("[grid]"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[[rows]]\nmaterial.horizon = 2\n")).find("one table of lists"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[each]\nmaterial.horizon = []\n")).find("empty"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[rows]\nname = [\"a\", \"a\"]\nmaterial.horizon = [2, 3]\n")).find("two rows"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[set]\nmaterial.horizon = 2\n[grid]\nmaterial.horizon = [2, 3]\n")).find("varied"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[each]\nloading.until = [0.3, 0.4]\n", "until = 0.5")).find("varied"),
            std::string::npos);
  EXPECT_NE(input_error([&] {
              read_sweep(folder.file("sweep.toml", sweep_text("[each]\nmaterial.horizon = [2, 3]\n")),
                         {"material.horizon=2.5"});
            }).find("varied"),
            std::string::npos);
  const std::string message = refused(sweep_text("[grid]\nmaterial.horizon = [2, -1]\n"));
  EXPECT_NE(message.find("sweep.toml:5"), std::string::npos) << message;
}

TEST_F(SweepTest, ACaseThatCannotBeLaidStaysInTheTable) {
  const std::string text = sweep_text("[each]\nlayout.diameter = [\"16 mm\", \"30 mm\"]\n");
  SweepRun run(sweep(text), options("out"));
  ASSERT_EQ(run.sweep().cases.size(), 2U);
  EXPECT_NE(run.sweep().cases[1].problem.find("hole"), std::string::npos) << run.sweep().cases[1].problem;
  run.run();
  EXPECT_EQ(run.status(), results::RunStatus::completed);
  EXPECT_EQ(asked, 3);
  EXPECT_TRUE(to_json(run).at("cases").at(1).at("problem").is_string());
  EXPECT_NE(refused(sweep_text("[each]\nlayout.diameter = [\"30 mm\"]\n")).find("no case can be run"),
            std::string::npos);
}

}  // namespace
}  // namespace perfora::optimize
