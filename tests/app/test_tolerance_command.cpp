// What is here: a tolerance analysis as a user runs it. What is not: its blocks
// (tests/optimize/campaign/test_tolerance.cpp).
#include "command_line.h"

namespace perfora::test {
namespace {

TEST_F(CommandLine, AToleranceAnalysisSaysWhatStillHolds) {
  std::ofstream(folder_ / "t.toml") << "[tolerance]\ndesign = \"d.toml\"\nreplicates = 2\nhole_size = \"0.1 mm\"\n"
                                       "hole_position = 0\n[set]\ntarget.plateau_stress = \"0.4 MPa\"\n"
                                       "loading.rate = 0\nloading.transits = 5\n";
  EXPECT_EQ(run("check t.toml").exit_code, 0);
  const Outcome analysed = run("tolerance t.toml -o t --workers 2");
  ASSERT_EQ(analysed.exit_code, 0) << analysed.error;
  for (const char* part : {"undisturbed: ", "hole size +- 100 um: ", "grade - 10 %: ", "grade + 10 %: ",
                           "tilt +- 5 deg: left out: ", "change"})
    EXPECT_NE(analysed.output.find(part), std::string::npos) << part << "\n" << analysed.output;
  const json record = json::parse(read_text(folder_ / "t" / "tolerance.json"));
  // 2 times 2 blocks are run; those of another grade follow from them, in proportion.
  EXPECT_NE(analysed.error.find("run 4 of 4"), std::string::npos) << analysed.error;
  EXPECT_EQ(json::parse(read_text(folder_ / "t" / "result.json")).at("cases").size(), 4U);
  const json& weaker = record.at("deviations").at(1).at("wishes").at(0);
  const double mean = record.at("undisturbed").at("wishes").at(0).at("mean");
  EXPECT_NEAR(weaker.at("mean").get<double>(), 0.9 * mean, 1e-6 * mean);
  for (const char* name : {"tolerance.csv", "sweep.png", "journal.jsonl"})
    EXPECT_TRUE(fs::exists(folder_ / "t" / name));
  EXPECT_EQ(run("show t/tolerance.json").output.find("undisturbed: ") == std::string::npos, false);
  EXPECT_EQ(run("tolerance t.toml -o t").exit_code, 1);
  EXPECT_EQ(run("tolerance t.toml -o t --resume --quiet").exit_code, 0);
  EXPECT_EQ(run("tolerance d.toml -o u").exit_code, 1) << "it wishes nothing";
}

}  // namespace
}  // namespace perfora::test
