// What is here: an evaluation measured anew for another window and a smaller strain against the run that was made with
// them. What is not: the measures themselves (tests/results/test_measures.cpp).
#include <gtest/gtest.h>

#include "optimize/evaluate/answers.h"
#include "results/history_file.h"
#include "results/json.h"
#include "results/measured_anew.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

constexpr double long_end = 0.1, short_end = 0.08;

class MeasuredAnew : public ::testing::Test {
 protected:
  DesignFile design(double until, double start, double end) const {
    return DesignFile(folder_.file("design.toml", small_design),
                      {"loading.until=" + std::to_string(until), "measures.plateau_start=" + std::to_string(start),
                       "measures.plateau_end=" + std::to_string(end)});
  }
  Request request(double until, double start, double end) const { return make_request(design(until, start, end), 0); }
  DesignFolder folder_;
};

results::MeasuringFrame frame(double start, double end) {
  results::MeasuringFrame frame;
  frame.options.plateau_start = start;
  frame.options.plateau_end = end;
  frame.reference_area = 0.012 * 0.012;
  return frame;
}

/// All that two runs of one path must share: performance is of the machine.
nlohmann::json comparable(const Evaluation& evaluation) {
  nlohmann::json record = to_json(evaluation, true);
  record.erase("performance");
  return record;
}

// Nothing numerical is expected: the run with that window and end is the measure.
TEST_F(MeasuredAnew, AnotherWindowAndASmallerStrainGiveTheBitsOfTheirOwnRun) {
  const Evaluation longer = evaluate_design(design(long_end, 0.01, 0.03), {}, 0);
  const Evaluation window = evaluate_design(design(long_end, 0.005, 0.02), {}, 0);
  const Evaluation shorter = evaluate_design(design(short_end, 0.005, 0.02), {}, 0);
  ASSERT_EQ(shorter.curve.peak_passed.back(), 1.0) << "the first peak must be known where the shorter run ends";
  ASSERT_NE(longer.summary.plateau_stress, window.summary.plateau_stress);
  const auto anew = results::measured_anew(longer, frame(0.005, 0.02), long_end);
  ASSERT_TRUE(anew.has_value());
  EXPECT_EQ(comparable(*anew), comparable(window));
  const auto cut = results::measured_anew(longer, frame(0.005, 0.02), short_end);
  ASSERT_TRUE(cut.has_value());
  Evaluation without_lateral = *cut;  // the last means of lateral stresses reach beyond the end
  for (auto column : {&results::History::stress_xx, &results::History::stress_xy, &results::History::stress_asymmetry})
    (without_lateral.curve.*column).back() = (shorter.curve.*column).back();
  EXPECT_EQ(comparable(without_lateral), comparable(shorter));
}

TEST_F(MeasuredAnew, NothingIsMadeUp) {
  const Evaluation made = evaluate_design(design(long_end, 0.01, 0.03), {}, 0);
  EXPECT_FALSE(results::measured_anew(made, frame(0.01, 0.03), 0.12)) << "it ended before";
  EXPECT_FALSE(results::measured_anew(made, frame(0.002, 0.004), 0.004)) << "the first peak is not known there";
  Evaluation without_ends = made;
  without_ends.curve.stress_before.clear();
  EXPECT_FALSE(results::measured_anew(without_ends, frame(0.01, 0.02), short_end)) << "of an older program";
  EXPECT_TRUE(results::measured_anew(without_ends, frame(0.01, 0.02), long_end));
  Evaluation thinned = made;
  thinned.curve = results::coarse_curve(made.curve);
  EXPECT_FALSE(results::measured_anew(thinned, frame(0.01, 0.02), long_end)) << "a curve for pictures";
  Evaluation failed = made;
  failed.status = results::RunStatus::failed;
  EXPECT_FALSE(results::measured_anew(failed, frame(0.01, 0.02), long_end));
}

TEST_F(MeasuredAnew, AHistoryComesBackFromItsFileAndAnswersFromThere) {
  const Request first = request(long_end, 0.01, 0.03), other = request(short_end, 0.005, 0.02);
  ASSERT_EQ(first.key(), other.key());
  const Evaluation made = evaluate_request(first, 1);
  results::write_history_file(folder_ / "h.h5", made.curve, made.grade);
  const results::History read = results::read_history_file(folder_ / "h.h5").history;
  for (const results::History::Column& column : results::History::columns())
    EXPECT_EQ(read.*column.values, made.curve.*column.values) << column.name;
  Answers answers;
  Evaluation stored = made;
  stored.curve = results::coarse_curve(made.curve);
  answers.add(first.key(), stored);
  EXPECT_EQ(answer_for(other, other.key(), answers), nullptr) << "no history is kept";
  int reads = 0;
  answers.set_histories([&](const std::string&) {
    ++reads;
    return results::read_history_file(folder_ / "h.h5");
  });
  const Evaluation* answer = answer_for(other, other.key(), answers);
  ASSERT_NE(answer, nullptr);
  Evaluation expected = evaluate_request(other, 1);
  expected.curve = results::coarse_curve(expected.curve);
  EXPECT_EQ(comparable(*answer), comparable(expected));
  EXPECT_EQ(answer_for(other, other.key(), answers), answer);
  EXPECT_EQ(reads, 1) << "what was measured anew is remembered";
}

}  // namespace
}  // namespace perfora::optimize
