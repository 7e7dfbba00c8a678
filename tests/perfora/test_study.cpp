// What is here: a study that asks and is told against the same study that evaluates by itself, in any order, closed and
// gone on with; answers that are refused. What is not: what a study asks (tests/optimize/search).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "perfora/study.h"
#include "tests/perfora/face_support.h"

namespace perfora {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class PublicStudy : public testing::Test {
 protected:
  void SetUp() override {
    folder.file("design.toml", optimize::small_design);
    file = folder.file("study.toml",
                       "[study]\ndesign = \"design.toml\"\nmaxeval = 3\nreplicates = 2\nfinal_replicates = 2\n"
                       "[target]\nplateau_stress = \"1 MPa\"\nwindow = [0.002, 0.008]\n"
                       "[variables]\nlayout.diameter = [\"4 mm\", \"7 mm\"]\n");
  }

  StudyOptions options(const std::string& name, bool resume = false) const {
    return {folder / name, {}, resume, false};
  }

  Campaign by_itself() const {
    CampaignOptions work;
    work.folder = folder / "by-itself";
    work.workers = work.threads = 1;
    work.best_run_file = false;
    return run_campaign(file, work);
  }

  static void expect_same(const Campaign& a, const Campaign& b) {
    EXPECT_EQ(a.status, b.status);
    ASSERT_EQ(a.rows.columns.size(), b.rows.columns.size());
    for (std::size_t k = 0; k < a.rows.columns.size(); ++k)
      EXPECT_EQ(a.rows.columns[k].texts, b.rows.columns[k].texts) << a.rows.columns[k].name;
    ASSERT_TRUE(a.best && b.best);
    EXPECT_EQ(a.best->to_toml(), b.best->to_toml());
    EXPECT_EQ(a.verdict.text, b.verdict.text);
  }

  const DesignFolder folder;
  std::filesystem::path file;
};

// Opened again and closed without a question a finished study stays finished; one that is not says who left it.
TEST_F(PublicStudy, ClosingSaysHowItStands) {
  static_cast<void>(by_itself());
  for (const bool looks : {false, true}) {
    Study study(file, options("by-itself", true));
    if (looks) {
      EXPECT_TRUE(study.finished());
    }
    EXPECT_EQ(study.close().status, Status::completed);
  }
  Study open(file, options("open"));
  static_cast<void>(open.ask(1));
  const Campaign left = open.close();
  EXPECT_EQ(left.status, Status::stopped);
  EXPECT_THAT(left.reason, HasSubstr("left open by the program that asks"));
}

TEST_F(PublicStudy, AskedAndToldIsTheStudyThatEvaluatesByItself) {
  Study study(file, options("told"));
  while (!study.finished()) {
    std::vector<Trial> trials = study.ask();
    ASSERT_FALSE(trials.empty());
    EXPECT_THAT(study.ask(), IsEmpty()) << "all were given";
    std::reverse(trials.begin(), trials.end());
    for (const Trial& trial : trials) study.tell(trial, evaluate_trial(trial.request));
  }
  expect_same(study.close(), by_itself());
  EXPECT_THAT(study.ask(), IsEmpty());
}

TEST_F(PublicStudy, ClosedOneGoesOnAndAsksNothingTwice) {
  std::string first;
  {
    Study study(file, options("parts"));
    const std::vector<Trial> trials = study.ask(1);
    ASSERT_THAT(trials, SizeIs(1));
    first = trials[0].key;
    const Evaluation evaluation = evaluate_trial(trials[0].request);
    study.tell(trials[0], Evaluation::from_json(evaluation.to_json(true)));  // as from another process
    study.tell(trials[0], evaluation);                                       // twice: left alone
  }
  EXPECT_EQ(read_campaign(folder / "parts").status, Status::stopped);
  Study study(file, options("parts", true));
  while (!study.finished())
    for (const Trial& trial : study.ask()) {
      EXPECT_NE(trial.key, first);
      study.tell(trial, evaluate_trial(trial.request));
    }
  expect_same(study.close(), by_itself());
}

TEST_F(PublicStudy, RefusesWhatIsNoAnswer) {
  Study study(file, options("told"));
  const std::vector<Trial> trials = study.ask();
  ASSERT_GE(trials.size(), 2U);
  EXPECT_EQ(study.ask(1, true)[0].key, trials[0].key);
  const Evaluation first = evaluate_trial(trials[0].request);
  EXPECT_THAT(error_of([&] { study.tell(trials[1], first); }), HasSubstr("of something else"));
  EXPECT_THAT(error_of([&] { study.tell(trials[0], Evaluation()); }), HasSubstr("not made by the library"));
  TrialOptions stopping;
  stopping.stop = std::make_shared<Stop>();
  stopping.stop->request();
  const Evaluation stopped = evaluate_trial(trials[0].request, stopping);
  EXPECT_EQ(stopped.status, Status::stopped);
  EXPECT_THAT(error_of([&] { study.tell(trials[0], stopped); }), HasSubstr("stopped"));
  EXPECT_NE(error_of([&] { Study(file, options("told", true)); }), "") << "the folder has its owner";
  static_cast<void>(study.close());
  EXPECT_THAT(error_of([&] { study.tell(trials[0], first); }), HasSubstr("closed"));
  EXPECT_THAT(error_of([&] { Study(folder / "design.toml", options("x")); }), HasSubstr("is no study"));
  EXPECT_THAT(error_of([&] { Study(file, {}); }), HasSubstr("folder"));
}

}  // namespace
}  // namespace perfora
