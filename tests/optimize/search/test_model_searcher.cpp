// What is here: the searchers "model", "random" and "sobol" on studies whose evaluations are formulas. What is not: the
// model itself (tests/optimize/model/), NLopt (test_nlopt_search.cpp).
#include <gmock/gmock.h>

#include <set>

#include "optimize/search/model_record.h"
#include "optimize/search/searcher.h"
#include "optimize/search/study_model.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

using Values = std::vector<std::vector<double>>;

SearchStage stage_of(const Study& study) {
  SearchStage stage;
  stage.algorithm = study.keys.algorithm;
  for (std::size_t k = 0; k < study.arms.size(); ++k)
    stage.tasks.push_back({static_cast<int>(k), study.arms[k].maxeval, study.arms[k].seed, study.arms[k].start});
  return stage;
}

Values values_of(const Trace& trace) {
  Values values;
  for (const Visit& visit : trace.visits) values.push_back(visit.candidate->values);
  return values;
}

class ModelSearcherTest : public testing::Test {
 protected:
  StudyFolder folder;

  Study study(const std::string& algorithm, int maxeval, const std::string& arms = "",
              const std::string& constraints = "") const {
    return read_study(folder.file(
        "study.toml",
        study_text("final_replicates = 0\nmaxeval = " + std::to_string(maxeval) + "\nalgorithm = \"" + algorithm + "\"",
                   arms, constraints)));
  }

  /// 24 Sobol points, asked for but not answered, in one trace.
  std::vector<Trace> sobol_map(CandidateBook& book, const Answers& known) const {
    const Study map = study("sobol", 24);
    return map.searcher->ask(stage_of(map), CandidateStore(map, book, known));
  }

  /// Asks and answers until the stage has ended; what was asked for the first time goes to `asked`, call by call.
  static std::vector<Trace> carried_out(const Study& study, CandidateBook& book, Answers& answers, SearchStage stage) {
    std::vector<Trace> traces;
    for (bool finished = false; !finished;) {
      const CandidateStore store(study, book, answers);
      traces = study.searcher->ask(stage, store);
      finished = true;
      // As a driver does: what was asked is given back.
      for (std::size_t k = 0; k < traces.size(); ++k) {
        finished = finished && traces[k].finished;
        stage.tasks[k].batches.clear();
        std::size_t next = 0;
        for (const int size : traces[k].batches) {
          Points& points = stage.tasks[k].batches.emplace_back();
          for (int j = 0; j < size; ++j)
            points.push_back(on_grid(study.point_of(traces[k].visits[next++].candidate->values)));
        }
      }
      for (const Trace& trace : traces)
        for (const Visit& visit : trace.visits)
          if (!visit.answered) answers.add(book.key(*visit.candidate, 0), fake_evaluation(visit.candidate->request(0)));
    }
    return traces;
  }

  static double best_of(const std::vector<Trace>& traces) {
    double best = largest_score;
    for (const Trace& trace : traces)
      for (const Visit& visit : trace.visits) best = std::min(best, visit.score);
    return best;
  }
};

TEST_F(ModelSearcherTest, SamplesAreDifferentKeepTheWallsAndLieOnTheGrid) {
  for (const std::string algorithm : {"random", "sobol"}) {
    const Study one = study(algorithm, 20, "rows = [2, 3]", "thinnest_wall = \"7 mm\"");
    CandidateBook book(one);
    Answers none;
    const CandidateStore store(one, book, none);
    const std::vector<Trace> traces = one.searcher->ask(stage_of(one), store),
                             again = one.searcher->ask(stage_of(one), store);
    ASSERT_EQ(traces.size(), 2U) << algorithm;
    const Values values = values_of(traces[0]);
    EXPECT_EQ(values.size(), 10U) << algorithm;
    EXPECT_EQ(values, values_of(again[0])) << algorithm;
    EXPECT_EQ(std::set<std::vector<double>>(values.begin(), values.end()).size(), values.size());
    for (const Visit& visit : traces[0].visits) {
      EXPECT_GE(visit.candidate->layout.thinnest_wall, 0.007);
      const double x = 4096.0 * one.point_of(visit.candidate->values)[0];
      EXPECT_NEAR(x, std::round(x), 1e-6);
    }
    EXPECT_FALSE(traces[0].finished);
  }
}

TEST_F(ModelSearcherTest, SamplesEndWhereNoPointKeepsTheWalls) {
  const Study one = study("sobol", 5, "", "thinnest_wall = \"12 mm\"");
  CandidateBook book(one);
  Answers none;
  const Trace trace = one.searcher->ask(stage_of(one), CandidateStore(one, book, none)).at(0);
  EXPECT_TRUE(trace.visits.empty());
  EXPECT_TRUE(trace.finished);
  EXPECT_EQ(trace.reason, "few points keep the constraints");
}

