// What is here: what the machine cannot do, refused before it is begun: threads, memory, time. Expected: exit codes of
// the documentation.
#include <gmock/gmock.h>

#include "tests/app/command_line.h"

namespace perfora::test {
namespace {

using ::testing::HasSubstr;

class Limits : public CommandLine {};

TEST_F(Limits, WhatTheMachineCannotDoIsRefusedBeforehand) {
  Outcome refused = run("evaluate d.toml --threads 4096");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.error, HasSubstr("4096 is outside 1 to"));
  for (const char* command :
       {"evaluate d.toml", "evaluate d.toml --replicates 2", "evaluate d.toml --elastic", "pack d.toml"}) {
    refused = run(std::string(command) + " --memory \"1 MB\" --force");
    EXPECT_EQ(refused.exit_code, 1) << command;
    EXPECT_THAT(refused.error, HasSubstr("1 MB are allowed; packing.mean_diameter = ")) << command;
    EXPECT_THAT(refused.error, HasSubstr("--memory SIZE")) << command;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 3) << "the design and this test's own two texts";
  EXPECT_EQ(run("evaluate d.toml --quiet --memory \"1 GB\"").exit_code, 0);
  // In a campaign it is this machine's trouble, not a result of the case: with enough memory the sweep goes on.
  std::ofstream(folder_ / "s.toml") << "[sweep]\ndesign = \"d.toml\"\nreplicates = 1\n[each]\n"
                                       "layout.diameter = [\"5 mm\"]\n";
  refused = run("sweep s.toml -o s --memory \"2 MB\" --workers 2");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_THAT(refused.error, HasSubstr("2 MB are allowed"));
  EXPECT_EQ(read_text(folder_ / "s/journal.jsonl").find("\"event\":\"evaluation\""), std::string::npos);
  EXPECT_EQ(run("sweep s.toml -o s --resume --quiet").exit_code, 0);
}

TEST_F(Limits, AnEstimateBeyondCountingIsAWarning) {
  const Outcome checked = run("check d.toml --set dynamics.step_factor=1e-300 --json");
  EXPECT_EQ(checked.exit_code, 0);
  EXPECT_GT(json::parse(checked.output).at("steps").get<std::int64_t>(), std::int64_t{1'000'000'000'000});
  EXPECT_THAT(checked.error, HasSubstr("more than a year"));
}

}  // namespace
}  // namespace perfora::test
