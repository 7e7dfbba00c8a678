// What is here: the similarity of grades: runs, tests and elastic responses of a material with both stiffnesses times
// g, and stored evaluations that answer for other grades. Expected: theory.md, "Grade, strength, scale". What is not:
// which requests a campaign makes.
#include <gtest/gtest.h>

#include <cmath>

#include "optimize/evaluate/answers.h"
#include "optimize/evaluate/elastic_response.h"
#include "optimize/evaluate/estimate.h"
#include "optimize/evaluate/material_tests.h"
#include "results/grade.h"
#include "results/history_file.h"
#include "results/json.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

using results::History;

class Grade : public ::testing::Test {
 protected:
  DesignFile design(std::vector<std::string> overrides) const {
    overrides.insert(overrides.begin(), {"loading.rate=0", "loading.transits=2", "loading.until=0.1",
                                         "measures.plateau_start=0.02", "measures.plateau_end=0.06"});
    return DesignFile(folder_.file("design.toml", small_design), overrides);
  }
  Evaluation run(const std::vector<std::string>& overrides) const { return evaluate_design(design(overrides), {}, 0); }
  DesignFolder folder_;
};

/// Both stiffnesses of the default material times four, written out.
const std::vector<std::string> four_times = {"material.normal_stiffness=8.78e7",
                                             "material.tangential_stiffness=3.2984e7"};
const std::vector<std::string> grade_four = {"material.grade=4"};

nlohmann::json comparable(const Evaluation& evaluation) {
  nlohmann::json record = to_json(evaluation, true);
  record.erase("performance");
  record.erase("grade");
  return record;
}

void with(std::vector<std::string>& overrides, const std::string& one) {
  overrides.push_back(one);
}

// 2 = sqrt(4) is a power of two, so every product of the run with the stiffer springs has the same digits: masses,
// steps, dashpots, damping, the controlled rate. Bit for bit what the program says without a run of its own.
TEST_F(Grade, ARunWithFourTimesTheStiffnessIsTheScaledOneToTheLastBit) {
  for (const char* other : {"loading.rate=0", "loading.rate=40", "loading.control=constant",
                            "boundary.top_bottom=platens", "boundary.sides=free", "dynamics.mass=physical"}) {
    std::vector<std::string> stiff = four_times, grade = grade_four;
    for (auto* overrides : {&stiff, &grade}) {
      with(*overrides, other);
      with(*overrides, "loading.until=0.03");
    }
    const Evaluation direct = run(stiff), scaled = run(grade);
    ASSERT_GT(direct.summary.broken_bonds, 100) << "contacts must count, too";
    EXPECT_EQ(comparable(direct), comparable(scaled)) << other;
  }
}

