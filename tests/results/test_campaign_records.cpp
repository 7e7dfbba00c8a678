// What is here: folders of studies, sweeps, ensembles and calibrations read back from their files, finished or not.
// Expected: what the files say, worked out by hand. What is not: writing them (tests/optimize), drawing (tests/report).
#include <gmock/gmock.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "io/error.h"
#include "io/journal.h"
#include "results/calibration_record.h"
#include "results/campaign_folder.h"
#include "results/study_record.h"
#include "results/sweep_record.h"

namespace perfora::results {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CampaignRecords : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "perfora-records-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }

  void file(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  void journal(const std::vector<json>& events) const {
    fs::remove(folder_ / "journal.jsonl");
    io::Journal made(folder_ / "journal.jsonl");
    for (const json& event : events) made.append(event.dump());
  }
  static std::string refused(const std::function<void()>& read) {
    try {
      read();
    } catch (const io::InputError& error) {
      return error.what();
    }
    return {};
  }

  /// A sweep of the cases called so; case k has settings of `columns`.
  void sweep(const std::vector<std::string>& labels, const std::vector<std::string>& columns, int first = 1) const {
    json cases = json::array(), settings = json::object();
    for (const std::string& key : columns) settings[key] = 1.0;
    for (std::size_t k = 0; k < labels.size(); ++k)
      cases.push_back({{"case", first + static_cast<int>(k)},
                       {"label", labels[k]},
                       {"settings", settings},
                       {"problem", nullptr},
                       {"completed", 1},
                       {"statistics", json::object()}});
    file("result.json", json({{"schema", "perfora.sweep/1"},
                              {"reason", "done"},
                              {"replicates", 1},
                              {"measures", {"plateau_stress"}},
                              {"cases", cases}})
                            .dump());
  }
  static std::vector<std::string> places(const SweepRecord& record) {
    std::vector<std::string> texts;
    for (const SweepCase& one : record.cases)
      texts.push_back(one.group + "|" + one.axis + "|" + one.place + "|" + one.series);
    return texts;
  }

  fs::path folder_;
};

TEST_F(CampaignRecords, AStudyGoesThroughItsFile) {
  StudyRecord record;
  record.title = "cell";
  record.subtitle = "GN_DIRECT_L, 2 replicates";
  record.points = {{1, "square", {0.02, 1.0}, 0.5, true}, {2, "square", {0.03, 2.0}, NAN, false}};
  record.best_number = 1;
  record.best = {{{0.0, 0.1}, {0.0, 1e5}}};
  record.best_plateau = 2e5;
  record.start_plateau_deviation = 1e4;
  record.target = 3e5;
  record.window_start = 0.25;
  record.best_layout = geometry::PerforationLayout{0.05, 0.04, {{0.01, 0.02, geometry::Circle{0.015}}}};
  record.facts = {{"diameter", "18 mm", ""}};
  file("study.json", to_json(record).dump());
  const StudyRecord read = read_study_record(folder_);
  EXPECT_EQ(to_json(read), to_json(record));
  EXPECT_TRUE(std::isnan(read.points[1].score));
  EXPECT_EQ(read.best_layout->perforations, record.best_layout->perforations);
  EXPECT_FALSE(read.start_layout || read.start_plateau || read.best_plateau_deviation);
  file("study.json", "{}");
  EXPECT_THAT(refused([&] { read_study_record(folder_); }), HasSubstr("--resume"));
}

TEST_F(CampaignRecords, AStudyOfAnOlderProgramIsReadFromItsResults) {
  journal({{{"event", "study"}, {"file", "cell.toml"}}});
  file("result.json", json({{"schema", "perfora.optimize/1"},
                            {"algorithm", "LN_SBPLX"},
                            {"replicates", 1},
                            {"evaluations", 4},
                            {"reason", "maxeval"},
                            {"target", 2e5},
                            {"plateau_window", {0.3, 0.4}},
                            {"score", 0.25},
                            {"start_score", 0.5},
                            {"best", {{"layout.diameter", 0.0175}}},
                            {"start", {{"layout.diameter", 0.016}}},
                            {"plateau_stress", {{"mean", 1.9e5}, {"standard_deviation", nullptr}}}})
                          .dump());
  file("evaluations.csv",
       "stage,arm,number,layout.diameter,status,violation,score,replicates\n"
       "start,\"start\",0,0.016,\"completed\",0,0.5,1\n"
       "search,\"family=square, say\",1,0.016,\"completed\",0,0.5,1\n"
       "search,\"family=square, say\",2,0.02,\"breaks a constraint\",0.1,1100,0\n"
       "search,\"family=square, say\",3,0.0175,\"completed\",0,0.25,1\n"
       "refine,\"family=square, say\",1,0.018,\"failed\",0,1000,1\n"
       "refine,\"family=square, say\",2,0.0181,\"open\",0,,0\n");
  const StudyRecord record = read_study_record(folder_);
  EXPECT_EQ(record.title, "cell");
  EXPECT_EQ(record.subtitle, "LN_SBPLX, 1 replicate a candidate, 4 evaluations; maxeval");
  ASSERT_EQ(record.points.size(), 4u) << "the start and open points are left out";
  EXPECT_EQ(record.points[0].arm, "family=square, say");
  EXPECT_FALSE(record.points[1].feasible);
  EXPECT_EQ(record.best_number, 3);
  EXPECT_EQ(record.points[3].arm, "family=square, say (refine)");
  EXPECT_TRUE(std::isnan(record.points[3].score));
  EXPECT_EQ(record.window_start, 0.3);
  EXPECT_EQ(record.best_plateau, 1.9e5);
  EXPECT_EQ(record.facts[0].best, "0.0175");
  EXPECT_EQ(record.facts[0].start, "0.016");
}

// Table of [rows] name = A, B; [grid] horizon = 2, 3; [each] noise.amplitude = 1, 2 and cell.width = "9 mm".
TEST_F(CampaignRecords, CasesStandWhereTheJournalSays) {
  sweep({"the design itself", "A, horizon 2", "A, horizon 3", "B, horizon 2", "B, horizon 3", "amplitude 1",
         "amplitude 2", "width 9 mm"},
        {"cell.width", "material.horizon", "noise.amplitude"}, 0);
  journal({{{"event", "sweep"},
            {"file", "table.toml"},
            {"grid_key", "material.horizon"},
            {"each", json::array({json::array({"noise.amplitude", 2}), json::array({"cell.width", 1})})}}});
  const SweepRecord record = read_sweep_record(folder_);
  EXPECT_EQ(record.title, "table");
  EXPECT_EQ(campaign_kind(folder_), "sweep");
  const std::vector<std::string> told = {"|||",
                                         "|material.horizon|2|A",
                                         "|material.horizon|3|A",
                                         "|material.horizon|2|B",
                                         "|material.horizon|3|B",
                                         "noise.amplitude|noise.amplitude|1|",
                                         "noise.amplitude|noise.amplitude|2|",
                                         "cell.width|cell.width|9 mm|"};
  EXPECT_EQ(places(record), told);
  // A journal of version 0.1 does not say it: the labels do.
  journal({{{"event", "sweep"}, {"file", "table.toml"}}});
  EXPECT_EQ(places(read_sweep_record(folder_)), told);
}

// Two columns of [rows] without names look like a grid, but no two cases differ in the last one alone.
TEST_F(CampaignRecords, RowsStandUnderTheirNames) {
  const std::vector<std::string> labels = {"rows 2, holes [[1, 2], [3, 4]]", "rows 3, holes []"};
  sweep(labels, {"layout.holes", "layout.rows"});
  EXPECT_THAT(places(read_sweep_record(folder_)), ElementsAre("||" + labels[0] + "|", "||" + labels[1] + "|"));
  sweep({"square", "rows 3, turned"}, {"layout.family", "layout.rows"});
  EXPECT_THAT(places(read_sweep_record(folder_)), ElementsAre("||square|", "||rows 3, turned|"));
}

TEST_F(CampaignRecords, RunsOfASweepAreReadFromItsTables) {
  sweep({"a, \"b\"", "c"}, {});
  file("runs.csv",
       "case,label,replicate,status,packing_seed,plateau_stress,seconds,simd,run_file\n"
       "1,\"a, \"\"b\"\"\",0,completed,7,2000,1,avx2,runs/x.h5\n1,\"a, \"\"b\"\"\",1,failed,8,,1,avx2,\n"
       "9,\"gone\",0,completed,7,1,1,avx2,\n");
  file("curves.csv", "case,replicate,strain_yy,stress_yy\n1,0,0.1,10\n1,0,0.2,20\n9,0,0.1,1\n");
  SweepRecord record = read_sweep_record(folder_);
  read_sweep_runs(record);
  ASSERT_EQ(record.cases[0].runs.size(), 2u);
  const CaseRun& run = record.cases[0].runs[0];
  EXPECT_TRUE(run.completed && !record.cases[0].runs[1].completed);
  EXPECT_EQ(run.results.at("plateau_stress"), 2000.0);
  EXPECT_EQ(run.run_file, fs::absolute(folder_) / "runs/x.h5");
  EXPECT_THAT(run.curve.strain, ElementsAre(0.1, 0.2));
  EXPECT_THAT(run.curve.stress, ElementsAre(10.0, 20.0));
  EXPECT_TRUE(record.cases[1].runs.empty());
}

// The form of version 0.1 and that of today, in one journal; the last line is torn.
TEST_F(CampaignRecords, AnEnsembleIsReadFromItsJournal) {
  const auto evaluation = [](int replicate, double plateau, const char* status) {
    return json{{"replicate", replicate},
                {"status", status},
                {"plateau_stress", plateau},
                {"undulation", nullptr},
                {"curve", {{"strain_yy", {0.0, 0.5}}, {"stress_yy", {0.0, plateau}}}}};
  };
  journal({{{"event", "ensemble"}, {"key", "k"}},
           {{"event", "replicate"}, {"evaluation", evaluation(0, 1e5, "completed")}},
           {{"event", "evaluation"}, {"evaluation", evaluation(2, 3e5, "completed")}},
           {{"event", "evaluation"}, {"evaluation", evaluation(1, 9e5, "failed")}}});
  std::ofstream(folder_ / "journal.jsonl", std::ios::app) << "0123abcd {\"event\":\"eval";
  const SweepRecord record = read_ensemble_record(folder_);
  EXPECT_EQ(record.reason, "2 of 3 replicates completed");
  ASSERT_EQ(record.cases.size(), 1u);
  ASSERT_EQ(record.cases[0].runs.size(), 2u);
  EXPECT_EQ(record.cases[0].results.at("plateau_stress").mean, 2e5);
  EXPECT_TRUE(std::isnan(record.cases[0].runs[0].results.at("undulation")));
  EXPECT_THAT(record.cases[0].runs[1].curve.stress, ElementsAre(0.0, 3e5));
  journal({{{"event", "ensemble"}, {"key", "k"}}});
  EXPECT_THAT(refused([&] { read_ensemble_record(folder_); }), HasSubstr("no replicate"));
}

// Ratios of means: (40 + 20)/(5 + 7) = 5 and 30/10; the first point was tested at other thresholds.
TEST_F(CampaignRecords, ACalibrationThatWasKilledShowsItsPoints) {
  const auto point = [](double shear, const json& tension, const json& compression) {
    return json{{"event", "point"},     {"key", "k"},         {"rupture_delay", 1.1},
                {"shear_ratio", shear}, {"tension", tension}, {"compression", compression}};
  };
  journal({{{"event", "calibration"}},
           point(4.0, {1.0, 1.0}, {9.0, 9.0}),
           point(1.0, {5.0, 7.0}, {40.0, 20.0}),
           point(2.0, {10.0, nullptr}, {30.0, nullptr}),
           point(3.0, {nullptr, nullptr}, {30.0, 30.0})});
  const CalibrationRecord killed = read_calibration_record(folder_);
  ASSERT_EQ(killed.points.size(), 2u);
  EXPECT_EQ(killed.points[0].strength_ratio, 5.0);
  EXPECT_EQ(killed.points[1].strength_ratio, 3.0);
  EXPECT_FALSE(killed.wanted || killed.found);
  file(
      "result.json",
      R"({"schema":"perfora.calibrate/1","points":[{"rupture_delay":1.0,"shear_ratio":2.0,"strength_ratio":6.0,"of_chart":true},
          {"rupture_delay":1.0,"shear_ratio":3.0,"strength_ratio":null,"of_chart":true}],
          "targets":[{"name":"tensile_strength","wanted":2.0},{"name":"compressive_strength","wanted":16.0}],
          "found":{"critical_normal_stretch":0.5,"critical_shear_displacement":2.0}})");
  const CalibrationRecord ended = read_calibration_record(folder_);
  ASSERT_EQ(ended.points.size(), 1u);
  EXPECT_TRUE(ended.points[0].of_chart);
  EXPECT_EQ(ended.wanted, 8.0);
  EXPECT_EQ(ended.found, 4.0);
  file("result.json", "{}");
  EXPECT_THAT(refused([&] { read_calibration_record(folder_); }), HasSubstr("not the result of a calibration"));
}

