// What is here: the seam of search algorithms: a searcher of a few fixed points carries a study to its end, algorithms
// are found by name, asking is pure. What is not: NLopt's algorithms (test_driver.cpp, test_nlopt_search.cpp).
#include <gmock/gmock.h>

#include "optimize/search/driver.h"
#include "optimize/search/study_run.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

/// Asks for its points all at once, in every arm. It knows no settings.
class FixedPoints final : public Searcher {
 public:
  explicit FixedPoints(std::vector<std::vector<double>> points) : points_(std::move(points)) {}
  Library library() const override { return {"points", "1"}; }
  std::vector<std::string> algorithms() const override { return {"FIXED_POINTS"}; }
  std::string canonical_name(const std::string& name, std::string& problem) const override {
    problem = name == "FIXED_POINTS" ? "" : "not these points";
    return name == "FIXED_POINTS" ? name : "";
  }
  bool is_local(const std::string&) const override { return false; }
  std::optional<Refusal> refuse(const std::string&, int variables) const override {
    if (variables == 2) return std::nullopt;
    return Refusal{"the points have two coordinates", "vary two keys"};
  }
  std::vector<std::string> warnings(const std::string&, int, int, int maxeval) const override {
    return {"points for at most " + std::to_string(maxeval)};
  }
  std::vector<Trace> ask(const SearchStage& stage, const CandidateStore& store) const override {
    std::vector<Trace> traces;
    for (const SearchTask& task : stage.tasks) {
      Trace& trace = traces.emplace_back(Trace{task.arm, false, {}, true, "every point asked for"});
      for (const auto& point : points_) {
        trace.visits.push_back(store.visit(store.at(task.arm, point)));
        trace.finished = trace.finished && trace.visits.back().answered;
      }
    }
    return traces;
  }

 private:
  std::vector<std::vector<double>> points_;
};

class SearcherTest : public testing::Test {
 protected:
  StudyFolder folder;
  /// Diameters of 14, 17.5 and 21 mm, jitter 0.4 mm: the middle one is the optimum of fake_evaluation().
  Searchers searchers() const {
    Searchers all = built_in_searchers();
    all.push_back(std::make_shared<FixedPoints>(std::vector<std::vector<double>>{{0.0, 0.4}, {0.5, 0.4}, {1.0, 0.4}}));
    return all;
  }
  Study study(const std::string& keys, const std::string& arms = "") const {
    return read_study(folder.file("study.toml", study_text(keys, arms)), {}, searchers());
  }
};

/// Answers everything that is open.
void answer(const Plan& plan, Answers& answers) {
  for (const Wanted& wanted : plan.wanted) answers.add(wanted.key, fake_evaluation(wanted.request));
}

TEST_F(SearcherTest, AnotherSearcherCarriesAStudyToItsEnd) {
  const Study points =
      study("maxeval = 3\nreplicates = 2\nfinal_replicates = 1\nalgorithm = \"FIXED_POINTS\"", "rows = [1, 2]");
  EXPECT_EQ(points.searcher->library().name, "points");
  EXPECT_THAT(points.warnings, testing::Contains("points for at most 1"));
  Driver driver(points);
  Answers answers;
  const Plan first = driver.plan(answers);
  EXPECT_EQ(first.wanted.size(), 2U * (1 + 2 * 3)) << "start and three points of two arms, two replicates each";
  answer(first, answers);
  const Plan second = driver.plan(answers);
  EXPECT_FALSE(second.finished);
  EXPECT_EQ(second.wanted.size(), 2U) << "best and start on a fresh seed";
  answer(second, answers);
  const Plan last = driver.plan(answers);
  EXPECT_TRUE(last.finished);
  EXPECT_EQ(last.reason, "every point asked for");
  ASSERT_NE(last.best, nullptr);
  EXPECT_EQ(last.best->arm, 1);
  EXPECT_NEAR(last.best->values[0], best_diameter, 1e-12);
  EXPECT_NEAR(last.best->values[1], best_jitter, 1e-12);
}

