// What is here: maps as records: there and back, what they say of wishes, as sweeps. What is not: making them
// (tests/optimize/search/test_map.cpp).
#include "results/map_record.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/files.h"
#include "tests/results/synthetic_run.h"

namespace perfora::results {
namespace {

MapRecord example() {
  MapRecord record;
  record.title = "block";
  record.replicates = 2;
  record.variables = {"layout.diameter"};
  record.window = {0.2, 0.4};
  Target target;
  target.plateau_stress = 1.5e6;
  record.wishes = wishes(target);
  for (int k = 1; k <= 3; ++k) {
    MapDesign& design = record.designs.emplace_back();
    design.number = k;
    design.arm = "all, \"or\" none";
    design.label = "diameter " + std::to_string(k);
    design.values = {0.01 * k};
    design.completed = 2;
    design.results["plateau_stress"] = statistic_of("plateau_stress", {0.9e5 * k, 1.1e5 * k});
  }
  record.designs.back().failed = 1;
  record.designs.back().reason = "unstable step";
  return record;
}

TEST(MapRecord, ComesBackFromItsFile) {
  const auto folder = testing::fresh_folder("map-record");
  std::filesystem::create_directories(folder);
  const MapRecord written = example();
  io::write_file(folder / "map.json", to_json(written).dump());
  const MapRecord read = read_map_record(folder);
  EXPECT_EQ(to_json(read), to_json(written));
  EXPECT_EQ(read.wishes.front().measure->key, std::string("plateau_stress"));
  std::filesystem::remove_all(folder);
}

TEST(MapRecord, SaysWhatLiesOutOfReach) {
  const MapRecord record = example();
  const MappedRange range = mapped_range(record, *measure_called("plateau_stress"));
  EXPECT_DOUBLE_EQ(range.low, 1e5);
  EXPECT_DOUBLE_EQ(range.high, 3e5);
  const auto sentences = out_of_reach(record);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_EQ(sentences.front(),
            "out of the reachable range: plateau stress wished 1.2 to 1.8 MPa, 100 to 300 kPa mapped with 3 designs");
  MapRecord within = example();
  Target target;
  target.plateau_stress = 2e5;
  within.wishes = wishes(target);
  EXPECT_TRUE(out_of_reach(within).empty());
}

TEST(MapRecord, IsASweepOfItsDesigns) {
  const SweepRecord sweep = as_sweep(example(), "/somewhere/cheap");
  EXPECT_EQ(sweep.name, "cheap");
  ASSERT_EQ(sweep.cases.size(), 3U);
  EXPECT_DOUBLE_EQ(sweep.cases[1].results.at("plateau_stress").mean, 2e5);
}

TEST(MapRecord, ItsTableQuotesTextsAndNamesFailures) {
  const std::string csv = map_csv(example());
  EXPECT_EQ(csv.substr(0, csv.find('\n')).substr(0, 33), "number,arm,layout.diameter,comple");
  EXPECT_NE(csv.find("\"all, \"\"or\"\" none\""), std::string::npos);
  EXPECT_NE(csv.find("unstable step"), std::string::npos);
}

}  // namespace
}  // namespace perfora::results
