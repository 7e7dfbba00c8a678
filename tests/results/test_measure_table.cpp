// What is here: the table of measures: its keys, its orders, its values. Expected lists are those of files that earlier
// programs wrote. What is not: how measures are computed (test_measures.cpp).
#include "results/measure_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "results/json.h"

namespace perfora::results {
namespace {

using ::testing::ElementsAre;
using ::testing::IsSubsetOf;

std::vector<std::string> keys_of(const std::vector<const Measure*>& list) {
  std::vector<std::string> keys;
  for (const Measure* measure : list) keys.push_back(measure->key);
  return keys;
}

TEST(MeasureTable, KeysAreUniqueAndSaid) {
  std::set<std::string> keys;
  for (const Measure& measure : measures()) {
    EXPECT_TRUE(keys.insert(measure.key).second) << measure.key << " stands twice";
    EXPECT_STRNE(measure.label, "") << measure.key;
    EXPECT_STRNE(measure.help, "") << measure.key;
    EXPECT_EQ(measure_called(measure.key), &measure);
  }
  EXPECT_EQ(measure_called("plateau"), nullptr);
}

// The columns of ensemble.csv since ensembles are written.
TEST(MeasureTable, EnsemblesBeginWithTheirColumns) {
  const std::vector<std::string> known = {"plateau_stress",    "first_peak_stress",
                                          "first_peak_strain", "minimum_stress_in_window",
                                          "undulation",        "densification_strain",
                                          "energy_absorbed",   "cundall_share",
                                          "broken_bonds",      "fragments"};
  const std::vector<std::string> keys = keys_of(ensemble_measures());
  ASSERT_GE(keys.size(), known.size());
  EXPECT_EQ(std::vector<std::string>(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(known.size())), known);
}

// cases.csv: of the packing in this order, then those of the run by their names.
TEST(MeasureTable, SweepsHaveThePackingThenTheRunByName) {
  const std::vector<std::string> keys = keys_of(sweep_measures());
  ASSERT_GT(keys.size(), 6u);
  EXPECT_THAT(std::vector<std::string>(keys.begin(), keys.begin() + 6),
              ElementsAre("discs", "perforations", "porosity", "thinnest_wall", "solid_fraction", "bonds_per_disc"));
  EXPECT_TRUE(std::is_sorted(keys.begin() + 6, keys.end()));
  EXPECT_THAT((std::vector<std::string>{"broken_bonds", "steps", "noise_std", "plateau_stress", "step_margin"}),
              IsSubsetOf(keys));
}

TEST(MeasureTable, ValuesComeFromTheirMembers) {
  Evaluation evaluation;
  evaluation.summary.plateau_stress = 2.5e5;
  evaluation.summary.broken_bonds = 12;
  evaluation.pack.discs = 7;
  evaluation.pack.thinnest_wall = {0.005, 1, 2};
  EXPECT_EQ(value_of(*measure_called("plateau_stress"), evaluation), 2.5e5);
  EXPECT_EQ(value_of(*measure_called("broken_bonds"), evaluation), 12.0);
  EXPECT_EQ(value_of(*measure_called("discs"), evaluation), 7.0);
  EXPECT_EQ(value_of(*measure_called("thinnest_wall"), evaluation), 0.005);
  EXPECT_TRUE(std::isnan(value_of(*measure_called("undulation"), evaluation))) << "not reached from the start";
  evaluation.pack.thinnest_wall = {};
  EXPECT_TRUE(std::isinf(value_of(*measure_called("thinnest_wall"), evaluation))) << "no wall without holes";
}

// Every member through JSON and back, each with a number of its own.
TEST(MeasureTable, JsonGivesEveryValueBack) {
  Evaluation evaluation;
  struct Fill {
    Evaluation& evaluation;
    double number;
    void operator()(double PackSummary::*member) const { evaluation.pack.*member = number; }
    void operator()(std::int64_t PackSummary::*member) const {
      evaluation.pack.*member = static_cast<std::int64_t>(number);
    }
    void operator()(double (*)(const PackSummary&)) const { evaluation.pack.thinnest_wall = {number, 0, 1}; }
    void operator()(double Summary::*member) const { evaluation.summary.*member = number; }
    void operator()(std::int64_t Summary::*member) const {
      evaluation.summary.*member = static_cast<std::int64_t>(number);
    }
  };
  double number = 1.0;
  for (const Measure& measure : measures()) std::visit(Fill{evaluation, number++}, measure.member);
  const Evaluation back = evaluation_from_json(to_json(evaluation, false));
  number = 1.0;
  for (const Measure& measure : measures()) EXPECT_EQ(value_of(measure, back), number++) << measure.key;
}

}  // namespace
}  // namespace perfora::results