TEST_F(CampaignRecords, KindsAreToldByJournalOrResult) {
  EXPECT_EQ(campaign_kind(folder_), "");
  file("ensemble.json", R"({"schema": "perfora.ensemble/1"})");
  EXPECT_EQ(campaign_kind(folder_), "ensemble");
  file("result.json", R"({"schema": "perfora.calibrate/1"})");
  EXPECT_EQ(campaign_kind(folder_), "calibration");
  journal({{{"event", "study"}}});
  EXPECT_EQ(campaign_kind(folder_), "study");
  EXPECT_EQ(campaign_title(folder_ / ""), folder_.filename().string()) << "no file is named";
}

// Twenty-three layouts side by side, each under its name, as when they were run.
TEST(RecordedSweeps, AreReadAsTheyWereDrawn) {
  SweepRecord record = read_sweep_record(fs::path(PERFORA_SOURCE_DIR) / "docs/data/patterns");
  read_sweep_runs(record);
  EXPECT_EQ(record.title, "sweep-patterns");
  for (const SweepCase& one : record.cases) {
    EXPECT_EQ(one.group + one.series, "") << one.label;
    EXPECT_EQ(one.place, one.label);
    EXPECT_EQ(static_cast<int>(one.runs.size()), one.completed) << one.label;
    for (const CaseRun& run : one.runs) EXPECT_GT(run.curve.strain.size(), 50u) << one.label;
  }
}

}  // namespace
}  // namespace perfora::results
