// What is here: files and folders of results_version 3 (data-3/, made by 16adb2838972): shown, drawn and correlated as
// before, and not continued. What is not: those of this version (test_pinned_folders.cpp, test_pinned_runs.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pinned/pinned_support.h"

namespace perfora::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string data = "data-3";

std::string then(const std::string& name) {
  return reworded(read_text(pinned("../" + data + "/answers/" + name)));
}

TEST(Version3, FilesAndFoldersAreShown) {
  const WorkFolder work(data);
  const std::pair<std::string, std::string> shown[] = {{"run", "run.h5"},
                                                       {"pack", "pack.h5"},
                                                       {"elastic", "elastic.h5"},
                                                       {"ensemble", "ensemble"},
                                                       {"study", "study"},
                                                       {"sweep", "sweep"},
                                                       {"calibration", "calibration"},
                                                       {"test", "calibration/confirmation.h5"},
                                                       {"material", "calibration/material.toml"},
                                                       {"journal-of-study", "study/journal.jsonl"}};
  for (const auto& [name, file] : shown) {
    const Outcome outcome = work.run("show " + file + " --quiet");
    EXPECT_EQ(outcome.exit_code, 0) << file << outcome.error;
    const std::string expected = then("show-" + name + ".txt");
    EXPECT_EQ(comparable_text(outcome.output, expected), comparable_text(expected, expected)) << file;
  }
  for (const std::string name : {"run", "pack", "elastic", "test"}) {
    const std::string file = name == "test" ? "calibration/confirmation.h5" : name + ".h5";
    const Outcome outcome = work.run("show " + file + " --quiet --json");
    EXPECT_EQ(differences(nlohmann::json::parse(then("show-" + name + ".json")),
                          nlohmann::json::parse(reworded(outcome.output))),
              "")
        << file;
  }
}

TEST(Version3, FilesAndFoldersAreDrawnAndCorrelated) {
  const WorkFolder work(data);
  for (const std::string what : {"run.h5", "pack.h5", "elastic.h5", "ensemble", "study", "sweep", "calibration"}) {
    const Outcome outcome = work.run("plot " + what + " -o now.png --force --quiet");
    EXPECT_EQ(outcome.exit_code, 0) << what << outcome.error;
    EXPECT_THAT(read_text(work / "now.png"), StartsWith("\x89PNG")) << what;
  }
  const Outcome outcome =
      work.run("correlate sweep sweep-fast --measures first_peak_stress,plateau_stress --quiet --json");
  EXPECT_EQ(differences(nlohmann::json::parse(then("correlate.json")), nlohmann::json::parse(outcome.output)), "");
}

// The evidence of docs/studies.
TEST(Version3, RecordedSweepsAreShownAndDrawn) {
  const WorkFolder work(data);
  for (const std::string name : {"noise", "kernels", "fidelity-coarse-cell"}) {
    std::filesystem::copy(std::filesystem::path(PERFORA_SOURCE_DIR) / "docs/data" / name, work / name);
    const Outcome shown = work.run("show " + name + " --quiet");
    EXPECT_EQ(shown.exit_code, 0) << name << shown.error;
    EXPECT_THAT(shown.output, HasSubstr("case")) << name;
    EXPECT_EQ(work.run("plot " + name + " -o now.png --force --quiet").exit_code, 0) << name;
  }
}

TEST(Version3, NothingOfItIsContinued) {
  if (const std::string why = not_here("avx2"); !why.empty()) GTEST_SKIP() << why;
  const WorkFolder work(data);
  for (const std::string command :
       {"optimize study.toml -o study --workers 1", "sweep sweep.toml -o sweep --workers 1",
        "evaluate block.toml --replicates 2 -o ensemble --set output.frame_strains=[] --set output.frames=none",
        "calibrate calibration.toml -o calibration"}) {
    const Outcome outcome = work.run(command + " --resume --threads 1 --quiet");
    EXPECT_EQ(outcome.exit_code, 1) << command;
    EXPECT_THAT(outcome.error, HasSubstr("results_version: this folder holds results of version")) << command;
    EXPECT_THAT(outcome.error, HasSubstr("shown, plotted and correlated")) << command;
  }
  EXPECT_THAT(work.run("evaluate block.toml -o run.h5 --resume --threads 1 --quiet").error,
              HasSubstr("holds a finished run of another design, strain, seed or program version"));
  EXPECT_THAT(work.run("evaluate block.toml -o unfinished.h5 --resume --threads 1 --quiet").error,
              HasSubstr("not a checkpoint that this version of perfora can read"));
}

}  // namespace
}  // namespace perfora::test
