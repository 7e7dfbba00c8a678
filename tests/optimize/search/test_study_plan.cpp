// What is here: plans of studies, budgets made into counts, fidelities. What is not: carrying them out.
#include "optimize/search/study_plan.h"

#include <gtest/gtest.h>

#include "io/journal.h"
#include "optimize/search/candidate.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

class StudyPlanTest : public testing::Test {
 protected:
  StudyFolder folder;
  Study read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return read_study(folder.file("study.toml", text), overrides);
  }
};

// "12 -> 4, halving": 12 run, 6 of them again, 4 are left.
TEST(RaceRounds, HalveDownToWhatIsKept) {
  EXPECT_EQ(race_rounds({12, 4, 2}), (std::vector<int>{12, 6}));
  EXPECT_EQ(race_rounds({9, 1, 2}), (std::vector<int>{9, 5, 3, 2}));
  EXPECT_EQ(race_rounds({3, 4, 2}), (std::vector<int>{3}));
  EXPECT_TRUE(race_rounds({0, 4, 2}).empty());
}

const std::string ladder =
    "[fidelity.cheap]\n\"cell.height\" = \"25 mm\"\n\"layout.rows\" = 1\ncost = \"20 s\"\n[fidelity.fine]\n"
    "\"loading.transits\" = 50\ncost = \"300 s\"\n";

TEST_F(StudyPlanTest, CountsEveryStageAtItsFidelity) {
  const Study study =
      read(study_text("maxeval = 10\nreplicates = 3\nfinal_replicates = 5\nfidelity = \"cheap\"") +
           "[map]\ndesigns = 20\n[race]\nfinalists = 6\nkeep = 2\n[verify]\nfidelity = \"fine\"\n" + ladder);
  const StudyPlan plan = plan_of(study);
  std::map<std::string, PlannedStage> stages;
  for (const PlannedStage& one : plan.stages) stages[one.name] = one;
  EXPECT_EQ(stages.at("map").runs, 40);
  EXPECT_EQ(stages.at("map").run_seconds, 20.0);
  EXPECT_EQ(stages.at("start").runs, 3);
  EXPECT_EQ(stages.at("search").runs, 30);
  EXPECT_EQ(stages.at("best of the map").runs, 6) << "two of three replicates are known from the map";
  EXPECT_EQ(stages.at("race").runs, (6 + 3) * 2);
  EXPECT_EQ(stages.at("verify").runs, 3 * 5) << "two designs and the start";
  EXPECT_EQ(stages.at("verify").run_seconds, 300.0);
  EXPECT_TRUE(stages.at("verify").measured);
  EXPECT_EQ(stages.at("confirm").runs, 10);
  EXPECT_DOUBLE_EQ(plan.seconds(), 20.0 * (40 + 3 + 30 + 6 + 18) + 300.0 * 25);

  const StudyPlan more =
      plan_of(read(study_text("maxeval = 10\nreplicates = 3\nfinal_replicates = 12\nfidelity = \"cheap\"") +
                   "[race]\nfinalists = 6\nkeep = 2\n[verify]\nfidelity = \"fine\"\n" + ladder));
  for (const PlannedStage& one : more.stages) stages[one.name] = one;
  EXPECT_EQ(stages.at("verify").runs, 2 * 12 + 5) << "the start on five";
  EXPECT_EQ(stages.at("confirm").runs, 12 + 5);
}

TEST_F(StudyPlanTest, ABudgetBecomesCountsThatKeepToIt) {
  const std::string text = study_text("replicates = 2\nfinal_replicates = 4\nfidelity = \"cheap\"", "rows = [1, 2]") +
                           "[verify]\nfidelity = \"fine\"\n" + ladder;
  const Study study = read(text, {"study.budget=10 h"});
  const StudyPlan plan = plan_of(study);
  EXPECT_LE(plan.seconds(), 36000.0);
  EXPECT_GT(plan.seconds(), 36000.0 - 3 * 40.0) << "what is left holds no further candidate";
  EXPECT_GT(study.keys.map.designs, 50);
  EXPECT_GT(study.keys.race.finalists, 2);
  int candidates = 0;
  for (const Arm& arm : study.arms) candidates += arm.maxeval;
  EXPECT_EQ(candidates, study.keys.maxeval);
  const Study twice = read(text, {"study.budget=20 h"});
  EXPECT_GT(twice.keys.maxeval, study.keys.maxeval);
  // What the file says is kept.
  const Study own = read(text, {"study.budget=10 h", "map.designs=5", "race.finalists=0"});
  EXPECT_EQ(own.keys.map.designs, 5);
  EXPECT_EQ(own.keys.race.finalists, 0);
}