// Optimum of fake_evaluation(): diameter 17.5 mm, jitter 0.4 mm, in the arm of two rows; four holes there, six in the
// other arm, which costs 0.6 in the plateau.
TEST_F(ModelSearcherTest, ModelFindsTheOptimum) {
  const Study learning = study("model", 20, "rows = [2, 3]"), sampling = study("sobol", 20, "rows = [2, 3]");
  CandidateBook book(learning), other(sampling);
  Answers known, unrelated;
  const std::vector<Trace> traces = carried_out(learning, book, known, stage_of(learning));
  const std::vector<Trace> sampled = carried_out(sampling, other, unrelated, stage_of(sampling));
  EXPECT_EQ(traces[0].visits.size() + traces[1].visits.size(), 20U);
  EXPECT_EQ(traces[0].reason, "maxeval reached");
  EXPECT_LT(best_of(traces), 0.0091) << "within 10 % of the wished stress, half the tolerance: (ln 1.1)^2";
  EXPECT_LT(best_of(traces), 0.5 * best_of(sampled));
  EXPECT_GT(traces[0].visits.size(), traces[1].visits.size()) << "the arm that holds the optimum gets more";
  const CandidateStore store(learning, book, known);
  std::vector<const Candidate*> visited;
  for (const Trace& trace : traces)
    for (const Visit& visit : trace.visits) visited.push_back(visit.candidate);
  StudyModel model(store, visited, 1);
  EXPECT_NE(model.in_words().find("leave-one-design-out"), std::string::npos);
  const Candidate& recommended = *model.ranked().front().candidate;
  EXPECT_EQ(recommended.arm, 0);
  EXPECT_NEAR(recommended.values[0], best_diameter, 0.0006);
}

