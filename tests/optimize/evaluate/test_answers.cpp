// What is here: which evaluation answers which request. Nothing numerical is expected.
// What is not: keys (test_request.cpp).
#include <gtest/gtest.h>

#include "optimize/evaluate/answers.h"

namespace perfora::optimize {
namespace {

DesignFile design(double start, double end) {
  DesignFile design;
  design.design().measures.plateau_start = start;
  design.design().measures.plateau_end = end;
  return design;
}

/// A run to 40 % strain whose plateau was measured from 20 to 35 %.
Evaluation evaluation(double strain = 0.4, double start = 0.2, double end = 0.35) {
  Evaluation made;
  made.summary.final_strain = strain;
  made.summary.plateau_start = start;
  made.summary.plateau_end = end;
  made.summary.measured = design(start, end).design().measuring_frame().text();
  return made;
}

Request request(double strain = 0.4, double start = 0.2, double end = 0.35) {
  return make_request(design(start, end), 0, strain);
}

TEST(Answers, StrainAndWindowMustBeThoseAskedFor) {
  EXPECT_TRUE(is_answer(evaluation(), request()));
  EXPECT_FALSE(is_answer(evaluation(0.3), request())) << "it stopped before";
  EXPECT_FALSE(is_answer(evaluation(), request(0.3)));
  EXPECT_FALSE(is_answer(evaluation(), request(0.4, 0.1)));
  EXPECT_FALSE(is_answer(evaluation(), request(0.4, 0.2, 0.3)));
}

TEST(Answers, TheEndIsThatAskedForUpToRounding) {
  EXPECT_TRUE(is_answer(evaluation(0.4 - 1e-12), request(0.4)));
  EXPECT_FALSE(is_answer(evaluation(0.4), request(0.39999)));
}

TEST(Answers, AFailedRunAnswersWhateverGoesAsFar) {
  Evaluation failed = evaluation(0.25);
  failed.status = results::RunStatus::failed;
  EXPECT_TRUE(is_answer(failed, request(0.4, 0.1)));
  EXPECT_TRUE(is_answer(failed, request(0.25)));
  EXPECT_FALSE(is_answer(failed, request(0.2)));
  EXPECT_TRUE(is_answer(failed_evaluation("no packing", 0), request(0.001)));
}

TEST(Answers, AKeyKeepsOneEvaluationAStrainAndWindow) {
  Answers answers;
  answers.add("a", evaluation(0.3));
  answers.add("a", evaluation(0.4));
  answers.add("b", evaluation(0.4, 0.1));
  EXPECT_EQ(answers.size(), 3u);
  EXPECT_EQ(answer_for(request(0.5), "a", answers), nullptr);
  EXPECT_EQ(answer_for(request(0.4), "b", answers), nullptr);
  const Evaluation* far = answer_for(request(0.4), "a", answers);
  ASSERT_NE(far, nullptr);
  EXPECT_EQ(far->summary.final_strain, 0.4);
  Evaluation again = evaluation(0.3);
  again.reason = "again";
  answers.add("a", again);
  EXPECT_EQ(answers.size(), 3u);
  EXPECT_EQ(answer_for(request(0.3), "a", answers)->reason, "again");
  EXPECT_EQ(answer_for(request(0.4), "a", answers), far) << "others stay where they are";
}

}  // namespace
}  // namespace perfora::optimize
