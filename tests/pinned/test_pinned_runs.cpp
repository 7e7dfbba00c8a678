// What is here: single runs against the bits of the pinned program: histories on each instruction set, a run that goes
// on from its checkpoint, files that a run leaves. What is not: work of several runs (test_pinned_folders.cpp).
#include <gtest/gtest.h>

#include <algorithm>

#include "io/hdf5.h"
#include "tests/pinned/pinned_support.h"

namespace perfora::test {
namespace {

class GoldenBits : public ::testing::TestWithParam<PinnedCommand> {};

// Every digit that a number has: equal numbers are equal bits.
TEST_P(GoldenBits, HistoryIsTheSame) {
  if (const std::string why = other_bits(GetParam().kind); !why.empty()) GTEST_SKIP() << why;
  const WorkFolder work;
  const Outcome outcome = work.run("evaluate " + GetParam().arguments + " -o now.h5 --threads 1 --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(same_digits(read_text(work / "now.csv")),
            same_digits(read_text(pinned("golden/" + GetParam().name + ".csv"))));
}

INSTANTIATE_TEST_SUITE_P(Kernels, GoldenBits, ::testing::ValuesIn(pinned_commands("golden.txt")), name_of);

TEST(GoldenHistories, DifferFromEachOther) {
  std::vector<std::string> texts;
  for (const PinnedCommand& command : pinned_commands("golden.txt"))
    texts.push_back(read_text(pinned("golden/" + command.name + ".csv")));
  for (std::size_t k = 0; k < texts.size(); ++k)
    for (std::size_t j = 0; j < k; ++j) EXPECT_NE(texts[k], texts[j]) << "a command that chooses nothing";
}

void expect_same_run(const std::filesystem::path& a, const std::filesystem::path& b) {
  const io::Hdf5Reader now(a), then(b);
  const std::vector<std::string> columns = now.children("/history");
  for (const std::string& column : then.children("/history")) {
    ASSERT_NE(std::find(columns.begin(), columns.end(), column), columns.end()) << column;
    EXPECT_EQ(now.doubles("/history/" + column), then.doubles("/history/" + column)) << column;
  }
  ASSERT_EQ(now.children("/events"), then.children("/events"));
  for (const char* name : {"time", "strain", "x", "y", "energy"}) {
    const std::string events = std::string("/events/") + name;
    EXPECT_EQ(now.doubles(events), then.doubles(events)) << name;
  }
  EXPECT_GT(then.doubles("/events/time").size(), 10u) << "past the first breaks";
  ASSERT_EQ(now.children("/frames"), then.children("/frames"));
  for (const std::string& frame : then.children("/frames"))
    for (const char* name : {"/discs/position", "/discs/angle", "/discs/damage"})
      EXPECT_EQ(now.doubles("/frames/" + frame + name), then.doubles("/frames/" + frame + name)) << frame << name;
}

TEST(PinnedRun, UnfinishedRunGoesOnFromItsCheckpoint) {
  if (const std::string why = other_bits("avx2"); !why.empty()) GTEST_SKIP() << why;
  const WorkFolder work;
  const Outcome outcome = work.run("evaluate block.toml -o unfinished.h5 --threads 1 --resume");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_NE(outcome.error.find("resum"), std::string::npos) << "not from the start: " << outcome.error;
  expect_same_run(work / "unfinished.h5", pinned("run.h5"));
  EXPECT_EQ(same_digits(read_text(work / "unfinished.csv")), same_digits(read_text(pinned("run.csv"))));
  EXPECT_FALSE(std::filesystem::exists(work / "unfinished.part"));
}

TEST(PinnedRun, RunFromTheStartWritesTheSameFiles) {
  if (const std::string why = other_bits("avx2"); !why.empty()) GTEST_SKIP() << why;
  const WorkFolder work;
  ASSERT_EQ(work.run("evaluate block.toml -o run.h5 --threads 1 --force").exit_code, 0);
  expect_same_run(work / "run.h5", pinned("run.h5"));
  for (const char* name : {"run.csv", "run.xdmf"})
    EXPECT_EQ(same_digits(read_text(work / name)), same_digits(read_text(pinned(name)))) << name;
}

TEST(PinnedRun, FinishedRunIsReadAndNotRun) {
  if (const std::string why = not_here("avx2"); !why.empty()) GTEST_SKIP() << why;
  const WorkFolder work;
  const Outcome outcome = work.run("evaluate block.toml -o run.h5 --threads 1 --resume --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto then = pinned_json("answers/show-run.json"), now = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(differences(then, now), "");
  EXPECT_EQ(now.at("performance"), then.at("performance")) << "times of then, too";
  EXPECT_EQ(read_text(work / "run.h5"), read_text(pinned("run.h5")));
}

TEST(PinnedRun, PackingFileIsTakenForThePackingOfItsDesign) {
  if (const std::string why = other_bits("avx2"); !why.empty()) GTEST_SKIP() << why;
  const WorkFolder work;
  const Outcome outcome = work.run("evaluate block.toml --packing pack.h5 -o now.h5 --threads 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(same_digits(read_text(work / "now.csv")), same_digits(read_text(pinned("run.csv"))));
}

}  // namespace
}  // namespace perfora::test
