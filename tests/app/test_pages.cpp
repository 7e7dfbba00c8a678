// What is here: reports, layouts, films, completion and examples as a user asks for them. What is not: what stands in
// reports (tests/report), how browsers show them (tests/viewers).
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

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
  EXPECT_THAT(run("evaluate d.toml -o other.h5 --resume --quiet").error, HasSubstr("no run to continue in other.h5"));
  EXPECT_THAT(run("movie r.h5 -o film.mp4").error, HasSubstr("name the folder: -o film"));
  EXPECT_EQ(run("movie r.h5 -o film --force").exit_code, 0);
}

// The title of the design, not the name of the file, stands in what is made of a run.
TEST_F(CommandLine, TitleOfTheDesignGoesWithItsRun) {
  ASSERT_EQ(run("evaluate d.toml -o r.h5 --quiet").exit_code, 0);
  EXPECT_THAT(read_text(folder_ / "r.html"), HasSubstr("<title>small</title>"));
  EXPECT_EQ(run("draw r.h5 -o r.svg --quiet").exit_code, 0);
  EXPECT_THAT(read_text(folder_ / "r.svg"), HasSubstr(">small<"));
}

// Start, first peak (where it is passed), every 5 % and the end: to 12 % strain 0, 5, 10 and 12 %.
TEST_F(CommandLine, RunFilesHoldAFrameForEveryFivePercent) {
  ASSERT_EQ(run("evaluate d.toml -o r.h5 --until 0.12 --set loading.rate=200 --quiet").exit_code, 0);
  ASSERT_EQ(run("export r.h5 --csv -o r --quiet").exit_code, 0);
  std::set<std::string> strains;
  std::istringstream lines(read_text(folder_ / "r.discs.csv"));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string frame, strain;
    std::getline(fields, frame, ',');
    std::getline(fields, strain, ',');
    strains.insert(strain.substr(0, 6));
  }
  for (const char* wanted : {"0", "0.05", "0.1", "0.12"})
    EXPECT_TRUE(std::any_of(strains.begin(), strains.end(), [&](const std::string& strain) {
      return std::abs(std::stod(strain) - std::stod(wanted)) < 1e-3;
    })) << wanted;
  EXPECT_LE(strains.size(), 5u);
}

// Each kind of file names the command it is for.
TEST_F(CommandLine, FilesOfAnotherKindNameTheirCommand) {
  std::ofstream(folder_ / "s.toml") << "[study]\ndesign = \"d.toml\"\n";
  std::ofstream(folder_ / "w.toml") << "[sweep]\ndesign = \"d.toml\"\n";
  std::ofstream(folder_ / "c.toml") << "[calibrate]\ndesign = \"d.toml\"\n";
  EXPECT_THAT(run("evaluate s.toml -o r.h5").error, HasSubstr("s.toml: this is a study: perfora optimize"));
  EXPECT_THAT(run("pack w.toml -o r.h5").error, HasSubstr("w.toml: this is a sweep: perfora sweep"));
  EXPECT_THAT(run("optimize c.toml -o o").error, HasSubstr("c.toml: this is a calibration: perfora calibrate"));
  EXPECT_THAT(run("sweep d.toml -o o").error, HasSubstr("d.toml: this is a design: perfora evaluate"));
  EXPECT_THAT(run("evaluate d.toml --until 60 -o r.h5").error, HasSubstr("did you mean 0.6, which is \"60 %\"?"));
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
