// What is here: the way of a small design to its elastic response, its JSON and its file. Expected: agreement between
// ways that must agree; the numbers themselves are checked in tests/solver/test_elastic*.cpp.
#include "optimize/evaluate/elastic_response.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "io/hdf5.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

using ::testing::HasSubstr;

class Elastic : public ::testing::Test {
 protected:
  DesignFile design(const std::vector<std::string>& overrides = {}) const {
    return DesignFile(folder_.file("design.toml", small_design), overrides);
  }
  static nlohmann::json comparable(const ElasticResponse& answer) {
    auto record = to_json(answer);
    record.erase("performance");
    return record;
  }
  DesignFolder folder_;
};

TEST_F(Elastic, FileAndRecordHoldTheSame) {
  const DesignFile file = design();
  const ElasticResponse answer = elastic_response(file, {}, 0);
  ASSERT_EQ(answer.status, results::RunStatus::completed);
  const nlohmann::json record = to_json(answer);
  write_elastic_file(folder_ / "e.h5", file, answer, record, "perfora evaluate --elastic");
  const io::Hdf5Reader written(folder_ / "e.h5");
  EXPECT_EQ(written.attribute_text("/", "format"), "perfora.elastic/1");
  EXPECT_EQ(nlohmann::json::parse(written.text("/summary")), record);
  EXPECT_EQ(written.text("/config"), file.schema().to_toml());
  EXPECT_EQ(written.doubles("/stiffness")[4], record["stiffness"][1][1].get<double>());
  EXPECT_EQ(written.doubles("/affine_stiffness")[8], record["affine_stiffness"][2][2].get<double>());
  EXPECT_EQ(written.shape("/displacement/xy"), (std::vector<std::int64_t>{answer.packed.clipped.size(), 3}));
  const std::vector<double> strains = written.doubles("/first_yield/disc_strain");
  EXPECT_EQ(*std::min_element(strains.begin(), strains.end()), record["first_yield_strain"].get<double>());
  EXPECT_EQ(written.doubles("/first_yield/bonds/strain")[0], record["first_yield_strain"].get<double>());
  EXPECT_EQ(written.doubles("/first_yield/bonds/x")[0], record["first_yield_place"][0].get<double>());
}

TEST_F(Elastic, SameDesignSameBitsOtherReplicateOtherBlock) {
  const DesignFile file = design();
  const auto first = comparable(elastic_response(file, {}, 0));
  EXPECT_EQ(comparable(elastic_response(file, {}, 0)), first);
  EXPECT_NE(comparable(elastic_response(file, {}, 1))["stiffness"], first["stiffness"]);
}

// Thresholds do not touch stiffness; halving both halves the first yield strain, for phi depends on their ratios alone.
TEST_F(Elastic, FirstYieldScalesWithTheThresholds) {
  const auto plain = comparable(elastic_response(design(), {}, 0));
  const auto weak = comparable(elastic_response(
      design({"material.critical_normal_displacement=0.7645e-6", "material.critical_shear_displacement=3.8998e-6"}), {},
      0));
  EXPECT_EQ(plain["stiffness"], weak["stiffness"]);
  constexpr double rounding = 1e-12;
  const double strain = plain["first_yield_strain"].get<double>();
  EXPECT_NEAR(weak["first_yield_strain"].get<double>(), 0.5 * strain, rounding * strain);
}

TEST_F(Elastic, WithoutBondsThereIsNoBlock) {
  EXPECT_THAT(
      complaint([&] {
        static_cast<void>(elastic_response(design({"material.horizon=1", "packing.solid_fraction=0.2"}), {}, 0));
      }),
      HasSubstr("no two discs are near enough"));
}

TEST(ElasticRecord, WhatWasNotReachedIsNull) {
  ElasticResponse answer;
  answer.status = results::RunStatus::failed;
  answer.reason = "packing not reached: too dense";
  const nlohmann::json record = to_json(answer);
  EXPECT_EQ(record["status"], "failed");
  EXPECT_TRUE(record["young_y"].is_null());
  EXPECT_TRUE(record["first_yield_strain"].is_null());
  EXPECT_TRUE(record["stiffness"][0][0].is_null());
}

}  // namespace
}  // namespace perfora::optimize
