// What is here: intervals against published factors and against their own promise (simulated coverage), and what a
// verdict says of made replicates. What is not: wishes (test_target.cpp).
#include "results/verdict.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "results/interval.h"

namespace perfora::results {
namespace {

// Two-sided factors for a content of 90 % with confidence 95 %: Eisenhart, Hastay and Wallis 1947, table 2.1. Howe's
// formula is good to 0.1 % from ten values on; at five it is 3 % wide.
TEST(Interval, HowesFactorsAreThePublishedOnes) {
  EXPECT_NEAR(tolerance_factor(10, 0.9), 2.839, 0.003);
  EXPECT_NEAR(tolerance_factor(20, 0.9), 2.310, 0.003);
  EXPECT_NEAR(tolerance_factor(30, 0.9), 2.140, 0.003);
  EXPECT_NEAR(tolerance_factor(5, 0.9), 4.152, 0.04 * 4.152);
}

// t = 2.776 for 4 degrees of freedom: 1 to 5 have mean 3 and deviation sqrt(2.5).
TEST(Interval, MeanIntervalIsStudents) {
  // Two blocks say little: Student's half-width of 1 and 3 is 12.71; no mean of what is never negative lies below 0.
  EXPECT_EQ(mean_interval({1.0, 3.0}).low, 0.0);
  EXPECT_NEAR(mean_interval({1.0, 3.0}).high, 2.0 + 12.7062, 1e-4);
  EXPECT_NEAR(mean_interval({-1.0, 3.0}).low, 1.0 - 2.0 * 12.7062, 1e-3);
  const Interval interval = mean_interval({1.0, 2.0, 3.0, 4.0, 5.0});
  EXPECT_NEAR(interval.low, 3.0 - 2.776 * std::sqrt(2.5 / 5.0), 1e-3);
  EXPECT_NEAR(interval.high, 3.0 + 2.776 * std::sqrt(2.5 / 5.0), 1e-3);
}

/// Scatter of a measure between blocks: coefficients of variation of 0.18 to 0.44 were recorded.
struct Scatter {
  const char* name;
  bool logarithmic;
  double deviation;  ///< of the values over their mean, or of their logarithms
  double draw(std::mt19937_64& random) const {
    std::normal_distribution<double> normal(0.0, deviation);
    return logarithmic ? std::exp(normal(random) - 0.5 * deviation * deviation) : 1.0 + normal(random);
  }
  double below(double x) const {
    const boost::math::normal normal(logarithmic ? -0.5 * deviation * deviation : 1.0, deviation);
    if (logarithmic && x <= 0.0) return 0.0;
    return boost::math::cdf(normal, logarithmic ? std::log(x) : x);
  }
};

constexpr Scatter scatters[] = {{"normal", false, 0.2}, {"lognormal 0.2", true, 0.2}, {"lognormal 0.42", true, 0.42}};
constexpr int samples = 4000;

/// Draws samples of 3 to 12 blocks and asks of each whether its interval holds what it promises.
void expect_coverage(unsigned seed, const std::function<bool(const Scatter&, const std::vector<double>&)>& held_by) {
  std::mt19937_64 random(seed);
  for (const Scatter& scatter : scatters)
    for (const int count : {3, 5, 8, 12}) {
      int held = 0;
      for (int sample = 0; sample < samples; ++sample) {
        std::vector<double> values;
        for (int k = 0; k < count; ++k) values.push_back(scatter.draw(random));
        held += held_by(scatter, values);
      }
      const double share = static_cast<double>(held) / samples;
      EXPECT_GE(share, 0.90) << scatter.name << ", " << count;
      EXPECT_LE(share, 0.98) << scatter.name << ", " << count;
    }
}

// The promise is 95 %; what is allowed is 90 to 98 %, since blocks scatter neither normally nor lognormally for
// certain. With 4,000 samples the share itself is good to 0.7 % (two standard errors).
TEST(Interval, MeanIntervalsHoldTheMeanInNinetyToNinetyEightOfAHundredCases) {
  expect_coverage(7, [](const Scatter&, const std::vector<double>& values) {
    const Interval interval = mean_interval(values);
    return interval.low <= 1.0 && 1.0 <= interval.high;
  });
}

// The same for what single blocks do: the interval holds nine of ten blocks in 90 to 98 of a hundred cases.
TEST(Interval, BlockIntervalsHoldTheirFractionInNinetyToNinetyEightOfAHundredCases) {
  expect_coverage(11, [](const Scatter& scatter, const std::vector<double>& values) {
    const Interval interval = block_interval(values, 0.9);
    return scatter.below(interval.high) - scatter.below(interval.low) >= 0.9;
  });
}

Evaluation block(double plateau, double peak = 2e5) {
  Evaluation evaluation;
  evaluation.summary.plateau_stress = plateau;
  evaluation.summary.first_peak_stress = peak;
  evaluation.summary.impact_ratio = 0.08;
  evaluation.pack.thinnest_wall = {0.004, 0, 1};
  evaluation.pack.porosity = 0.3;
  return evaluation;
}

Verdict verdict(const Target& target, const std::vector<Evaluation>& blocks, bool fresh = true,
                std::vector<Reach> reach = {}) {
  std::vector<const Evaluation*> pointers;
  for (const Evaluation& one : blocks) pointers.push_back(&one);
  return verdict_on(target, pointers, fresh, reach);
}

Target wish(double stress, double tolerance = 0.2) {
  Target target;
  target.plateau_stress = stress;
  target.tolerance = tolerance;
  return target;
}

std::vector<double>& limit(Target& target, const char* key) {
  return target.limits[static_cast<std::size_t>(measure_called(key) - measures().data())];
}

// 0.98 to 1.02 of the target: deviation 1.6 %, half width 2 %: within 20 %.
const std::vector<Evaluation> steady{block(0.98e5), block(0.99e5), block(1e5), block(1.01e5), block(1.02e5)};

TEST(Verdict, MetNeedsTheWholeIntervalWithin) {
  const Verdict found = verdict(wish(1e5), steady);
  EXPECT_EQ(found.outcome, Outcome::met);
  EXPECT_TRUE(found.text.starts_with("met: the wish, for the mean of blocks with 95 % confidence (5 seeds)"))
      << found.text;
  // The same mean within 1 %: the interval of 2 % is wider.
  EXPECT_EQ(verdict(wish(1e5, 0.01), steady).outcome, Outcome::not_shown);
  // Half the target: all of the interval is below.
  const Verdict low = verdict(wish(2e5), steady);
  EXPECT_EQ(low.outcome, Outcome::missed);
  EXPECT_NE(low.text.find("plateau stress 100 kPa (95 %: 98.04 to 102 kPa), wished 160 to 240 kPa: 37.5 % too low"),
            std::string::npos)
      << low.text;
}

TEST(Verdict, OneOrTwoSeedsShowNothing) {
  for (const std::size_t count : {1u, 2u}) {
    const std::vector<Evaluation> few(steady.begin(), steady.begin() + static_cast<std::ptrdiff_t>(count));
    EXPECT_EQ(verdict(wish(1e5), few).outcome, Outcome::not_shown);
    EXPECT_EQ(verdict(wish(5e5), few).outcome, Outcome::not_shown);
  }
  // What the packing has is known from one.
  Target wall = wish(1e5);
  limit(wall, "thinnest_wall") = {0.005};
  EXPECT_EQ(verdict(wall, {block(1e5)}).outcome, Outcome::missed);
}

TEST(Verdict, OneMissedWishMissesTheTarget) {
  Target target = wish(1e5);
  limit(target, "first_peak_stress") = {1.5e5};
  std::vector<Evaluation> blocks = steady;
  for (std::size_t k = 0; k < blocks.size(); ++k)
    blocks[k].summary.first_peak_stress = 3e5 + 1e3 * static_cast<double>(k);
  const Verdict found = verdict(target, blocks);
  EXPECT_EQ(found.outcome, Outcome::missed);
  EXPECT_EQ(found.wishes[0].outcome, Outcome::met);
  EXPECT_EQ(found.wishes[1].outcome, Outcome::missed);
  EXPECT_NE(found.text.find("first peak stress 302 kPa"), std::string::npos) << found.text;
  EXPECT_NE(found.text.find("at most 150 kPa: a factor of 2.013 too high"), std::string::npos) << found.text;
  EXPECT_EQ(found.text.find("plateau stress"), std::string::npos)
      << "a wish that is met does not decide: " << found.text;
}

TEST(Verdict, SingleBlocksAskForMore) {
  // 15 % scatter: the mean of eight lies within 20 %, nine of ten blocks do not (Howe's factor is 3.1).
  std::vector<Evaluation> blocks;
  for (const double factor : {0.8, 0.87, 0.93, 0.98, 1.02, 1.07, 1.13, 1.2}) blocks.push_back(block(factor * 1e5));
  Target target = wish(1e5);
  EXPECT_EQ(verdict(target, blocks).outcome, Outcome::met);
  target.statement = Statement::block;
  EXPECT_EQ(verdict(target, blocks).outcome, Outcome::not_shown);
  target.tolerance = 0.6;
  const Verdict wide = verdict(target, blocks);
  EXPECT_EQ(wide.outcome, Outcome::met);
  EXPECT_NE(wide.text.find("the wish, for 90 % of single blocks"), std::string::npos) << wide.text;
  limit(target, "undulation") = {0.5};  // shown wish by wish: of blocks that keep both nothing is said
  for (Evaluation& one : blocks) one.summary.undulation = 0.1;
  const Verdict both = verdict(target, blocks);
  EXPECT_NE(both.text.find("all 2 wishes, each for 90 % of single blocks"), std::string::npos) << both.text;
}

TEST(Verdict, ABlockThatFailedOrSeedsOfTheSearchLeaveNothingMet) {
  std::vector<Evaluation> blocks = steady;
  blocks[2].status = RunStatus::failed;
  const Verdict failed = verdict(wish(1e5), blocks);
  EXPECT_EQ(failed.outcome, Outcome::not_shown);
  EXPECT_EQ(failed.failed, 1);
  const Verdict search = verdict(wish(1e5), steady, false);
  EXPECT_EQ(search.outcome, Outcome::not_shown);
  EXPECT_NE(search.text.find("flatter"), std::string::npos) << search.text;
}

TEST(Verdict, WithoutAPlateauInMostBlocksItIsMissedInSomeNotShown) {
  std::vector<Evaluation> blocks = steady;
  blocks[0].summary.plateau_stress = not_reached;
  EXPECT_EQ(verdict(wish(1e5), blocks).outcome, Outcome::not_shown);
  for (std::size_t k = 0; k < 3; ++k) blocks[k].summary.plateau_stress = not_reached;
  EXPECT_EQ(verdict(wish(1e5), blocks).outcome, Outcome::missed);
}

// A plateau that did not end within the run is at least as long as the run.
TEST(Verdict, AnEndThatWasNotReachedIsABound) {
  Target target = wish(1e5);
  limit(target, "densification_strain") = {0.45};
  std::vector<Evaluation> blocks = steady;
  for (Evaluation& one : blocks) one.summary.final_strain = 0.5;
  EXPECT_EQ(verdict(target, blocks).outcome, Outcome::met);
  for (Evaluation& one : blocks) one.summary.final_strain = 0.41;
  EXPECT_EQ(verdict(target, blocks).outcome, Outcome::missed);
}

TEST(Verdict, OutOfReachIsSaidWhereEveryCandidateFellShort) {
  const Measure* plateau = measure_called("plateau_stress");
  const Verdict found = verdict(wish(1.5e6), steady, true, {{plateau, 12, 2e4, 3.7e5}});
  EXPECT_EQ(found.outcome, Outcome::out_of_reach);
  EXPECT_NE(found.text.find("the 12 designs tried gave 20 to 370 kPa"), std::string::npos) << found.text;
  EXPECT_EQ(verdict(wish(1.5e6), steady, true, {{plateau, 12, 2e4, 1.4e6}}).outcome, Outcome::missed);
  // Of one design, or a few, nothing is known to be out of reach.
  EXPECT_EQ(verdict(wish(1.5e6), steady, true, {{plateau, fewest_tried - 1, 2e4, 3.7e5}}).outcome, Outcome::missed);
}

TEST(Verdict, SaysWhatTheRateLifts) {
  EXPECT_TRUE(verdict(wish(1e5), steady).note.starts_with("impact stress is 8 % of the plateau"));
  std::vector<Evaluation> fast = steady;
  for (Evaluation& one : fast) one.summary.impact_ratio = 0.2;
  EXPECT_TRUE(verdict(wish(1e5), fast).note.starts_with("loaded fast"));
  EXPECT_TRUE(
      verdict(wish(1e5), fast).text.starts_with("met at this rate (impact stress is 20 % of the plateau): the wish"))
      << verdict(wish(1e5), fast).text;
  const nlohmann::json record = to_json(verdict(wish(1e5), fast));
  EXPECT_EQ(record.at("outcome"), "met");
  EXPECT_EQ(record.at("wishes").size(), 1u);
  EXPECT_NEAR(record.at("impact_ratio").get<double>(), 0.2, 1e-12);
}

}  // namespace
}  // namespace perfora::results
