// What is here: ranks, Spearman's coefficient and its interval against numbers worked by hand; sweeps compared by the
// labels of their cases. What is not: the picture (tests/report).
#include "optimize/campaign/rank_correlation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "optimize/campaign/sweep_comparison.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Ranks, TiesShareTheMeanPlace) {
  EXPECT_THAT(ranks({30.0, 10.0, 20.0, 10.0}), ElementsAre(4.0, 1.5, 3.0, 1.5));
  EXPECT_TRUE(ranks({}).empty());
}

// Without ties rho = 1 - 6 sum d^2/(n (n^2 - 1)). Ranks 1 2 3 4 5 6 against 2 1 4 3 6 5: d^2 sums to 6, so 1 - 36/210.
TEST(RankCorrelation, IsTheTextbookFormulaWithoutTies) {
  const RankCorrelation result = rank_correlation({1, 2, 3, 4, 5, 6}, {20, 10, 40, 30, 60, 50});
  EXPECT_EQ(result.count, 6);
  EXPECT_NEAR(result.coefficient, 1.0 - 36.0 / 210.0, 1e-14);
}

TEST(RankCorrelation, TrustNeedsTwentyCasesAndFourFifths) {
  const auto with = [](int count, double coefficient) { return trust_in({count, coefficient, 0.0, 1.0}); };
  EXPECT_EQ(with(19, 0.99), Trust::too_few);
  EXPECT_EQ(with(20, 0.8), Trust::trusted);
  EXPECT_EQ(with(50, 0.79), Trust::not_trusted);
  EXPECT_EQ(with(50, std::nan("")), Trust::not_trusted);
}

// rho = 0: the interval is tanh(-+1.959964/sqrt(n - 3)). Ranks 1..4 against 2 4 1 3: d^2 = 1 + 4 + 4 + 1 = 10, so
// 1 - 60/60 = 0; n - 3 = 1.
TEST(RankCorrelation, IntervalAtZeroIsThatOfFisher) {
  const RankCorrelation result = rank_correlation({1, 2, 3, 4}, {2, 4, 1, 3});
  EXPECT_NEAR(result.coefficient, 0.0, 1e-14);
  EXPECT_NEAR(result.high, std::tanh(1.959963984540054), 1e-12);
  EXPECT_NEAR(result.low, -result.high, 1e-12);
}

TEST(RankCorrelation, KnowsNoMoreThanItsPairs) {
  const double nothing = std::nan("");
  const RankCorrelation same = rank_correlation({1, 2, nothing, 4, 8}, {1, 3, 7, 4, 5});
  EXPECT_EQ(same.count, 4);
  EXPECT_EQ(same.coefficient, 1.0);
  EXPECT_TRUE(std::isnan(same.low)) << "four pairs in order do not say how sure they are";
  EXPECT_TRUE(std::isnan(rank_correlation({1, 2}, {1, 2}).coefficient));
  EXPECT_TRUE(std::isnan(rank_correlation({1, 1, 1}, {1, 2, 3}).coefficient));
}

// Any rising transform of either list leaves ranks as they are; turning one list over changes the sign.
TEST(RankCorrelation, SeesOrderOnly) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<double> a(15), b(15), c(15), d(15);
    for (std::size_t k = 0; k < a.size(); ++k) {
      a[k] = normal(engine);
      b[k] = a[k] + normal(engine);
      c[k] = std::exp(3.0 * b[k]);
      d[k] = -b[k];
    }
    EXPECT_NEAR(rank_correlation(a, b).coefficient, rank_correlation(c, a).coefficient, 1e-14);
    EXPECT_NEAR(rank_correlation(a, b).coefficient, -rank_correlation(a, d).coefficient, 1e-14);
  }
}

// The 95 % interval of Bonett and Wright holds the true coefficient of a bivariate normal, (6/pi) asin(r/2), in about
// 95 % of samples: 2,000 samples of 20 pairs scatter by 0.5 %, and the authors find 93 to 96 %.
TEST(RankCorrelation, IntervalCoversTheTruth) {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  for (const double r : {0.0, 0.5, 0.8}) {
    const double truth = 6.0 / std::acos(-1.0) * std::asin(0.5 * r);
    int covered = 0;
    constexpr int samples = 2000;
    for (int sample = 0; sample < samples; ++sample) {
      std::vector<double> a(20), b(20);
      for (std::size_t k = 0; k < a.size(); ++k) {
        a[k] = normal(engine);
        b[k] = r * a[k] + std::sqrt(1.0 - r * r) * normal(engine);
      }
      const RankCorrelation result = rank_correlation(a, b);
      covered += result.low <= truth && truth <= result.high;
    }
    EXPECT_NEAR(static_cast<double>(covered) / samples, 0.95, 0.02) << r;
  }
}

class SweepRecords : public ::testing::Test {
 protected:
  StudyFolder folder;