TEST_F(SearcherTest, StagesMayBeOfDifferentSearchers) {
  const Study both = study(
      "maxeval = 3\nfinal_replicates = 0\nalgorithm = \"FIXED_POINTS\"\nrefine = \"LN_SBPLX\"\nrefine_maxeval = 5");
  Driver driver(both);
  Answers answers;
  Plan plan = driver.plan(answers);
  for (; !plan.finished; plan = driver.plan(answers)) answer(plan, answers);
  ASSERT_EQ(plan.traces.size(), 2U);
  EXPECT_TRUE(plan.traces[1].refine);
  EXPECT_EQ(plan.traces[1].visits.front().candidate->values, plan.traces[0].visits[1].candidate->values);
}

TEST_F(SearcherTest, TheModelSearchesWhereNothingIsSaid) {
  const Study plain =
      read_study(folder.file("plain.toml",
                             "[study]\ndesign = \"design.toml\"\nmaxeval = 3\n[target]\n"
                             "plateau_stress = \"0.2 MPa\"\n[variables]\ndiameter = [\"14 mm\", \"21 mm\"]\n"));
  EXPECT_EQ(plain.keys.algorithm, "model");
  EXPECT_EQ(plain.searcher->algorithms(), std::vector<std::string>{"model"});
}

TEST_F(SearcherTest, AlgorithmsAreFoundByName) {
  const ChosenSearcher direct = choose_searcher(searchers(), "nlopt_gn_direct_l");
  ASSERT_TRUE(direct.searcher);
  EXPECT_EQ(direct.searcher->library().name, "nlopt");
  EXPECT_EQ(direct.algorithm, "GN_DIRECT_L");
  EXPECT_EQ(choose_searcher(searchers(), "FIXED_POINTS").searcher->library().name, "points");
  const ChosenSearcher none = choose_searcher(searchers(), "FIXED_POINT");
  EXPECT_EQ(none.searcher, nullptr);
  EXPECT_EQ(none.problem, "NLopt has no algorithm \"FIXED_POINT\"");
  const std::string refused = input_error([&] { study("maxeval = 3\nalgorithm = \"FIXED_POINT\""); });
  EXPECT_THAT(refused, testing::HasSubstr("did you mean FIXED_POINTS?"));
  EXPECT_THAT(input_error([&] { study("maxeval = 3\nrefine_maxeval = 3\nrefine = \"FIXED_POINTS\""); }),
              testing::HasSubstr("not a local algorithm"));
  EXPECT_THAT(input_error([&] {
                read_study(folder.file("one.toml",
                                       "[study]\ndesign = \"design.toml\"\nmaxeval = 2\nalgorithm = \"FIXED_POINTS\"\n"
                                       "[target]\nplateau_stress = 1e5\n[variables]\n\"layout.jitter\" = [0, 0.001]\n"),
                           {}, searchers());
              }),
              testing::HasSubstr("two coordinates"));
}

// What is asked with half of the answers is the beginning of what is asked with all of them, and asking changes
// nothing.
TEST_F(SearcherTest, AskingIsPure) {
  const Study one = study("maxeval = 12\nfinal_replicates = 0\nalgorithm = \"GN_CRS2_LM\"\npopulation = 5");
  SearchStage stage;
  stage.algorithm = one.keys.algorithm;
  stage.population = 5;
  stage.tasks = {{0, 12, 7, {0.2, 0.3}}};
  CandidateBook book(one);
  Answers known;
  std::vector<std::vector<std::vector<double>>> asked;  // by the number of answers
  for (bool finished = false; !finished;) {
    const CandidateStore store(one, book, known);
    const Trace trace = one.searcher->ask(stage, store).at(0), again = one.searcher->ask(stage, store).at(0);
    std::vector<std::vector<double>> points;
    for (const Visit& visit : trace.visits) points.push_back(visit.candidate->values);
    ASSERT_EQ(again.visits.size(), points.size());
    for (std::size_t k = 0; k < points.size(); ++k) EXPECT_EQ(again.visits[k].candidate->values, points[k]);
    finished = trace.finished;
    for (const Visit& visit : trace.visits)
      if (!visit.answered) known.add(book.key(*visit.candidate, 0), fake_evaluation(visit.candidate->request(0)));
    asked.push_back(points);
  }
  ASSERT_EQ(asked.back().size(), 12U);
  for (const auto& points : asked)
    for (std::size_t k = 0; k < points.size(); ++k) EXPECT_EQ(points[k], asked.back()[k]);
}

