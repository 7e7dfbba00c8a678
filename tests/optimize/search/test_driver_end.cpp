// What is here: the end of studies on formulas: race, verification, the pick among several and its confirmation. What
// is not: the search before (test_driver.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "optimize/search/driver.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

class DriverEnd : public testing::Test {
 protected:
  StudyFolder folder;
  Study study(const std::string& keys, const std::string& tables = "") {
    return read_study(folder.file("study.toml", study_text(keys) + tables));
  }
};

const char* const race = "[race]\nfinalists = 8\nkeep = 3\nreplicates = 2\n";

TEST_F(DriverEnd, TheRaceHalvesOnPairedSeeds) {
  const Study one = study("maxeval = 20\nreplicates = 2\nfinal_replicates = 3\nalgorithm = \"GN_CRS2_LM\"", race);
  std::map<int, std::set<std::string>> raced;  // designs by replicate
  Driver driver(one);
  Answers answers;
  const Plan plan = search_to_end(driver, answers, [&](const Request& request) {
    if (request.replicate >= first_race_replicate)
      raced[request.replicate - first_race_replicate].insert(DesignFile(*request.design).schema().to_toml());
    return fake_evaluation(request);
  });
  ASSERT_EQ(raced.size(), 4U);
  EXPECT_EQ(raced[0].size(), 8U);
  EXPECT_EQ(raced[0], raced[1]) << "every round has all its designs on the same seeds";
  EXPECT_EQ(raced[2].size(), 4U);
  EXPECT_EQ(raced[2], raced[3]);
  ASSERT_EQ(plan.finalists.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(plan.finalists[k].kept, k < 3) << k;
  EXPECT_EQ(plan.finalists[0].score.replicates, 2 + 4);
  EXPECT_EQ(plan.finalists[7].score.replicates, 2 + 2);
  EXPECT_EQ(plan.verified.size(), 3U);
}

// What a map has seen has chosen what the search began with: the verification begins behind it.
TEST_F(DriverEnd, FreshSeedsLieBehindThoseOfTheMap) {
  const std::string keys = "algorithm = \"sobol\"\nmaxeval = 3\nreplicates = 1\nfinal_replicates = 3";
  for (const bool mapped : {false, true}) {
    const Study one = study(keys, mapped ? "[map]\ndesigns = 4\nreplicates = 3\n" : "");
    Driver driver(one);
    Answers answers;
    const Plan plan = search_to_end(driver, answers, fake_evaluation);
    EXPECT_EQ(plan.finals.first, mapped ? 3 : 1);
    EXPECT_EQ(plan.finals.best.replicates, 3);
    const auto told = [](const std::string& warning) {
      return warning.find("study.replicates = 1 is below map.replicates = 3") != std::string::npos;
    };
    EXPECT_EQ(std::any_of(one.warnings.begin(), one.warnings.end(), told), mapped);
  }
}

// Best seen is a fluke more often than not: a design that only the seeds of the search like loses the race.
TEST_F(DriverEnd, TheRaceThrowsOutAFluke) {
  const auto evaluate = [](const Request& request) {
    Evaluation evaluation = fake_evaluation(request);
    const double diameter = request.design->layout.diameter;
    const bool lucky = diameter < 0.0155 && request.replicate < first_race_replicate;
    if (lucky) evaluation.summary.plateau_stress = fake_target;
    if (lucky) evaluation.summary.target_distance = 0.0;
    return evaluation;
  };
  const std::string keys = "maxeval = 24\nreplicates = 1\nfinal_replicates = 0";
  Answers plain_answers, answers;
  const Study without = study(keys);
  Driver plain(without);
  EXPECT_LT(search_to_end(plain, plain_answers, evaluate).best->values[0], 0.0155);
  const Study with = study(keys, "[race]\nfinalists = 24\nkeep = 1\nreplicates = 4\n");
  Driver raced(with);
  EXPECT_GT(search_to_end(raced, answers, evaluate).best->values[0], 0.0155);
}

TEST_F(DriverEnd, VerifiesAtItsFidelityOnFreshSeeds) {
  const Study one = study("maxeval = 6\nreplicates = 2\nfinal_replicates = 3",
                          "[verify]\nfidelity = \"fine\"\n[fidelity.fine]\n\"loading.transits\" = 60\n");
  std::set<int> fine, plain;
  Driver driver(one);
  Answers answers;
  const Plan plan = search_to_end(driver, answers, [&](const Request& request) {
    (request.fidelity == "fine" ? fine : plain).insert(request.replicate);
    EXPECT_EQ(request.design->solver.loading.transits == 60.0, request.fidelity == "fine");
    return fake_evaluation(request);
  });
  EXPECT_EQ(plain, (std::set<int>{0, 1}));
  EXPECT_EQ(fine, (std::set<int>{2, 3, 4}));
  EXPECT_EQ(plan.finals.fidelity, 1U);
  EXPECT_EQ(plan.finals.pairs, 3);
}

// What the search found keeps its wish on the seeds that chose it alone, the start on fresh ones: the start is
// recommended, judged on seeds of its own, and no gain is told.
TEST_F(DriverEnd, TheStartIsRecommendedWhereItKeepsMore) {
  const Study one = study("maxeval = 12\nreplicates = 1\nfinal_replicates = 4");
  Driver driver(one);
  Answers answers;
  const Plan plan = search_to_end(driver, answers, [&](const Request& request) {
    Evaluation evaluation = fake_evaluation(request);
    const bool is_start = std::abs(request.design->layout.diameter - 0.016) < 1e-9;
    const double level = is_start ? 1.0 : request.replicate == 0 ? 1.1 : 3.0;
    evaluation.summary.plateau_stress = fake_target * level * (1.0 + 0.001 * request.replicate / 1e6);
    evaluation.summary.target_distance = is_start ? 0.9 : 0.1;  // a search by the score leaves the start behind
    return evaluation;
  });
  EXPECT_EQ(plan.best, plan.start.candidate);
  EXPECT_EQ(plan.finals.first, first_confirming_replicate);
  EXPECT_EQ(plan.finals.best.not_kept, 0);
  EXPECT_EQ(plan.finals.gain, 0.0);
  EXPECT_FALSE(plan.finals.significant);
}

// The first of the race misses on the fresh seeds, another one meets: it is recommended, and judged on seeds of its
// own.
TEST_F(DriverEnd, ADesignPickedAmongSeveralIsConfirmed) {
  const Study one =
      study("maxeval = 12\nreplicates = 1\nfinal_replicates = 4", "[race]\nfinalists = 4\nkeep = 4\nreplicates = 1\n");
  std::set<std::string> confirming;
  Driver driver(one);
  Answers answers;
  const Plan plan = search_to_end(driver, answers, [&](const Request& request) {
    Evaluation evaluation = fake_evaluation(request);
    if (request.replicate >= first_confirming_replicate)
      confirming.insert(DesignFile(*request.design).schema().to_toml());
    const bool chosen = request.replicate == 0 || request.replicate == first_race_replicate;
    if (chosen) return evaluation;
    // Fresh seeds turn the order round: what looked best is a factor of three off, the others meet.
    const double diameter = request.design->layout.diameter, jitter = request.design->layout.jitter;
    const bool looked_best = fake_distance(diameter, jitter) < 0.005;
    evaluation.summary.plateau_stress =
        fake_target * (looked_best ? 3.0 : 1.0) * (1.0 + 0.001 * request.replicate / 1e6);
    return evaluation;
  });
  ASSERT_EQ(plan.verified.size(), 4U);
  ASSERT_NE(plan.verified.front().outcome, results::Outcome::met);
  EXPECT_NE(plan.best, plan.finalists.front().candidate);
  EXPECT_EQ(plan.finals.first, first_confirming_replicate);
  EXPECT_EQ(confirming.size(), 2U) << "the picked design and the start";
}

TEST_F(DriverEnd, WithoutARaceTheBestAloneIsVerified) {
  const Study one = study("maxeval = 6\nfinal_replicates = 3");
  Driver driver(one);
  Answers answers;
  const Plan plan = search_to_end(driver, answers, fake_evaluation);
  ASSERT_EQ(plan.verified.size(), 1U);
  EXPECT_EQ(plan.verified.front().candidate, plan.best);
  EXPECT_TRUE(plan.finalists.empty());
  EXPECT_EQ(plan.finals.first, 1);
}

}  // namespace
}  // namespace perfora::optimize