  /// A sweep whose case k, called by `labels`, has plateau `plateaus[k]`; NaN: not completed.
  std::filesystem::path sweep(const std::string& name, const std::vector<std::string>& labels,
                              const std::vector<double>& plateaus) {
    nlohmann::json cases = nlohmann::json::array();
    for (std::size_t k = 0; k < labels.size(); ++k)
      cases.push_back({{"label", labels[k]},
                       {"completed", std::isfinite(plateaus[k]) ? 1 : 0},
                       {"statistics",
                        {{"plateau_stress", {{"mean", number(plateaus[k])}, {"confidence_95", nullptr}}},
                         {"undulation", {{"mean", nullptr}, {"confidence_95", nullptr}}}}}});
    std::filesystem::create_directory(folder / name);
    std::ofstream(folder / name / "result.json")
        << nlohmann::json{{"schema", "perfora.sweep/1"}, {"cases", cases}}.dump();
    return folder / name;
  }
};

TEST_F(SweepRecords, MeetByLabel) {
  const SweepRecord dear = read_completed_sweep(sweep("dear", {"a", "b", "c", "d", "x"}, {10, 20, 30, 40, 50}));
  const SweepRecord cheap = read_completed_sweep(sweep("cheap", {"d", "y", "c", "b", "a"}, {80, 1, 40, 60, 20}));
  EXPECT_EQ(dear.name, "dear");
  const auto compared = compare_sweeps(dear, cheap, {"plateau_stress", "undulation"}, {});
  ASSERT_EQ(compared.size(), 2u);
  EXPECT_THAT(compared[0].labels, ElementsAre("a", "b", "c", "d"));
  // 1 2 3 4 against 1 3 2 4: 1 - 6 (1 + 1)/(4 15)
  EXPECT_NEAR(compared[0].correlation.coefficient, 0.8, 1e-14);
  EXPECT_NEAR(compared[0].median_ratio, 2.0, 1e-14) << "of 2, 3, 4/3, 2";
  EXPECT_EQ(compared[1].correlation.count, 0);
  const nlohmann::json record = to_json(cheap, compared);
  EXPECT_EQ(record["measures"]["plateau_stress"]["cases"][1]["sweep"], 60.0);
  EXPECT_TRUE(record["measures"]["undulation"]["rank_correlation"].is_null());
}

TEST_F(SweepRecords, SayWhyNumbersMayDiffer) {
  SweepRecord a;
  a.name = "a";
  a.cases.emplace_back().results["final_strain"] = {0.6, 0.0};
  a.plateau_window = {0.2, 0.4};
  SweepRecord b = a;
  b.name = "b";
  EXPECT_TRUE(differences(a, b).empty());
  b.plateau_window = {0.1, 0.3};
  b.cases[0].results["final_strain"].mean = 0.3;
  EXPECT_THAT(differences(a, b), ElementsAre("the plateau is taken from 20 to 40 % strain in a, from 10 to 30 % in b",
                                             HasSubstr("a was compressed to 60 %, b to 30 %")));
  b.plateau_window.clear();  // of an older program
  EXPECT_EQ(differences(a, b).size(), 1u);
}

TEST_F(SweepRecords, OnlySomeCases) {
  const SweepRecord dear = read_completed_sweep(sweep("dear", {"a 1", "b 1", "c 1", "d 2"}, {1, 2, 3, 4}));
  const SweepRecord cheap = read_completed_sweep(sweep("cheap", {"a 1", "b 1", "c 1", "d 2"}, {3, 2, 1, 9}));
  EXPECT_EQ(compare_sweeps(dear, cheap, {"plateau_stress"}, {" 1"})[0].correlation.coefficient, -1.0);
  const std::string refused = input_error([&] { compare_sweeps(dear, cheap, {"plateau_stress"}, {" 2"}); });
  EXPECT_THAT(refused, HasSubstr("needs three"));
  EXPECT_THAT(refused, HasSubstr("a 1"));
}

TEST_F(SweepRecords, OtherFilesAreRefused) {
  const auto unfinished = sweep("unfinished", {"a"}, {std::nan("")});
  EXPECT_THAT(input_error([&] { read_completed_sweep(unfinished); }), HasSubstr("no case of this sweep has completed"));
  EXPECT_THAT(input_error([&] { read_completed_sweep(folder / "none"); }), HasSubstr("no such file"));
  std::filesystem::create_directory(folder / "running");
  EXPECT_THAT(input_error([&] { read_completed_sweep(folder / "running"); }), HasSubstr("holds no result of a sweep"));
  folder.file("r.json", R"({"schema": "perfora.study/1"})");
  EXPECT_THAT(input_error([&] { read_completed_sweep(folder / "r.json"); }), HasSubstr("not the result of a sweep"));
}

}  // namespace
}  // namespace perfora::optimize