TEST_F(Grade, StressesAndEnergiesFollowTheGradeExactly) {
  const Evaluation one = run({}), two = run({"material.grade=2"}), mortar = run({"material.grade=22.3"});
  ASSERT_GT(one.summary.first_peak_stress, 0.0);
  for (std::size_t row = 0; row < one.curve.rows(); ++row) {
    EXPECT_EQ(two.curve.stress_yy[row], 2.0 * one.curve.stress_yy[row]);
    EXPECT_EQ(two.curve.cundall[row], 2.0 * one.curve.cundall[row]);
    EXPECT_DOUBLE_EQ(mortar.curve.stress_yy[row], 22.3 * one.curve.stress_yy[row]);
    EXPECT_DOUBLE_EQ(mortar.curve.time[row], one.curve.time[row] / std::sqrt(22.3));
  }
  EXPECT_EQ(two.curve.strain_yy, one.curve.strain_yy);
  EXPECT_EQ(two.curve.broken_bonds, one.curve.broken_bonds);
  EXPECT_EQ(two.summary.first_peak_stress, 2.0 * one.summary.first_peak_stress);
  EXPECT_EQ(two.summary.plateau_stress, 2.0 * one.summary.plateau_stress);
  EXPECT_EQ(two.summary.undulation, one.summary.undulation);
  EXPECT_DOUBLE_EQ(two.summary.time_step, one.summary.time_step / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(two.summary.rate, one.summary.rate * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(two.summary.impact_ratio, one.summary.impact_ratio);
  EXPECT_DOUBLE_EQ(two.summary.transits_before_peak, one.summary.transits_before_peak);
}

TEST_F(Grade, AStoredEvaluationAnswersForEveryGrade) {
  const Request stored = make_request(design({"material.grade=2"}), 0),
                asked = make_request(design({"material.grade=6"}), 0);
  ASSERT_EQ(stored.key(), asked.key());
  ASSERT_EQ(make_request(design({}), 0).key(), asked.key());
  EXPECT_NE(stored.full_key(), asked.full_key()) << "run files are of one grade";
  Answers answers;
  const Evaluation made = evaluate_request(stored, 1);
  answers.add(stored.key(), made);
  const Evaluation* same = answer_for(stored, stored.key(), answers);
  ASSERT_NE(same, nullptr);
  EXPECT_EQ(same->summary.first_peak_stress, made.summary.first_peak_stress);
  const Evaluation* answer = answer_for(asked, asked.key(), answers);
  ASSERT_NE(answer, nullptr);
  EXPECT_EQ(answer->grade, 6.0);
  EXPECT_EQ(answer->summary.plateau_stress, 3.0 * made.summary.plateau_stress);
  EXPECT_EQ(answer_for(asked, asked.key(), answers), answer) << "it is remembered";
}

// A rate of its own is not similar: at four times the stiffness waves run twice as fast, so 40 /s at grade 4 is the run
// of 20 /s at grade 1.
TEST_F(Grade, AGivenRateIsOneOfItsOwn) {
  const auto key = [&](const std::vector<std::string>& overrides) { return make_request(design(overrides), 0).key(); };
  EXPECT_NE(key({"loading.rate=40", "material.grade=4"}), key({"loading.rate=40"}));
  EXPECT_EQ(key({"loading.rate=40", "material.grade=4"}), key({"loading.rate=20"}));
}

TEST_F(Grade, AHistoryAnswersForAnotherWindowAtAnotherGrade) {
  const Request first = make_request(design({"material.grade=2"}), 0);
  const Request other = make_request(
      design({"material.grade=8", "loading.until=0.08", "measures.plateau_start=0.03", "measures.plateau_end=0.07"}),
      0);
  const Evaluation made = evaluate_request(first, 1);
  results::write_history_file(folder_ / "h.h5", made.curve, made.grade);
  EXPECT_EQ(results::read_history_file(folder_ / "h.h5").grade, 2.0);
  Answers answers;
  Evaluation stored = made;
  stored.curve = results::coarse_curve(made.curve);
  answers.add(first.key(), stored);
  answers.set_histories([&](const std::string&) { return results::read_history_file(folder_ / "h.h5"); });
  const Evaluation* answer = answer_for(other, other.key(), answers);
  ASSERT_NE(answer, nullptr);
  const Evaluation own = evaluate_request(other, 1);
  EXPECT_DOUBLE_EQ(answer->summary.plateau_stress, own.summary.plateau_stress);
  EXPECT_DOUBLE_EQ(answer->summary.rate, own.summary.rate);
  EXPECT_EQ(answer->summary.broken_bonds, own.summary.broken_bonds);
}

TEST_F(Grade, TestsAndElasticResponseFollowToo) {
  MaterialTestsOptions options;
  const std::vector<std::string> small = {"material_test.size=8 mm", "loading.transits=5"};
  std::vector<std::string> larger = small;
  with(larger, "material.grade=2");
  using enum solver::MaterialTestKind;
  const MaterialTests one = test_material(design(small), {tension}, options),
                      two = test_material(design(larger), {tension}, options);
  const auto& first = one.runs.front().result;
  const auto& second = two.runs.front().result;
  EXPECT_EQ(second.strength, 2.0 * first.strength);
  EXPECT_EQ(second.modulus, 2.0 * first.modulus);
  EXPECT_EQ(second.curve.stress.back(), 2.0 * first.curve.stress.back());
  EXPECT_EQ(second.peak_strain, first.peak_strain);
  const ElasticResponse soft = elastic_response(design({}), {}, 0), stiff = elastic_response(design(grade_four), {}, 0);
  EXPECT_EQ(stiff.response.moduli.young_y, 4.0 * soft.response.moduli.young_y);
  EXPECT_EQ(stiff.first_yield.stress, 4.0 * soft.first_yield.stress);
  EXPECT_EQ(stiff.first_yield.strain, soft.first_yield.strain);
  const DesignEstimate here = estimate_design(design({}), 1), there = estimate_design(design(grade_four), 1);
  EXPECT_EQ(there.steps, here.steps);
  EXPECT_EQ(there.time_step, 0.5 * here.time_step);
  EXPECT_EQ(there.rate, 2.0 * here.rate);
  EXPECT_EQ(there.characteristic_length, here.characteristic_length);
}

// Four times the area of the same packing: 4 times the discs to rounding, of the same sizes.
TEST_F(Grade, ScaleLeavesTheDiscsAndTheMaterial) {
  const PackedDesign plain = pack_design(design({}), {}, 0), larger = pack_design(design({"cell.scale=2"}), {}, 0);
  EXPECT_EQ(larger.layout.width, 0.024);
  EXPECT_EQ(larger.periodic.width, 0.024);
  EXPECT_NEAR(static_cast<double>(larger.periodic.size()) / static_cast<double>(plain.periodic.size()), 4.0, 0.02);
  EXPECT_NEAR(larger.summary.mean_diameter, plain.summary.mean_diameter, 0.01e-3);
  EXPECT_DOUBLE_EQ(larger.summary.thinnest_wall.thickness, 2.0 * plain.summary.thinnest_wall.thickness);
  EXPECT_DOUBLE_EQ(larger.summary.wall_ratio, 2.0 * plain.summary.wall_ratio);
}

// l_ch = 13 <d> (horizon/3)^1.4, or as measured at the reference diameter, growing with the discs.
TEST(CharacteristicLength, IsEstimatedOrMeasured) {
  solver::MaterialOptions material;
  EXPECT_DOUBLE_EQ(characteristic_length(material, 1e-3), 13e-3);
  material.horizon = 2.0;
  EXPECT_DOUBLE_EQ(characteristic_length(material, 1e-3), 13e-3 * std::pow(2.0 / 3.0, 1.4));
  material.characteristic_length = 5e-3;
  EXPECT_DOUBLE_EQ(characteristic_length(material, 2.0 * material.reference_mean_diameter), 10e-3);
  material.grade = 20.0;
  material.strength = 3.0;
  EXPECT_DOUBLE_EQ(characteristic_length(material, material.reference_mean_diameter), 5e-3);
}

// Critical displacements times s at the same stiffness: first yield s times later and at s times the stress.
TEST_F(Grade, StrengthActsAtTheSameModulus) {
  const ElasticResponse plain = elastic_response(design({}), {}, 0),
                        strong = elastic_response(design({"material.strength=2"}), {}, 0);
  EXPECT_EQ(strong.response.moduli.young_y, plain.response.moduli.young_y);
  EXPECT_DOUBLE_EQ(strong.first_yield.stress, 2.0 * plain.first_yield.stress);
  EXPECT_DOUBLE_EQ(strong.first_yield.strain, 2.0 * plain.first_yield.strain);
  const Evaluation written = run({"material.critical_normal_displacement=3.058e-6",
                                  "material.critical_shear_displacement=1.55992e-5"}),
                   factor = run({"material.strength=2"});
  EXPECT_EQ(comparable(factor), comparable(written));
  EXPECT_NE(make_request(design({"material.strength=2"}), 0).key(), make_request(design({}), 0).key());
}

}  // namespace
}  // namespace perfora::optimize