TEST_F(StudyPlanTest, RefusesABudgetThatHoldsNoSearchAndTwoSayings) {
  const std::string text = study_text("", "rows = [1, 2]") + ladder;
  EXPECT_NE(input_error([&] { read(text, {"study.budget=3 s"}); }).find("too short"), std::string::npos);
  EXPECT_NE(input_error([&] {
              read(text, {"study.budget=3 h", "study.maxeval=5"});
            }).find("study.maxeval"),
            std::string::npos);
}

TEST_F(StudyPlanTest, ACandidateIsChangedAsItsFidelitySays) {
  const Study study = read(study_text("maxeval = 4") + "[map]\ndesigns = 4\nfidelity = \"cheap\"\n" + ladder);
  ASSERT_EQ(study.fidelities.size(), 2U);
  EXPECT_EQ(study.map_fidelity, 1U);
  EXPECT_EQ(study.verify_fidelity, 0U);
  CandidateBook book(study);
  const Candidate& one = book.at(0, std::vector<double>{0.016, 0.0});
  EXPECT_EQ(one.request(0, 0).design->layout.cell_height(), 0.05);
  EXPECT_EQ(one.request(0, 1).design->layout.cell_height(), 0.025);
  EXPECT_EQ(one.request(0, 1).fidelity, "cheap");
  EXPECT_NE(book.key(one, 0, 0), book.key(one, 0, 1));
}

TEST_F(StudyPlanTest, RefusesFidelitiesByKey) {
  const auto error = [&](const std::string& table, const std::string& override) {
    return input_error([&] { read(study_text("maxeval = 4") + table, {override}); });
  };
  EXPECT_NE(error(ladder, "study.fidelity=chaep").find("cheap, fine"), std::string::npos);
  EXPECT_NE(error("[fidelity.a]\n\"loading.until\" = 0.3\n", "study.fidelity=a").find("study.until"),
            std::string::npos);
  EXPECT_NE(error("[fidelity.a]\n\"material.grade\" = 2\n", "study.fidelity=a").find("costs nothing"),
            std::string::npos);
  EXPECT_NE(error("[fidelity.a]\n\"cell.heihgt\" = 2\n", "study.fidelity=a").find("cell.height"), std::string::npos);
  EXPECT_NE(error("[fidelity.a]\ncost = -2\n", "study.fidelity=a").find("takes some time"), std::string::npos);
}

// The counts stand in the journal: what a later program estimates changes no study that has begun.
TEST_F(StudyPlanTest, CountsOfAJournalAreKept) {
  Study study = read(study_text("replicates = 2") + ladder, {"study.budget=10 h", "study.fidelity=cheap"});
  const int counted = study.keys.maxeval;
  folder.file("journal.jsonl", "");
  {
    nlohmann::json head = {{"event", "study"}, {"plan", planned(study)}};
    head["plan"]["maxeval"] = 7;
    head["plan"]["arms"]["all"] = 7;
    io::Journal(folder / "journal.jsonl").append(head.dump());
  }
  keep_planned(study, folder / "");
  EXPECT_EQ(study.keys.maxeval, 7);
  EXPECT_EQ(study.arms[0].maxeval, 7);
  Study other = read(study_text("replicates = 2") + ladder, {"study.budget=11 h", "study.fidelity=cheap"});
  keep_planned(other, folder / "");
  EXPECT_GT(other.keys.maxeval, counted) << "another budget is another plan";
}

}  // namespace
}  // namespace perfora::optimize
