// What is here: what a few blocks say of the next, against published numbers and closed forms. What is not: verdicts
// (test_verdict.cpp).
#include "results/assurance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace perfora::results {
namespace {

// Nobody of n fails: the lower bound is (0.025)^(1/n). 4 of 10: Clopper and Pearson's own method as tables give it,
// 0.1216 to 0.7376.
TEST(Assurance, BinomialIntervalIsClopperAndPearsons) {
  EXPECT_NEAR(binomial_interval(8, 8).low, std::pow(0.025, 1.0 / 8.0), 1e-12);
  EXPECT_EQ(binomial_interval(8, 8).high, 1.0);
  EXPECT_NEAR(binomial_interval(29, 29).low, std::pow(0.025, 1.0 / 29.0), 1e-12);
  EXPECT_NEAR(binomial_interval(0, 5).high, 1.0 - std::pow(0.025, 1.0 / 5.0), 1e-12);
  EXPECT_NEAR(binomial_interval(4, 10).low, 0.1216, 1e-4);
  EXPECT_NEAR(binomial_interval(4, 10).high, 0.7376, 1e-4);
}

// -1, 0, 1 around 0 have s = 1 and n = 3; Student's t for 2 degrees of freedom at 97.5 % is 4.302653.
TEST(Assurance, PredictionIntervalIsStudents) {
  const Interval level = prediction_interval({-1.0, 0.0, 1.0});
  EXPECT_NEAR(level.high, 4.302653 * std::sqrt(4.0 / 3.0), 1e-6);
  EXPECT_NEAR(level.low, -level.high, 1e-12);
  const Interval stress = prediction_interval({std::exp(-1.0), 1.0, std::exp(1.0)});
  EXPECT_NEAR(std::log(stress.high), level.high, 1e-12);
}

TEST(Assurance, CountsBlocksThatKeepEveryWish) {
  Target target;
  target.plateau_stress = 1e5;
  target.tolerance = 0.2;
  std::vector<Evaluation> runs(4);
  const double plateaus[] = {0.9e5, 1.1e5, 1.3e5, 1.0e5};
  for (std::size_t k = 0; k < runs.size(); ++k) runs[k].summary.plateau_stress = plateaus[k];
  runs[3].status = RunStatus::failed;  // a block without a curve keeps nothing
  std::vector<const Evaluation*> blocks;
  for (const Evaluation& run : runs) blocks.push_back(&run);
  const Assurance found = assurance_of(target, blocks);
  EXPECT_EQ(found.blocks, 4);
  EXPECT_EQ(found.keeping, 2);
  ASSERT_EQ(found.next.size(), 1U);
  EXPECT_NE(in_words(found).find("2 of 4 single blocks"), std::string::npos);
  EXPECT_EQ(found.next[0].count, 3);
  EXPECT_NE(in_words(found).find("(where it has one, as 3 of these)"), std::string::npos) << in_words(found);
}

}  // namespace
}  // namespace perfora::results