// A ladder of fidelities is data of the study.
TEST_F(SearcherTest, ACandidateHasARequestAFidelity) {
  Study ladder = study("maxeval = 3");
  ladder.fidelities.push_back(
      {"coarse",
       {{"packing.mean_diameter", {std::string("1 mm")}}, {"packing.maximum_diameter", {std::string("1.9825 mm")}}},
       0.3});
  CandidateBook book(ladder);
  const Candidate& candidate = book.at(0, std::vector<double>{0.016, 0.0});
  ASSERT_EQ(candidate.problem, "");
  ASSERT_EQ(candidate.requests.size(), 2U);
  const Request fine = candidate.request(1), coarse = candidate.request(1, 1);
  EXPECT_EQ(fine.strain(), 0.45);
  EXPECT_EQ(coarse.strain(), 0.3);
  EXPECT_EQ(coarse.fidelity, "coarse");
  EXPECT_EQ(coarse.replicate, 1);
  EXPECT_EQ(coarse.design->packing.mean_diameter, 1e-3);
  EXPECT_EQ(coarse.design->layout.diameter, fine.design->layout.diameter);
  EXPECT_NE(coarse.key(), fine.key());
}

// What a model learns from: designs that are told or visited, at every fidelity, in an order of their own.
TEST_F(SearcherTest, ObservedDesignsAreOrderedByWhatTheyAre) {
  Study ladder = study("maxeval = 3\nreplicates = 2", "rows = [1, 2]");
  ladder.fidelities.push_back({"short", {}, 0.3});
  CandidateBook book(ladder);
  const Candidate& late = book.at(1, std::vector<double>{0.016, 0.0});
  const Candidate& early = book.at(0, std::vector<double>{0.018, 0.0});
  const Candidate& unknown = book.at(0, std::vector<double>{0.019, 0.0});
  Answers known;
  for (const Request& request : {late.request(1), late.request(0), early.request(0), early.request(5)})
    known.add(request.key(), fake_evaluation(request));
  known.add(late.request(0, 1).key(), fake_evaluation(late.request(0, 1)));
  CandidateStore store(ladder, book, known);
  store.observe(late);
  const std::vector<const Candidate*> visited{&unknown, &early, &late};
  const std::vector<Observed> observed = store.observed(visited, 2);
  ASSERT_EQ(observed.size(), 3U);
  EXPECT_EQ(observed[0].candidate, &early);
  EXPECT_EQ(observed[0].replicates.size(), 1U) << "replicate 5 is not among the first two";
  EXPECT_EQ(observed[1].candidate, &late);
  EXPECT_EQ(observed[1].fidelity, 0U);
  ASSERT_EQ(observed[1].replicates.size(), 2U);
  EXPECT_EQ(observed[1].replicates[1]->replicate, 1);
  EXPECT_NEAR(observed[1].point[0], (0.016 - 0.014) / 0.007, 1e-12);
  EXPECT_EQ(observed[2].fidelity, 1U);
  EXPECT_EQ(observed[2].replicates[0]->summary.final_strain, 0.3);
}

TEST(Points, LieOnAGrid) {
  EXPECT_EQ(on_grid({0.5, 0.3, -0.1, 1.2}), (std::vector<double>{0.5, 1229.0 / 4096.0, 0.0, 1.0}));
}

TEST(UsefulWorkers, AreAsManyAsPointsThatAreAskedAtOnce) {
  const StudyFolder folder;
  const auto useful = [&](const std::string& algorithm) {
    return useful_workers(read_study(folder.file(
                              "s.toml", study_text("maxeval = 12\nreplicates = 2\nalgorithm = \"" + algorithm + "\""))),
                          100);
  };
  EXPECT_EQ(useful("sobol"), 24);
  EXPECT_EQ(useful("random"), 24);
  EXPECT_EQ(useful("model"), 8) << "a batch of four";
  EXPECT_EQ(useful("GN_DIRECT_L"), 2);
}

}  // namespace
}  // namespace perfora::optimize