// The best design lies in the corner of the bounds, so that soon no improvement is expected anywhere.
TEST_F(ModelSearcherTest, AsksForNoCopiesOfTheBestDesign) {
  std::string text = study_text("final_replicates = 0\nmaxeval = 24\nalgorithm = \"model\"");
  text.replace(text.find("14 mm"), 5, "18 mm");
  const Study one = read_study(folder.file("study.toml", text));
  CandidateBook book(one);
  Answers known;
  const std::vector<Trace> traces = carried_out(one, book, known, stage_of(one));
  std::vector<std::vector<double>> points;
  for (const Visit& visit : traces[0].visits) points.push_back(one.point_of(visit.candidate->values));
  ASSERT_GE(points.size(), 16U);
  for (std::size_t k = 0; k < points.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      EXPECT_GE(std::hypot(points[k][0] - points[j][0], points[k][1] - points[j][1]), 0.01 * std::sqrt(2.0) - 1e-9)
          << j << " and " << k << " at " << points[k][0] << ", " << points[k][1];
  EXPECT_LT(best_of(traces), 0.02);
}

// Batches of four over both arms; those that are given are taken, and computed anew they are the same.
TEST_F(ModelSearcherTest, BatchesAreGivenBackOrComputedAnew) {
  const Study one = study("model", 14, "rows = [2, 3]");
  CandidateBook book(one);
  Answers known;
  const std::vector<Trace> traces = carried_out(one, book, known, stage_of(one));
  const CandidateStore store(one, book, known);
  const std::vector<Trace> anew = one.searcher->ask(stage_of(one), store);
  ASSERT_EQ(traces[0].batches.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(traces[0].batches[k] + traces[1].batches[k], k < 3 ? 4 : 2) << k;
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(values_of(anew[k]), values_of(traces[k]));
    EXPECT_EQ(anew[k].batches, traces[k].batches);
    EXPECT_TRUE(anew[k].finished);
  }
}

// A map that is told is learnt from: no Sobol points are asked for, and the first batch lies near the optimum.
TEST_F(ModelSearcherTest, GoesOnFromAMap) {
  const Study one = study("model", 4);
  CandidateBook book(one);
  Answers known;
  CandidateStore store(one, book, known);
  const std::vector<Trace> mapped = sobol_map(book, known);
  for (const Visit& visit : mapped.at(0).visits) {
    known.add(book.key(*visit.candidate, 0), fake_evaluation(visit.candidate->request(0)));
    store.observe(*visit.candidate);
  }
  const Trace trace = one.searcher->ask(stage_of(one), store).at(0);
  ASSERT_EQ(trace.visits.size(), 4U);
  EXPECT_NE(trace.note.find("leave-one-design-out"), std::string::npos) << trace.note;
  double nearest = 1.0;
  for (const Visit& visit : trace.visits)
    nearest = std::min(nearest, fake_distance(visit.candidate->values[0], visit.candidate->values[1]));
  EXPECT_LT(std::sqrt(nearest), 0.1);
  // At the end: what is recommended, and which variable matters. The distance in the plateau grows with either
  // variable's own, so both do.
  const nlohmann::json record = model_json(store, {});
  EXPECT_TRUE(record.at("trusted").get<bool>());
  EXPECT_GT(record.at("recommended").at("success").get<double>(), 0.9);
  for (const char* variable : {"layout.diameter", "layout.jitter"}) {
    const nlohmann::json& index = record.at("importance").at("all").at(variable);
    EXPECT_GT(index.at("total").get<double>(), 0.1) << variable;
    EXPECT_GT(index.at("total").get<double>(), index.at("first").get<double>() - 0.1) << variable;
  }
}

// Of 24 designs four are 20 times as strong as the others, here and there: of a share p of such a normal model sees the
// left-out ones sqrt((1 - p)/p) = 2.2 deviations off, so 20 of 24 (83 %) lie within its 95 %. That is below 85 %: the
// points are those of GN_DIRECT_L, first the middle, then a third of the bounds from it (Jones, Perttunen and Stuckman
// 1993).
TEST_F(ModelSearcherTest, AModelThatIsOftenWrongIsNotUsed) {
  const Study one = study("model", 4);
  CandidateBook book(one);
  Answers known;
  CandidateStore store(one, book, known);
  const std::vector<Trace> mapped = sobol_map(book, known);
  int number = 0;
  for (const Visit& visit : mapped.at(0).visits) {
    const bool strong = number++ % 6 == 0;
    Evaluation evaluation = completed(visit.candidate->request(0));
    evaluation.summary.plateau_stress = strong ? 20.0 * fake_target : fake_target;
    // The distance has a part beside the curve, as that of a rough curve has.
    evaluation.summary.target_distance = strong ? std::log(20.0) + 1.0 : 0.0;
    for (int k = 0; k <= 900; ++k) {
      evaluation.curve.strain_yy.push_back(0.0005 * k);
      evaluation.curve.stress_yy.push_back(evaluation.summary.plateau_stress);
    }
    known.add(book.key(*visit.candidate, 0), evaluation);
    store.observe(*visit.candidate);
  }
  const StudyModel model(store, {}, 1);
  ASSERT_TRUE(model.made());
  EXPECT_FALSE(model.trusted()) << model.in_words();
  const Trace trace = one.searcher->ask(stage_of(one), store).at(0);
  EXPECT_NE(trace.note.find("the model is not used: leave-one-design-out"), std::string::npos) << trace.note;
  EXPECT_NE(trace.note.find("GN_DIRECT_L"), std::string::npos);
  ASSERT_EQ(trace.visits.size(), 4U);
  const auto point = [&](std::size_t k) { return one.point_of(trace.visits[k].candidate->values); };
  constexpr double grid = 1.0 / 4096.0;
  EXPECT_NEAR(point(0)[0], 0.5, grid);
  EXPECT_NEAR(point(0)[1], 0.5, grid);
  for (const std::size_t k : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
    const double along = std::max(std::abs(point(k)[0] - 0.5), std::abs(point(k)[1] - 0.5));
    const double across = std::min(std::abs(point(k)[0] - 0.5), std::abs(point(k)[1] - 0.5));
    EXPECT_NEAR(along, 1.0 / 3.0, grid) << k;
    EXPECT_NEAR(across, 0.0, grid) << k;
  }
}

// The best design stands in a corner, at the smallest of both variables, far above the wish, and the stress rises
// steeply from there: once the corner is known, no point is expected to be better by as much as a tenth of what is not
// known of it.
TEST_F(ModelSearcherTest, ASearchWithNothingToGainEnds) {
  const Study one = study("model", 60);
  CandidateBook book(one);
  Answers known;
  SearchStage stage = stage_of(one);
  std::vector<Trace> traces;
  for (int calls = 0; calls < 20 && (traces.empty() || !traces[0].finished); ++calls) {
    const CandidateStore store(one, book, known);
    traces = one.searcher->ask(stage, store);
    std::size_t next = 0;
    stage.tasks[0].batches.clear();
    for (const int size : traces[0].batches) {
      Points& points = stage.tasks[0].batches.emplace_back();
      for (int j = 0; j < size; ++j)
        points.push_back(on_grid(one.point_of(traces[0].visits[next++].candidate->values)));
    }
    for (const Visit& visit : traces[0].visits) {
      if (visit.answered) continue;
      const std::vector<double> x = one.point_of(visit.candidate->values);
      Evaluation evaluation = fake_evaluation(visit.candidate->request(0));
      evaluation.summary.plateau_stress = fake_target * std::exp(1.0 + 3.0 * (x[0] + x[1]));
      evaluation.summary.target_distance = 1.0 + 3.0 * (x[0] + x[1]);
      evaluation.curve.stress_yy.assign(evaluation.curve.strain_yy.size(), evaluation.summary.plateau_stress);
      known.add(book.key(*visit.candidate, 0), evaluation);
    }
  }
  ASSERT_TRUE(traces[0].finished);
  EXPECT_EQ(traces[0].reason, "hardly anything to gain is expected") << traces[0].note;
  EXPECT_LT(traces[0].visits.size(), 60U);
}

}  // namespace
}  // namespace perfora::optimize
