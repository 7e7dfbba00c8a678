// What is here: folders of work as the pinned program left them, gone on with: finished ones answer without a new
// evaluation, stopped ones end as the finished ones did. What is not: single runs, earlier results
// (test_pinned_version_3.cpp).
#include <gtest/gtest.h>

#include <set>

#include "io/hdf5.h"
#include "tests/pinned/pinned_support.h"

namespace perfora::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Work {
  std::string folder, command, result;
  std::vector<std::string> files;
};

void PrintTo(const Work& work, std::ostream* out) {
  *out << work.folder;
}

std::string name_of_work(const ::testing::TestParamInfo<Work>& work) {
  return work.param.folder;
}

const Work works[] = {
    {"ensemble",
     "evaluate block.toml --replicates 2 --set output.frame_strains=[] --set output.frames=none --threads 1",
     "ensemble.json",
     {"replicate-001.csv", "ensemble.csv"}},
    {"study",
     "optimize study.toml --workers 1 --threads 1",
     "result.json",
     {"best.toml", "best.csv", "evaluations.csv"}},
    {"sweep", "sweep sweep.toml --workers 1 --threads 1", "result.json", {"cases.csv", "curves.csv", "runs.csv"}},
    {"calibration", "calibrate calibration.toml --threads 1", "result.json", {"material.toml", "reachable.csv"}}};

/// The same bytes; of a table all but seconds and measures learned since.
void expect_same_file(const fs::path& now, const fs::path& then) {
  const std::string expected = reworded(read_text(then)), found = read_text(now);
  if (then.extension() == ".csv")
    EXPECT_EQ(comparable_table(found, expected), comparable_table(expected, expected)) << now;
  else
    EXPECT_EQ(same_digits(found), same_digits(expected)) << now;
}

/// The outcome of `folder` (in the work folder) against the pinned, finished one.
void expect_as_finished(const WorkFolder& work, const std::string& folder, const Work& what, const Outcome& outcome) {
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json expected = pinned_json(what.folder + "/" + what.result);
  EXPECT_EQ(differences(expected, json::parse(outcome.output)), "") << "printed";
  EXPECT_EQ(differences(expected, json::parse(read_text(work / (folder + "/" + what.result)))), "") << what.result;
  for (const std::string& name : what.files)
    expect_same_file(work / (folder + "/" + name), pinned(what.folder + "/" + name));
  std::vector<std::string> asked = finished_in(work / folder), before = finished_in(pinned(what.folder));
  EXPECT_EQ(std::set(asked.begin(), asked.end()), std::set(before.begin(), before.end()));
  EXPECT_EQ(asked.size(), before.size()) << "none twice";
}

/// Everything that stood in the journal still stands there, as it was.
void expect_kept_journal(const fs::path& before, const fs::path& after) {
  const auto old_lines = journal_lines(before), new_lines = journal_lines(after);
  ASSERT_GE(new_lines.size(), old_lines.size());
  for (std::size_t k = 0; k < old_lines.size(); ++k) EXPECT_EQ(new_lines[k], old_lines[k]) << "line " << k + 1;
}

class PinnedFolders : public ::testing::TestWithParam<Work> {};

TEST_P(PinnedFolders, FinishedWorkAnswersWithoutANewEvaluation) {
  // A calibration tests its material once more at the end.
  const std::string why = GetParam().folder == "calibration" ? other_bits("avx2") : not_here("avx2");
  if (!why.empty()) GTEST_SKIP() << why;
  const WorkFolder work;
  const Outcome outcome = work.run(GetParam().command + " -o " + GetParam().folder + " --resume --json --quiet");
  expect_as_finished(work, GetParam().folder, GetParam(), outcome);
  expect_kept_journal(pinned(GetParam().folder), work / GetParam().folder);
  EXPECT_EQ(finished_in(pinned(GetParam().folder)), finished_in(work / GetParam().folder));
}

TEST_P(PinnedFolders, StoppedWorkEndsAsIfItHadNotBeenStopped) {
  if (const std::string why = other_bits("avx2"); !why.empty()) GTEST_SKIP() << why;
  const std::string folder = GetParam().folder + "-stopped";
  const std::size_t known = finished_in(pinned(folder)).size(), all = finished_in(pinned(GetParam().folder)).size();
  ASSERT_GT(known, 0u);
  ASSERT_LT(known, all) << "something is left to do";
  const WorkFolder work;
  const Outcome outcome = work.run(GetParam().command + " -o " + folder + " --resume --json --quiet");
  expect_as_finished(work, folder, GetParam(), outcome);
  expect_kept_journal(pinned(folder), work / folder);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PinnedFolders, ::testing::ValuesIn(works), name_of_work);

TEST(PinnedFiles, KeptRunFilesOfASweepAreNotMadeAgain) {
  if (const std::string why = not_here("avx2"); !why.empty()) GTEST_SKIP() << why;
  const WorkFolder work;
  const Outcome outcome = work.run("sweep sweep-files.toml -o sweep-files --workers 1 --resume --json --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(differences(pinned_json("sweep-files/result.json"), json::parse(outcome.output)), "");
  for (const std::string name : {"cases.csv", "runs.csv", "curves.csv"})
    expect_same_file(work / ("sweep-files/" + name), pinned("sweep-files/" + name));
  EXPECT_EQ(finished_in(work / "sweep-files"), finished_in(pinned("sweep-files")));
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(work / "sweep-files/runs")) {
    const std::string name = entry.path().filename();
    EXPECT_EQ(read_text(entry.path()), read_text(pinned("sweep-files/runs/" + name))) << name;
    ++files;
  }
  EXPECT_EQ(files, 1u);
}

// The material tests of a calibration, curve by curve.
TEST(PinnedFiles, ConfirmationOfACalibrationIsTheSame) {
  if (const std::string why = other_bits("avx2"); !why.empty()) GTEST_SKIP() << why;
  const WorkFolder work;
  ASSERT_EQ(work.run("calibrate calibration.toml --threads 1 -o calibration-stopped --resume --quiet").exit_code, 0);
  const io::Hdf5Reader now(work / "calibration-stopped/confirmation.h5"), then(pinned("calibration/confirmation.h5"));
  ASSERT_EQ(now.children("/tests"), then.children("/tests"));
  EXPECT_FALSE(then.children("/tests").empty());
  for (const std::string& test : then.children("/tests"))
    for (const std::string& column : then.children("/tests/" + test + "/curve")) {
      const std::string name = "/tests/" + test + "/curve/" + column;
      EXPECT_EQ(now.doubles(name), then.doubles(name)) << name;
    }
}

}  // namespace
}  // namespace perfora::test
