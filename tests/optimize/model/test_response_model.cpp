// What is here: a model of synthetic designs whose response is known. What is not: processes
// (test_gaussian_process.cpp).
#include "optimize/model/response_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "optimize/model/target_answers.h"
#include "optimize/search/objective.h"
#include "tests/optimize/model/synthetic_designs.h"

namespace perfora::model {
namespace {

class ResponseModelTest : public testing::Test {
 protected:
  const results::Target target = synthetic_target();
  const results::MeasuringFrame frame = synthetic_frame(target);
  const SyntheticDesigns designs{40, 3, 0.05};
  const ResponseModel model{designs.known, target, frame, lbfgs};
  const Scorer scorer = [this](std::span<const results::Evaluation* const> blocks) {
    return optimize::score_of(target, blocks).value;
  };
  const TargetAnswers answers{target, model, scorer};

  Inputs at(double x, double y) const { return model.inputs_of(SyntheticDesigns::traits(x, y)); }
  Answer asked(double x, double y, std::optional<double> best = std::nullopt) const {
    return answers.at(model, at(x, y), {}, best);
  }
  /// Of a design without scatter.
  double true_score(double x, double y) const {
    const results::Evaluation run = evaluation_of(level_of(x, y), peak_ratio_of(y), frame);
    const results::Evaluation* one = &run;
    return optimize::score_of(target, {&one, 1}).value;
  }
};

TEST_F(ResponseModelTest, KnowsTheCurveOfADesignThatItHasNotSeen) {
  ASSERT_TRUE(model.made());
  for (const double x : {0.2, 0.5, 0.8}) {
    const ResponseModel::Curve curve = model.curve(at(x, 0.4));
    const std::size_t middle = curve.strain.size() / 2;  // on the plateau
    const double wanted = wished_stress * std::exp(level_of(x, 0.4));
    EXPECT_NEAR(curve.stress[middle] / wanted, 1.0, 0.08) << x;
    EXPECT_LT(curve.low[middle], wanted) << x;
    EXPECT_GT(curve.high[middle], wanted) << x;
  }
}

TEST_F(ResponseModelTest, FindsTheScatterOfBlocks) {
  // ln(stress) of all bins moves together by 0.05, so the first component by 0.05 sqrt(bins).
  const double found = model.responses().front().scatter(at(0.5, 0.5)) / std::sqrt(model.curves().bins());
  EXPECT_NEAR(found, 0.05, 0.015);
}

TEST_F(ResponseModelTest, CoversLeftOutDesigns) {
  EXPECT_TRUE(model.trusted()) << model.in_words();
  EXPECT_NE(model.in_words().find("leave-one-design-out"), std::string::npos);
}

// A wish costs (ln 0.05)^2 where it is not kept, so the expected score holds that times the probability, and a little
// for the distance from the bound.
TEST_F(ResponseModelTest, WishesCostTheirProbability) {
  results::Target weighed = target;
  weighed.weight_limits = 1.0;
  const TargetAnswers with(weighed, model, [&weighed](std::span<const results::Evaluation* const> blocks) {
    return optimize::score_of(weighed, blocks).value;
  });
  const double step = std::pow(std::log(0.05), 2);
  for (const double x : {0.15, 0.45, 0.75})
    for (const double y : {0.35, 0.65, 0.9}) {
      const Answer one = with.at(model, at(x, y), {});
      double expected = 0.0;
      for (const double probability : one.each_wish) expected += step * (1.0 - probability);
      EXPECT_NEAR(one.score - asked(x, y).score, expected, 0.5 + 0.1 * expected) << x << " " << y;
    }
}

// The expected score of noisy blocks lies a little above that of the formula: by the square of their scatter.
TEST_F(ResponseModelTest, ExpectsTheScoreThatTheFormulaGives) {
  for (const double x : {0.15, 0.45, 0.75})
    for (const double y : {0.35, 0.65, 0.9})
      EXPECT_NEAR(asked(x, y).score, true_score(x, y) + 0.05 * 0.05, 0.03) << x << " " << y;
}

// A plateau at the wish with a cap ratio of 2.1 is sure; a level of exp(-0.54) or a cap ratio of 4.2 is out of reach.
TEST_F(ResponseModelTest, KnowsWhichWishesHold) {
  const double y = 0.8, x = std::asin(0.6 * y / 0.8) / 2.5;
  EXPECT_GT(asked(x, y).wishes, 0.95);
  EXPECT_LT(asked(0.02, 0.9).wishes, 0.05);
  const Answer capped = asked(std::asin(0.6 * 0.1 / 0.8) / 2.5, 0.1);
  ASSERT_EQ(capped.each_wish.size(), 2U);
  EXPECT_GT(capped.each_wish[0], 0.9);
  EXPECT_LT(capped.each_wish[1], 0.05);
  EXPECT_LT(capped.wishes, 0.05);
}

TEST_F(ResponseModelTest, ImprovementIsTheExpectedGain) {
  const Answer good = asked(0.24, 0.8, 0.5);
  EXPECT_NEAR(good.improvement, good.success * (0.5 - good.score), 1e-9) << "every draw lies below";
  EXPECT_LT(asked(0.9, 0.05, 0.05).improvement, 1e-3);
  const Answer before = asked(0.6, 0.6, 0.0);
  EXPECT_EQ(before.improvement, 0.0) << "no score is below 0";
}

TEST_F(ResponseModelTest, ToldWhatItExpectsItIsSurerThereAlone) {
  const Inputs place = at(0.6, 0.6);
  const ResponseModel told = model.told(place);
  const GaussianProcess &before = model.responses()[0].process, &after = told.responses()[0].process;
  EXPECT_LT(after.at(place).variance, before.at(place).variance);
  EXPECT_NEAR(after.at(place).mean, before.at(place).mean, 1e-6);
}

TEST(ResponseModel, OfFewDesignsIsNotMade) {
  const SyntheticDesigns few(5, 2, 0.05);
  const ResponseModel model(few.known, synthetic_target(), synthetic_frame(synthetic_target()), lbfgs);
  EXPECT_FALSE(model.made());
  EXPECT_EQ(model.in_words(), "5 designs are too few for a model, which needs 8 with a curve");
}

// Runs that fail where x is above 0.7 are facts about success, not scores: the response of the others is as good.
TEST(ResponseModel, FailedRunsTellWhereDesignsFail) {
  SyntheticDesigns designs(40, 2, 0.05);
  results::Evaluation failed;
  failed.status = results::RunStatus::failed;
  for (KnownDesign& design : designs.known)
    if (design.traits.values[0] > 0.7) design.replicates = {&failed, &failed};
  const ResponseModel model(designs.known, synthetic_target(), synthetic_frame(synthetic_target()), lbfgs);
  ASSERT_TRUE(model.made());
  const auto at = [&](double x) { return model.inputs_of(SyntheticDesigns::traits(x, 0.5)); };
  EXPECT_GT(model.success(at(0.3)), 0.9);
  EXPECT_LT(model.success(at(0.95)), 0.2);
}

// A block that keeps a third of its first peak fails by a front, one that keeps a fiftieth throughout. Which is which
// depends on x alone.
TEST(ResponseModel, TellsFrontsFromCracksThroughout) {
  SyntheticDesigns designs(40, 2, 0.05);
  int fronts = 0;
  for (KnownDesign& design : designs.known) {
    const bool front = design.traits.values[0] < 0.5;
    fronts += front;
    for (results::Evaluation& run : designs.runs)
      if (std::find(design.replicates.begin(), design.replicates.end(), &run) != design.replicates.end())
        run.summary.stress_drop_ratio = front ? 1.0 / 3.0 : 0.02;
  }
  ASSERT_EQ(fronts, 20) << "half of the points of a Sobol sequence";
  const ResponseModel model(designs.known, synthetic_target(), synthetic_frame(synthetic_target()), lbfgs);
  ASSERT_TRUE(model.made());
  const auto front_at = [&](double x, double y) {
    return model.front(model.inputs_of(SyntheticDesigns::traits(x, y)));
  };
  for (const double y : {0.2, 0.5, 0.8}) {
    ASSERT_TRUE(front_at(0.2, y));
    EXPECT_GT(*front_at(0.2, y), 0.85) << y;
    EXPECT_LT(*front_at(0.8, y), 0.15) << y;
    EXPECT_NEAR(*front_at(0.5, y), 0.5, 0.35) << y;
  }
  // The class is an input of every response.
  const Inputs one = model.inputs_of(SyntheticDesigns::traits(0.2, 0.5));
  EXPECT_EQ(one.points(0, one.points.cols() - 1), *model.front(one));
  // Of one class alone, or nearly so, nothing is told apart.
  for (results::Evaluation& run : designs.runs) run.summary.stress_drop_ratio = 0.5;
  const ResponseModel alike(designs.known, synthetic_target(), synthetic_frame(synthetic_target()), lbfgs);
  EXPECT_FALSE(alike.front(alike.inputs_of(SyntheticDesigns::traits(0.2, 0.5))));
}

// Coverage of 95 % that is really less, more by chance, and really more.
TEST(Coverage, IsTrustedFrom85To98Percent) {
  EXPECT_FALSE((Coverage{84, 100}).trusted());
  EXPECT_TRUE((Coverage{85, 100}).trusted());
  EXPECT_TRUE((Coverage{98, 100}).trusted());
  EXPECT_TRUE((Coverage{40, 40}).trusted()) << "0.98^40 = 0.45: by chance";
  EXPECT_FALSE((Coverage{200, 200}).trusted()) << "0.98^200 = 0.018";
  EXPECT_FALSE((Coverage{0, 0}).trusted());
}

}  // namespace
}  // namespace perfora::model
