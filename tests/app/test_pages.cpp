// What is here: reports, layouts, films, completion and examples as a user asks for them. What is not: what stands in
// reports (tests/report), how browsers show them (tests/viewers).
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/app/command_line.h"

namespace perfora::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CommandLine, EvaluateWritesItsReport) {
  ASSERT_EQ(run("evaluate d.toml -o r.h5 --quiet").exit_code, 0);
  EXPECT_THAT(read_text(folder_ / "r.html"), HasSubstr("id=\"facts\""));
  EXPECT_EQ(run("report r.h5 -o again.html --title Block").exit_code, 0);
  EXPECT_THAT(read_text(folder_ / "again.html"), HasSubstr("<title>Block</title>"));
  const Outcome twice = run("report r.h5 -o again.html");
  EXPECT_EQ(twice.exit_code, 1);
  EXPECT_THAT(twice.error, HasSubstr("--force"));
  EXPECT_EQ(run("report r.h5 -o again.html --force").exit_code, 0);
  EXPECT_THAT(run("report d.toml -o x.html").error, HasSubstr("d.toml"));
  const Outcome film = run("movie r.h5 -o film --json");
  ASSERT_EQ(film.exit_code, 0) << film.error;
  const auto record = nlohmann::json::parse(film.output);
  EXPECT_GE(record.at("frames"), 2);
  EXPECT_TRUE(fs::exists(folder_ / "film" / "frame-0001.png"));
  EXPECT_EQ(run("movie r.h5 -o film").exit_code, 1);
  EXPECT_EQ(run("movie r.h5 -o film --force").exit_code, 0);
}

TEST_F(CommandLine, PlotDrawsADesignBeforeAnyRun) {
  EXPECT_EQ(run("plot d.toml -o layout.svg").exit_code, 0);
  EXPECT_THAT(read_text(folder_ / "layout.svg"), HasSubstr("<svg"));
}

TEST_F(CommandLine, EveryCommandHasExamples) {
  const std::string commands = run("--help").output;
  for (const char* name :
       {"pack", "evaluate", "map", "optimize", "sweep", "tolerance", "work", "ask", "tell", "correlate", "test",
        "calibrate", "check", "show", "plot", "report", "movie", "completion"}) {
    EXPECT_THAT(commands, HasSubstr(std::string("\n  ") + name));
    EXPECT_THAT(run(std::string(name) + " --help").output, HasSubstr("Examples:\n  ")) << name;
  }
}

// bash reads the script, completes with it, and its words are those of the program's help.
TEST_F(CommandLine, CompletionIsThatOfTheProgram) {
  const Outcome bash = run("completion bash");
  ASSERT_EQ(bash.exit_code, 0);
  std::ofstream(folder_ / "c.bash")
      << bash.output
      << "COMP_WORDS=(perfora evaluate --res); COMP_CWORD=2; _perfora; echo \"${COMPREPLY[@]}\"\n"
         "COMP_WORDS=(perfora opt); COMP_CWORD=1; _perfora; echo \"${COMPREPLY[@]}\"\n";
  ASSERT_EQ(std::system(("bash " + (folder_ / "c.bash").string() + " > " + (folder_ / "c.txt").string()).c_str()), 0);
  EXPECT_EQ(read_text(folder_ / "c.txt"), "--resume\noptimize\n");
  const Outcome zsh = run("completion zsh"), manual = run("completion man");
  EXPECT_THAT(zsh.output, HasSubstr("#compdef perfora"));
  EXPECT_THAT(zsh.output, Not(HasSubstr("'worker:")));
  EXPECT_THAT(manual.output, HasSubstr(".SS evaluate"));
  EXPECT_THAT(manual.output, HasSubstr("\\fB\\-\\-resume\\fR"));
  EXPECT_EQ(run("completion fish").exit_code, 1);
}

}  // namespace
}  // namespace perfora::test
