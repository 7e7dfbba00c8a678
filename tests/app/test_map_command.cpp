// What is here: maps as a user runs them: alone, as the beginning of a study, compared at two fidelities. What is not:
// what a map is made of (tests/optimize/search/test_map.cpp).
#include "command_line.h"

namespace perfora::test {
namespace {

class MapCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    std::ofstream(folder_ / "s.toml") << "[study]\ndesign = \"d.toml\"\nmaxeval = 2\nreplicates = 1\n"
                                         "final_replicates = 3\n[target]\nplateau_stress = \"0.4 MPa\"\n"
                                         "[variables]\ndiameter = [\"4 mm\", \"7 mm\"]\n[map]\ndesigns = 4\n"
                                         "replicates = 1\n[race]\nfinalists = 2\nkeep = 1\nreplicates = 1\n"
                                         "[fidelity.coarse]\n\"packing.mean_diameter\" = \"0.7 mm\"\n"
                                         "\"packing.maximum_diameter\" = \"1.39 mm\"\n";
  }
  json result(const std::string& folder, const std::string& file) const {
    return json::parse(read_text(folder_ / folder / file));
  }
};

TEST_F(MapCommand, ServesAStudyWithoutRunningAgain) {
  const Outcome map = run("map s.toml -o m --workers 2");
  ASSERT_EQ(map.exit_code, 0) << map.error;
  EXPECT_NE(map.output.find("Map: 4 designs, 1 replicate of each"), std::string::npos) << map.output;
  for (const char* name : {"map.json", "map.csv", "map.png", "journal.jsonl"})
    EXPECT_TRUE(fs::exists(folder_ / "m" / name)) << name;
  EXPECT_EQ(result("m", "map.json").at("designs").size(), 4U);
  const Outcome again = run("map s.toml -o m");
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_NE(again.error.find("holds a map already"), std::string::npos) << again.error;

  const Outcome study = run("optimize s.toml -o r --map m --no-run-file --workers 2");
  ASSERT_EQ(study.exit_code, 0) << study.error;
  EXPECT_NE(study.error.find("best of the 4 mapped designs"), std::string::npos) << study.error;
  const json record = result("r", "result.json");
  EXPECT_EQ(record.at("map").at("designs"), 4);
  EXPECT_EQ(record.at("map").at("taken_over"), 4);
  EXPECT_EQ(record.at("race").size(), 2U);
  EXPECT_TRUE(record.contains("single_blocks"));
  EXPECT_TRUE(fs::exists(folder_ / "r" / "candidates.csv"));
  EXPECT_EQ(run("plot m -o again.png --quiet").exit_code, 0);

  // A journal that was copied alone serves its own wish; for another one its runs are made again, which is said.
  fs::create_directory(folder_ / "alone");
  fs::copy_file(folder_ / "m" / "journal.jsonl", folder_ / "alone" / "journal.jsonl");
  const Outcome same = run("optimize s.toml -o same --map alone --no-run-file --workers 2");
  EXPECT_EQ(same.error.find("without their history"), std::string::npos) << same.error;
  const Outcome alone =
      run("optimize s.toml -o without --map alone --no-run-file --workers 2 --set target.plateau_stress=3e5");
  EXPECT_EQ(alone.exit_code, 0) << alone.error;
  EXPECT_NE(alone.error.find("4 of the 4 runs in " + (folder_ / "alone").string() + " are without their history"),
            std::string::npos)
      << alone.error;

  // Another wish in the same folder: what is replaced is said.
  EXPECT_EQ(study.error.find("another wish"), std::string::npos) << study.error;
  const Outcome changed = run("optimize s.toml -o r --resume --map m --no-run-file --set target.plateau_stress=3e5");
  ASSERT_EQ(changed.exit_code, 0) << changed.error;
  EXPECT_NE(changed.error.find("holds results for another wish (plateau stress 320 to 480 kPa)"), std::string::npos)
      << changed.error;

  // A wish that nothing comes near, on the same map: said before anything is run.
  const Outcome far = run("optimize s.toml -o far --map m --no-run-file --set target.plateau_stress=9e7");
  EXPECT_EQ(far.error.find("out of the reachable range") < far.error.find("evaluation"), true) << far.error;
  const Outcome other = run("optimize s.toml -o other --map m --set material.horizon=2.9");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.error.find("design.material.horizon"), std::string::npos) << other.error;
}

TEST_F(MapCommand, TwoFidelitiesAreCompared) {
  ASSERT_EQ(run("map s.toml -o fine --workers 2 --quiet").exit_code, 0);
  const Outcome coarse = run("map s.toml -o coarse --workers 2 --set map.fidelity=coarse");
  ASSERT_EQ(coarse.exit_code, 0) << coarse.error;
  const Outcome compared = run("correlate fine coarse --measures first_peak_stress");
  ASSERT_EQ(compared.exit_code, 0) << compared.error;
  EXPECT_NE(compared.output.find("a run took"), std::string::npos) << compared.output;
}

TEST_F(MapCommand, ChecksThePlan) {
  const Outcome plan = run("check s.toml --workers 2");
  ASSERT_EQ(plan.exit_code, 0) << plan.error;
  for (const char* part : {"map", "search", "race", "verify", "time on 2 processors"})
    EXPECT_NE(plan.output.find(part), std::string::npos) << part << "\n" << plan.output;
}

}  // namespace
}  // namespace perfora::test
