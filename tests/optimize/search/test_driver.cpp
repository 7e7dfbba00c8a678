// What is here: the search by replay over designs: the straight trajectory, any order of answers, incumbent, second
// stage, comparison on fresh seeds. Evaluations are formulas, so optimum and gains are known. What is not: NLopt alone
// (test_nlopt_search.cpp), files (test_study_run.cpp).
#include <gtest/gtest.h>

#include <random>

#include "optimize/search/driver.h"
#include "optimize/search/nlopt_search.h"
#include "tests/optimize/search/study_support.h"
#include "tests/support/thinned.h"

namespace perfora::optimize {
namespace {

class DriverTest : public testing::Test {
 protected:
  StudyFolder folder;
  Study study(const std::string& keys, const std::string& arms = "", const std::string& constraints = "") {
    return read_study(folder.file("study.toml", study_text(keys, arms, constraints)));
  }
};

/// Everything that a finished plan says, as text.
std::string digest(const Plan& plan) {
  std::string text = plan.reason + "\n";
  for (const Trace& trace : plan.traces) {
    text += std::to_string(trace.arm) + (trace.refine ? " refine " : " ") + trace.reason + "\n";
    for (const Visit& visit : trace.visits) text += visit.candidate->label + " " + std::to_string(visit.score) + "\n";
  }
  text += plan.best ? plan.best->label + " " + std::to_string(plan.best_score.value) : "none";
  return text + " " + std::to_string(plan.finals.gain) + " " + std::to_string(plan.finals.gain_error);
}

/// Answers `at_once` random open questions at a time, as that many workers would.
Plan search(Driver& driver, Answers& answers, const Evaluate& evaluate, std::size_t at_once, unsigned seed,
            int* rounds = nullptr) {
  std::mt19937 random(seed);
  for (int round = 0; round < 5000; ++round) {
    Plan plan = driver.plan(answers);
    if (rounds) *rounds = round;
    if (plan.finished) return plan;
    EXPECT_FALSE(plan.wanted.empty());
    std::shuffle(plan.wanted.begin(), plan.wanted.end(), random);
    for (std::size_t k = 0; k < std::min(at_once, plan.wanted.size()); ++k)
      answers.add(plan.wanted[k].key, evaluate(plan.wanted[k].request));
  }
  ADD_FAILURE() << "the search did not end";
  return {};
}

/// A search with the driver that its plan points into.
struct Searched {
  explicit Searched(const Study& study, const Evaluate& evaluate, std::size_t at_once = 1)
      : driver(study), plan(search(driver, answers, evaluate, at_once, 1)) {}
  Answers answers;
  Driver driver;
  Plan plan;
};

class StraightTrajectory : public testing::TestWithParam<std::string> {};

TEST_P(StraightTrajectory, IsWhatTheDriverVisits) {
  const StudyFolder folder;
  const Study study = read_study(
      folder.file("study.toml", study_text("maxeval = 25\nfinal_replicates = 0\nalgorithm = \"" + GetParam() + "\"")));
  for (const auto& evaluate : {fake_evaluation, fake_with_failures}) {
    Answers answers;
    Driver driver(study);
    const Plan plan = search(driver, answers, evaluate, 1, 1);
    // Straight: the same search with every value known at once.
    CandidateBook book(study);
    SearchOptions options;
    options.algorithm = study.keys.algorithm;
    options.dimension = 2;
    options.maxeval = 25;
    options.seed = study.arms[0].seed;
    options.start = study.arms[0].start;
    options.initial_step = study.keys.initial_step;
    std::vector<std::vector<double>> points;
    std::vector<double> scores;
    run_search(options, [&](std::span<const double> x) -> std::optional<double> {
      const Candidate& candidate = book.at(0, study.values_at(x));
      points.push_back(candidate.values);
      const Evaluation evaluation = evaluate(candidate.request(0));
      const Evaluation* pointer = &evaluation;
      scores.push_back(candidate.violation > 0.0 ? violation_score(candidate.violation)
                                                 : score_of(study.target, {&pointer, 1}).value);
      return scores.back();
    });
    ASSERT_EQ(plan.traces.size(), 1U);
    ASSERT_EQ(plan.traces[0].visits.size(), points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_EQ(plan.traces[0].visits[k].candidate->values, points[k]) << k;
      EXPECT_EQ(plan.traces[0].visits[k].score, scores[k]) << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Driver, StraightTrajectory,
                         testing::Values("GN_DIRECT_L", "GN_CRS2_LM", "GN_ESCH", "LN_SBPLX", "LN_BOBYQA",
                                         "LN_NELDERMEAD", "LN_NEWUOA_BOUND"),
                         [](const testing::TestParamInfo<std::string>& instance) { return instance.param; });

TEST_F(DriverTest, FindsTheKnownOptimum) {
  const Study two = study("maxeval = 80\nalgorithm = \"LN_SBPLX\"\nreplicates = 1");
  const Searched searched(two, fake_evaluation, 4);
  const Plan& plan = searched.plan;
  ASSERT_NE(plan.best, nullptr);
  // Replicate 0 scatters by 1 % sin(1), so the score's minimum lies where the plateau is off by less than that.
  EXPECT_LT(plan.best_score.value, 2e-4);
  EXPECT_LT(fake_distance(plan.best->values[0], plan.best->values[1]), 1e-3);
}

TEST_F(DriverTest, NeitherWorkersNorTheOrderOfAnswersChangeAnything) {
  for (const char* algorithm : {"GN_DIRECT_L", "GN_CRS2_LM", "LN_COBYLA", "GN_ISRES"}) {
    const Study arms =
        study(std::string("maxeval = 30\nreplicates = 3\nrefine = \"LN_SBPLX\"\nrefine_maxeval = 6\nalgorithm = \"") +
                  algorithm + "\"",
              "rows = [1, 2]\ncolumns = [2, 3]");
    std::string first;
    for (const std::size_t workers : {1U, 2U, 5U, 64U})
      for (int seed = 1; seed <= test::thinned(2, 1); ++seed) {
        Answers answers;
        Driver driver(arms);
        const std::string text =
            digest(search(driver, answers, fake_with_failures, workers, static_cast<unsigned>(seed)));
        if (first.empty()) first = text;
        EXPECT_EQ(text, first) << algorithm << " with " << workers << " workers";
      }
  }
}

TEST_F(DriverTest, AsksForAllArmsAndReplicatesAtOnce) {
  const Study arms = study("maxeval = 12\nreplicates = 3", "rows = [1, 2]\ncolumns = [1, 2]");
  Driver driver(arms);
  const Plan plan = driver.plan({});
  // Four arms and the start design, three replicates each.
  EXPECT_EQ(plan.wanted.size(), 15U);
  std::set<std::string> keys;
  for (const Wanted& wanted : plan.wanted) keys.insert(wanted.key);
  EXPECT_EQ(keys.size(), plan.wanted.size());
}

TEST_F(DriverTest, GivesEveryCandidateTheSameSeeds) {
  const Study one = study("maxeval = 6\nreplicates = 2");
  std::set<int> replicates;
  const Searched searched(one, [&](const Request& request) {
    replicates.insert(request.replicate);
    EXPECT_DOUBLE_EQ(request.until, 0.45);
    return fake_evaluation(request);
  });
  EXPECT_EQ(replicates, (std::set<int>{0, 1, 2, 3, 4, 5, 6}));  // Two of the search, five fresh ones.
}

TEST_F(DriverTest, KeepsItsOwnIncumbent) {
  // The best of everything that was visited, whatever NLopt returns.
  for (const char* algorithm : {"GN_CRS2_LM", "GN_AGS", "GN_MLSL", "GN_DIRECT_L"}) {
    const Study one = study(std::string("maxeval = 40\nfinal_replicates = 0\nalgorithm = \"") + algorithm + "\"");
    const Searched searched(one, fake_with_failures);
    const Plan& plan = searched.plan;
    double lowest = plan.start.score;
    for (const Visit& visit : plan.traces[0].visits) lowest = std::min(lowest, visit.score);
    EXPECT_EQ(plan.best_score.value, lowest) << algorithm;
  }
}

TEST_F(DriverTest, SimulatesNothingThatBreaksAConstraint) {
  for (const char* algorithm :
       {"GN_DIRECT_L", "LN_SBPLX", "LN_COBYLA", "GN_ISRES", "GN_ORIG_DIRECT_L", "GN_AGS", "GN_ESCH"}) {
    const Study walls = study(std::string("maxeval = 30\nfinal_replicates = 0\nalgorithm = \"") + algorithm + "\"", "",
                              "thinnest_wall = \"8 mm\"");
    const Searched searched(walls, [](const Request& request) {
      // At no jitter the wall is 25 mm - d; jitter only thins it.
      EXPECT_LE(request.design->layout.diameter, 0.017 + 1e-9);
      return fake_evaluation(request);
    });
    const Plan& plan = searched.plan;
    ASSERT_NE(plan.best, nullptr) << algorithm;
    EXPECT_GE(plan.best->layout.thinnest_wall, 0.008 - 1e-10) << algorithm;
  }
}

TEST_F(DriverTest, TheSecondStageBeginsAtTheIncumbent) {
  const Study two =
      study("maxeval = 10\nrefine = \"LN_SBPLX\"\nrefine_maxeval = 25\nfinal_replicates = 0", "rows = [1, 2]");
  const Searched searched(two, fake_evaluation);
  const Plan& plan = searched.plan;
  ASSERT_EQ(plan.traces.size(), 3U);
  EXPECT_TRUE(plan.traces[2].refine);
  double before = 1e9;
  std::vector<double> where;
  for (int k = 0; k < 2; ++k)
    for (const Visit& visit : plan.traces[static_cast<std::size_t>(k)].visits)
      if (visit.score < before) before = visit.score, where = visit.candidate->values;
  EXPECT_EQ(plan.traces[2].arm, 1);
  EXPECT_NEAR(plan.traces[2].visits[0].candidate->values[0], where[0], 1e-9);
  EXPECT_LE(plan.best_score.value, before);
}

TEST_F(DriverTest, ComparesBestAndStartPairByPair) {
  const Study one = study("maxeval = 20\nfinal_replicates = 4");
  const Searched searched(one, fake_evaluation);
  const Plan& plan = searched.plan;
  ASSERT_EQ(plan.finals.pairs, 4);
  // By hand: the fake plateau of start (16 mm, no jitter) and best on replicates 1 to 4.
  const auto single = [](double diameter, double jitter, int replicate) {
    const double plateau =
        (1.0 + std::sqrt(fake_distance(diameter, jitter))) * (1.0 + 0.01 * std::sin(1.0 + 2.0 * replicate));
    return std::pow(std::log(plateau), 2);  // what wishes cost that a block does not keep is left out
  };
  double sum = 0.0, squares = 0.0;
  for (int replicate = 1; replicate <= 4; ++replicate) {
    const double gain = single(0.016, 0.0, replicate) - single(plan.best->values[0], plan.best->values[1], replicate);
    sum += gain;
    squares += gain * gain;
  }
  const double mean = sum / 4.0, error = std::sqrt((squares - 4.0 * mean * mean) / 3.0 / 4.0);
  EXPECT_NEAR(plan.finals.gain, mean, 1e-9);
  EXPECT_NEAR(plan.finals.gain_error, error, 1e-9);
  EXPECT_NEAR(plan.finals.gain_interval, 3.182446 * error,
              1e-6 * error);  // Student's t of 97.5 %, 3 degrees of freedom
  EXPECT_TRUE(plan.finals.significant);
}

TEST_F(DriverTest, TheStartRunsOnFiveFreshSeedsAtMost) {
  const Searched searched(study("maxeval = 20\nfinal_replicates = 7"), fake_evaluation);
  const Plan& plan = searched.plan;
  EXPECT_EQ(plan.finals.best.replicates, 7);
  EXPECT_EQ(plan.finals.start.replicates, 5);
  EXPECT_EQ(plan.finals.pairs, 5);
  EXPECT_TRUE(plan.finals.significant) << "every pair that was asked for is there";
}

TEST_F(DriverTest, ReportsNoGainWhenTheStartIsBest) {
  const Study one = read_study(folder.file("study.toml", study_text("maxeval = 5")),
                               {"layout.diameter=0.0175", "layout.jitter=0.0004"});
  const Searched searched(one, fake_evaluation);
  const Plan& plan = searched.plan;
  EXPECT_EQ(plan.best, plan.start.candidate);
  EXPECT_EQ(plan.finals.gain, 0.0);
  EXPECT_FALSE(plan.finals.significant);
}

TEST_F(DriverTest, EndsWithNothingWhenEverythingFails) {
  const Study one = study("maxeval = 8");
  const Searched searched(one,
                          [](const Request& request) { return failed_evaluation("unstable step", request.replicate); });
  const Plan& plan = searched.plan;
  EXPECT_TRUE(plan.finished);
  EXPECT_EQ(plan.best, nullptr);
  EXPECT_NE(plan.reason.find("no candidate"), std::string::npos);
}

TEST_F(DriverTest, LeavesAStartOutsideTheBoundsOutOfTheSearch) {
  const Study one = read_study(folder.file("study.toml", study_text("maxeval = 6")), {"layout.diameter=0.010"});
  const Searched searched(one, [](const Request& request) {
    Evaluation evaluation = fake_evaluation(request);
    // The start would be perfect, but it is not a candidate.
    if (request.design->layout.diameter == 0.010) {
      evaluation.summary.plateau_stress = fake_target;
      evaluation.summary.target_distance = 0.0;
    }
    return evaluation;
  });
  const Plan& plan = searched.plan;
  EXPECT_EQ(plan.start.candidate->arm, -1);
  EXPECT_EQ(plan.start.score, 0.0);
  ASSERT_NE(plan.best, nullptr);
  EXPECT_GE(plan.best->values[0], 0.014);
  EXPECT_LT(plan.finals.gain, 0.0);
}

}  // namespace
}  // namespace perfora::optimize
