// What is here: the JSON form of results: keys, null, and the way back. Expected keys: the list in the description of
// `perfora --json`.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "results/json.h"

namespace perfora::results {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Evaluation example() {
  Evaluation evaluation;
  evaluation.reason = "reached strain 0.6";
  evaluation.seeds = {11, 12, 13, 14};
  evaluation.replicate = 3;
  evaluation.pack.discs = 1000;
  evaluation.pack.perforations = 4;
  evaluation.pack.mean_diameter = 0.5044e-3;
  evaluation.pack.thinnest_wall = {0.005, 1, 2};
  evaluation.summary.reason = evaluation.reason;
  evaluation.summary.steps = 123456789012;
  evaluation.summary.plateau_stress = 0.1 + 0.2;  // no short decimal: 17 digits or it is lost
  evaluation.summary.plateau_start = 0.2;
  evaluation.summary.plateau_end = 0.4;
  evaluation.summary.densification_strain = nan;
  evaluation.summary.broken_in_shear = 7;
  evaluation.performance.seconds = 1.5;
  evaluation.performance.simd = "avx2";
  evaluation.curve.strain_yy = {0.0, 0.1};
  evaluation.curve.stress_yy = {0.0, 1e5};
  return evaluation;
}

TEST(Json, HasEveryKeyOfTheCommandLine) {
  const auto record = to_json(example(), false);
  for (const char* key : {"schema",
                          "status",
                          "reason",
                          "seeds",
                          "results_version",
                          "performance",
                          "discs",
                          "perforations",
                          "mean_diameter",
                          "solid_fraction",
                          "porosity",
                          "bonds_per_disc",
                          "thinnest_wall",
                          "thinnest_wall_pair",
                          "thinnest_wall_discretised",
                          "max_overlap_ratio",
                          "coordination_number",
                          "rattler_fraction",
                          "steps",
                          "time_step",
                          "first_peak_stress",
                          "first_peak_strain",
                          "plateau_stress",
                          "plateau_window",
                          "minimum_stress_in_window",
                          "undulation",
                          "densification_strain",
                          "energy_absorbed",
                          "cundall_share",
                          "broken_bonds",
                          "broken_in_tension",
                          "broken_in_shear",
                          "fragments",
                          "largest_fragment_fraction",
                          "max_overlap_in_run",
                          "energy_residual"})
    EXPECT_TRUE(record.contains(key)) << key;
  for (const char* key : {"seconds", "steps_per_second", "ns_per_bond_step", "threads", "simd", "peak_memory"})
    EXPECT_TRUE(record["performance"].contains(key)) << key;
  EXPECT_EQ(record["schema"], "perfora.evaluate/1");
  EXPECT_EQ(record["status"], "completed");
}

TEST(Json, WhatWasNotReachedIsNull) {
  Evaluation evaluation = example();
  evaluation.summary.plateau_stress = std::numeric_limits<double>::infinity();
  const auto record = to_json(evaluation, false);
  EXPECT_TRUE(record["densification_strain"].is_null());
  EXPECT_TRUE(record["plateau_stress"].is_null());
  EXPECT_EQ(record.dump().find("nan"), std::string::npos);
  EXPECT_EQ(record.dump().find("inf"), std::string::npos);
}

TEST(Json, ABlockWithoutPerforationsHasNoWall) {
  Evaluation evaluation = example();
  evaluation.pack.thinnest_wall = {std::numeric_limits<double>::infinity(), -1, -1};
  const auto record = to_json(evaluation, false);
  EXPECT_TRUE(record["thinnest_wall"].is_null());
  EXPECT_TRUE(record["thinnest_wall_pair"].is_null());
  EXPECT_EQ(results::evaluation_from_json(record).pack.thinnest_wall.first, -1);
}

TEST(Json, ComesBackWithTheSameBits) {
  const Evaluation evaluation = example();
  const auto record = to_json(evaluation, true);
  const Evaluation again = results::evaluation_from_json(nlohmann::json::parse(record.dump()));
  EXPECT_EQ(again.summary.plateau_stress, evaluation.summary.plateau_stress);
  EXPECT_EQ(again.summary.steps, evaluation.summary.steps);
  EXPECT_EQ(again.summary.broken_in_shear, 7);
  EXPECT_TRUE(std::isnan(again.summary.densification_strain));
  EXPECT_EQ(again.summary.plateau_end, 0.4);
  EXPECT_EQ(again.seeds, evaluation.seeds);
  EXPECT_EQ(again.replicate, 3);
  EXPECT_EQ(again.pack.thinnest_wall.second, 2);
  EXPECT_EQ(again.performance.simd, "avx2");
  EXPECT_EQ(again.curve.stress_yy, evaluation.curve.stress_yy);
  EXPECT_EQ(to_json(again, true), record);
}

}  // namespace
}  // namespace perfora::results
