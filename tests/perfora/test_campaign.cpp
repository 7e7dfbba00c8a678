// What is here: a small sweep, an ensemble and a study of the public face: rows, stops, going on, folders read back.
// What is not: what campaigns ask and write (tests/optimize).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perfora/campaign.h"
#include "tests/perfora/face_support.h"

namespace perfora {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class PublicCampaign : public testing::Test {
 protected:
  void SetUp() override { folder.file("design.toml", optimize::small_design); }

  std::filesystem::path sweep() const {
    return folder.file("sweep.toml",
                       "[sweep]\ndesign = \"design.toml\"\n[grid]\nlayout.diameter = [\"5 mm\", \"6 mm\"]\n");
  }
  CampaignOptions options(const std::string& name) const {
    CampaignOptions made;
    made.folder = folder / name;
    made.workers = 1;
    made.threads = 1;
    return made;
  }
  const DesignFolder folder;
};

TEST_F(PublicCampaign, SweepGivesARowACaseWithTheEvaluationsNumbers) {
  const Campaign found = run_campaign(sweep(), options("out"));
  EXPECT_EQ(found.kind, "sweep");
  EXPECT_EQ(found.status, Status::completed);
  EXPECT_THAT(found.rows.texts("label"), ElementsAre("diameter 5 mm", "diameter 6 mm"));
  EXPECT_THAT(found.rows.values("layout.diameter"), ElementsAre(0.005, 0.006));
  const double alone = evaluate(small_block()).measure("plateau_stress");
  EXPECT_NEAR(found.rows.values("plateau_stress")[1] / alone, 1.0, 1e-11);  // cases.csv has twelve digits
  for (const Column& column : found.rows.columns)
    if (column.name.starts_with("plateau_stress")) {
      EXPECT_EQ(column.unit, "Pa") << column.name;
    }
  EXPECT_FALSE(found.best);
  EXPECT_THAT(error_of([&] { static_cast<void>(run_campaign(sweep(), options("out"))); }), HasSubstr("resume"));
  const Campaign read = read_campaign(folder / "out");
  EXPECT_EQ(read.record, found.record);
  EXPECT_EQ(kind_of(folder / "out"), "sweep");
  EXPECT_EQ(read_table(folder / "out/runs.csv").rows(), 2U);
}

TEST_F(PublicCampaign, CallbackStopsASweepThatThenGoesOn) {
  CampaignOptions work = options("out");
  std::int64_t most = 0;
  work.progress = [&](const Progress& progress) {
    most = std::max(most, progress.finished + progress.remaining);
    return false;
  };
  const Campaign stopped = run_campaign(sweep(), work);
  EXPECT_EQ(stopped.status, Status::stopped);
  EXPECT_EQ(most, 2);
  work.progress = {};
  work.resume = true;
  EXPECT_EQ(run_campaign(sweep(), work).status, Status::completed);
}

TEST_F(PublicCampaign, EnsembleKeepsARunFileAReplicate) {
  const Campaign found = run_ensemble(small_block(), 2, options("ensemble"));
  EXPECT_EQ(found.kind, "ensemble");
  EXPECT_EQ(found.rows.rows(), 2U);
  const auto second = read_run(folder / "ensemble/replicate-001.h5");
  EXPECT_EQ(second.evaluation.replicate, 1);
  EXPECT_EQ(found.rows.values("plateau_stress")[1], second.evaluation.measure("plateau_stress"));
}

TEST_F(PublicCampaign, StudyGivesItsBestDesign) {
  const auto study = folder.file("study.toml",
                                 "[study]\ndesign = \"design.toml\"\nmaxeval = 2\nfinal_replicates = 0\n"
                                 "[target]\nplateau_stress = \"1 MPa\"\nwindow = [0.002, 0.008]\n"
                                 "[variables]\nlayout.diameter = [\"4 mm\", \"7 mm\"]\n");
  CampaignOptions work = options("study");
  const Campaign found = run_campaign(study, work);
  EXPECT_EQ(found.status, Status::completed);
  ASSERT_TRUE(found.best);
  const double diameter = found.best->number("layout.diameter");
  EXPECT_GE(diameter, 0.004);
  EXPECT_LE(diameter, 0.007);
  EXPECT_TRUE(found.rows.has("score"));
  EXPECT_EQ(Design::from_toml(read_run(folder / "study/best.h5").design).number("layout.diameter"), diameter);
}

TEST_F(PublicCampaign, WrongInputIsAnError) {
  EXPECT_THAT(error_of([&] { static_cast<void>(run_campaign(folder / "design.toml", options("x"))); }),
              HasSubstr("is no study, sweep or calibration"));
  EXPECT_THAT(error_of([&] { static_cast<void>(run_campaign(sweep(), {})); }), HasSubstr("folder"));
  EXPECT_THAT(error_of([&] { static_cast<void>(read_campaign(folder / "none")); }), HasSubstr("no study"));
  EXPECT_NE(error_of([&] { static_cast<void>(run_ensemble(small_block(), 0, options("x"))); }), "");
}

}  // namespace
}  // namespace perfora
