// What is here: what every command prints, with --json and without, against what it printed when the fixtures were
// made. What is not: work that goes on (test_pinned_folders.cpp). JSON must stay as it is; texts may be renewed on
// purpose, so they are tests of their own (PinnedTexts).
#include <gtest/gtest.h>

#include "tests/pinned/pinned_support.h"

namespace perfora::test {
namespace {

using nlohmann::json;

/// All but those of one kind.
std::vector<PinnedCommand> commands_without(const std::string& kind) {
  auto commands = pinned_commands("commands.txt");
  std::erase_if(commands, [&](const PinnedCommand& command) { return command.kind == kind; });
  return commands;
}

std::string why_not(const PinnedCommand& command) {
  return command.kind == "simulate" || command.kind == "json" ? other_bits("avx2") : not_here("avx2");
}

class PinnedAnswers : public ::testing::TestWithParam<PinnedCommand> {};

TEST_P(PinnedAnswers, JsonIsTheSame) {
  if (const std::string why = why_not(GetParam()); !why.empty()) GTEST_SKIP() << why;
  const WorkFolder work;
  const Outcome outcome = work.run(GetParam().arguments + " --quiet --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(differences(pinned_json("answers/" + GetParam().name + ".json"), json::parse(reworded(outcome.output))), "");
}

INSTANTIATE_TEST_SUITE_P(Commands, PinnedAnswers, ::testing::ValuesIn(commands_without("text")), name_of);

class PinnedTexts : public ::testing::TestWithParam<PinnedCommand> {};

TEST_P(PinnedTexts, TextIsTheSame) {
  if (const std::string why = why_not(GetParam()); !why.empty()) GTEST_SKIP() << why;
  const WorkFolder work;
  const Outcome outcome = work.run(GetParam().arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  const std::string expected = read_text(pinned("answers/" + GetParam().name + ".txt"));
  EXPECT_EQ(comparable_text(outcome.output, expected), comparable_text(expected, expected));
}

INSTANTIATE_TEST_SUITE_P(Commands, PinnedTexts, ::testing::ValuesIn(commands_without("json")), name_of);

TEST(PinnedShow, AFolderIsShownByItsResult) {
  const WorkFolder work;
  for (const std::string name :
       {"study/result.json", "study-stopped/result.json", "sweep/result.json", "sweep-stopped/result.json",
        "sweep-files/result.json", "sweep-fast/result.json", "calibration/result.json",
        "calibration-stopped/result.json", "ensemble/ensemble.json", "ensemble-stopped/ensemble.json"}) {
    const json expected = pinned_json(name);
    const Outcome file = work.run("show " + name + " --json");
    ASSERT_EQ(file.exit_code, 0) << name << file.error;
    EXPECT_EQ(json::parse(file.output), expected) << name << ": with times and memory, too";
    const Outcome whole = work.run("show " + name.substr(0, name.find('/')) + " --json");
    EXPECT_EQ(json::parse(whole.output), expected) << name;
  }
}

TEST(PinnedPictures, FilesAreDrawn) {
  const WorkFolder work;
  for (const std::string files :
       {"run.h5", "pack.h5", "elastic.h5", "calibration/confirmation.h5", "ensemble-stopped/replicate-001.h5",
        "run.h5 study/best.h5", "run.h5 study/best.h5 --collapse"}) {
    const Outcome outcome = work.run("plot " + files + " -o now.png --force");
    EXPECT_EQ(outcome.exit_code, 0) << files << outcome.error;
    EXPECT_TRUE(std::filesystem::exists(work / "now.png")) << files;
    std::filesystem::remove(work / "now.png");
  }
}

}  // namespace
}  // namespace perfora::test
