// What is here: evaluations of the public face held against optimize::evaluate_design() bit by bit; progress, stops,
// run files. What is not: whether the numbers are right (tests/solver, tests/verification).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "optimize/evaluate/evaluation.h"
#include "perfora/evaluate.h"
#include "results/measure_table.h"
#include "tests/perfora/face_support.h"

namespace perfora {
namespace {

using ::testing::HasSubstr;

TEST(PublicEvaluation, IsThatOfTheRoomsToTheLastBit) {
  const Evaluation found = evaluate(small_block());
  const auto file = optimize::DesignFile::from_toml(optimize::small_design, "design");
  const results::Evaluation wanted = optimize::evaluate_design(file, {}, 0);
  EXPECT_EQ(found.status, Status::completed);
  EXPECT_EQ(found.reason, wanted.reason);
  EXPECT_EQ(std::vector<double>(found.strain().begin(), found.strain().end()), wanted.curve.strain_yy);
  EXPECT_EQ(std::vector<double>(found.stress().begin(), found.stress().end()), wanted.curve.stress_yy);
  EXPECT_EQ(found.curve.columns.size(), wanted.curve.filled_columns());
  for (const results::Measure& measure : results::measures()) {
    const double value = results::value_of(measure, wanted), mine = found.measure(measure.key);
    EXPECT_TRUE(mine == value || (std::isnan(mine) && std::isnan(value))) << measure.key;
  }
  const auto record = nlohmann::json::parse(found.to_json());
  EXPECT_EQ(record.at("schema"), "perfora.evaluate/1");
  EXPECT_EQ(record.at("plateau_stress"), wanted.summary.plateau_stress);
  for (const Measure& measure : found.measures)
    if (measure.key == "plateau_stress") {
      EXPECT_EQ(measure.unit, "Pa");
      EXPECT_EQ(measure.dimension, "stress");
      EXPECT_EQ(measure.label, "plateau stress");
    }
}

// docs/user/theory.md, "Score": a wish that is not kept costs (ln floor)^2 + (ln(mean/bound))^2, floor 0.05; one that
// is kept nothing.
TEST(PublicEvaluation, ScoreIsThatOfTheTheory) {
  const Evaluation found = evaluate(small_block());
  Design wish = small_block();
  wish.set("target.weight.cap_ratio", 0.0);
  EXPECT_THAT(error_of([&] { static_cast<void>(score(Design(), {found})); }), HasSubstr("nothing is wished"));
  const double cap_ratio = found.measure("cap_ratio");
  ASSERT_GE(cap_ratio, 1.0);
  wish.set("target.limit.cap_ratio", fmt::format("{}", 0.5 * cap_ratio));
  const double step = std::log(0.05), distance = std::log(2.0);
  EXPECT_NEAR(score(wish, {found}), step * step + distance * distance, 1e-12);
  EXPECT_NEAR(score(wish, {found, found}), step * step + distance * distance, 1e-12);
  wish.set("target.limit.cap_ratio", fmt::format("{}", 2.0 * cap_ratio));
  EXPECT_EQ(score(wish, {found}), 0.0);
  EXPECT_THAT(error_of([&] { static_cast<void>(score(wish, {})); }), HasSubstr("there is no evaluation"));
}

// One run answers another window: its curve is measured anew.
TEST(PublicEvaluation, ScoreMeasuresTheCurveForItsOwnWindow) {
  const Evaluation found = evaluate(small_block());
  Design other = small_block();
  other.set("target.weight.cap_ratio", 0.0).set("target.tolerance", 0.9);
  other.set("measures.plateau_start", 0.004).set("measures.plateau_end", 0.006);
  const Evaluation again = evaluate(other);
  ASSERT_NE(again.measure("plateau_stress"), found.measure("plateau_stress"));
  other.set("target.plateau_stress", again.measure("plateau_stress"));
  const double distance = evaluate(other).measure("target_distance");
  ASSERT_GT(distance, 0.0);
  EXPECT_NEAR(score(other, {found}), distance * distance, 1e-12);  // rounding of a sum over some ten bins
}

TEST(PublicEvaluation, MoreMemoryThanAllowedIsRefusedBeforeAnythingIsWritten) {
  const DesignFolder folder;
  EvaluateOptions options;
  options.run_file = folder / "run.h5";
  options.memory = 1e6;  // bytes; less than the program itself
  EXPECT_THAT(error_of([&] { static_cast<void>(evaluate(small_block(), options)); }),
              HasSubstr("of memory, and 1 MB are allowed"));
  EXPECT_FALSE(std::filesystem::exists(options.run_file));
}

TEST(PublicEvaluation, ProgressTellsStrainAndStress) {
  std::vector<Progress> heard;
  EvaluateOptions options;
  options.progress = [&](const Progress& progress) {
    heard.push_back(progress);
    return true;
  };
  const Evaluation found = evaluate(small_block(), options);
  ASSERT_FALSE(heard.empty());
  EXPECT_EQ(heard.back().fraction, 1.0);
  // The mean over the last 0.05 % of strain lies between the means around its two ends, as the stress still rises.
  const auto stress = found.stress();
  EXPECT_GT(heard.back().stress, stress[stress.size() - 2]);
  EXPECT_LT(heard.back().stress, stress.back());
  EXPECT_NEAR(heard.back().strain, 0.01, 1e-6);  // small_design: until = 0.01
  EXPECT_EQ(heard.back().seconds_left, 0.0);
}

TEST(PublicEvaluation, CallbackStopsARunThatThenGoesOn) {
  const DesignFolder folder;
  const Evaluation straight = evaluate(small_block());
  EvaluateOptions options;
  options.run_file = folder / "r.h5";
  options.progress = [](const Progress& progress) { return !(progress.strain >= 0.004); };
  const Evaluation stopped = evaluate(small_block(), options);
  EXPECT_EQ(stopped.status, Status::stopped);
  EXPECT_LT(stopped.measure("final_strain"), 0.006);
  options.progress = {};
  EXPECT_NE(error_of([&] { static_cast<void>(evaluate(small_block(), options)); }), "");  // it would start over
  options.resume = true;
  const Evaluation resumed = evaluate(small_block(), options);
  EXPECT_EQ(resumed.status, Status::completed);
  EXPECT_EQ(resumed.curve.columns.back().values, straight.curve.columns.back().values);
  EXPECT_EQ(std::vector<double>(resumed.stress().begin(), resumed.stress().end()),
            std::vector<double>(straight.stress().begin(), straight.stress().end()));
}

TEST(PublicEvaluation, ExceptionOfTheCallbackStopsTheRunAndComesOut) {
  int calls = 0;
  EvaluateOptions options;
  options.progress = [&](const Progress& progress) -> bool {
    if (std::isnan(progress.strain)) return true;  // packing
    ++calls;
    throw std::domain_error("enough");
  };
  EXPECT_THROW(static_cast<void>(evaluate(small_block(), options)), std::domain_error);
  EXPECT_EQ(calls, 1);
}

TEST(PublicEvaluation, RunFileGivesTheSameBack) {
  const DesignFolder folder;
  EvaluateOptions options;
  options.run_file = folder / "r.h5";
  const Evaluation made = evaluate(small_block(), options);
  const auto run = read_run(options.run_file);
  ASSERT_EQ(run.evaluation.curve.columns.size(), made.curve.columns.size());
  for (std::size_t k = 0; k < made.curve.columns.size(); ++k) {
    EXPECT_EQ(run.evaluation.curve.columns[k].name, made.curve.columns[k].name);
    EXPECT_EQ(run.evaluation.curve.columns[k].values, made.curve.columns[k].values);
  }
  for (const Measure& measure : made.measures) {
    const double value = run.evaluation.measure(measure.key);
    EXPECT_TRUE(value == measure.value || (std::isnan(value) && !std::isfinite(measure.value))) << measure.key;
  }
  EXPECT_EQ(run.evaluation.to_json(), made.to_json());
  EXPECT_EQ(Design::from_toml(run.design).to_toml(), small_block().to_toml());
  EXPECT_FALSE(run.frame_strains.empty());
  EXPECT_EQ(kind_of(options.run_file), "run");
  options.resume = true;
  EXPECT_EQ(evaluate(small_block(), options).to_json(), made.to_json());  // read, not run
}

TEST(PublicEvaluation, WishesHaveAVerdict) {
  Design wishing = small_block();
  wishing.set("target.plateau_stress", "1 MPa").set("target.window", "[0.002, 0.008]");
  const Evaluation found = evaluate(wishing);
  EXPECT_FALSE(found.verdict.outcome.empty());
  EXPECT_THAT(found.verdict.text, HasSubstr("plateau stress"));
  EXPECT_TRUE(evaluate(small_block()).verdict.outcome.empty());
}

TEST(PublicEvaluation, GoesThroughJsonWithItsCurve) {
  const Evaluation made = evaluate(small_block());
  const Evaluation back = Evaluation::from_json(made.to_json(true));
  EXPECT_EQ(back.to_json(true), made.to_json(true));
  EXPECT_EQ(back.curve.columns.back().values, made.curve.columns.back().values);
  EXPECT_NE(error_of([] { static_cast<void>(Evaluation::from_json("{}")); }), "");
  EXPECT_NE(error_of([] { static_cast<void>(Evaluation().to_json(true)); }), "");
}

TEST(PublicEvaluation, WrongInputIsAnError) {
  Design overlapping = small_block();
  overlapping.set("layout.diameter", "14 mm");
  EXPECT_NE(error_of([&] { static_cast<void>(evaluate(overlapping)); }), "");
  EvaluateOptions both;
  both.resume = both.force = true;
  EXPECT_THAT(error_of([&] { static_cast<void>(evaluate(small_block(), both)); }), HasSubstr("exclude each other"));
  EXPECT_NE(error_of([&] { static_cast<void>(read_run("/nowhere/r.h5")); }), "");
}

}  // namespace
}  // namespace perfora
