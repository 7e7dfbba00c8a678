// What is here: the subcommands run as a user runs them: outputs, exit codes, JSON alone on standard output, signals,
// resume. What is not: broken input (bad_input/), what the machine cannot do (test_limits.cpp). Expected: exit codes of
// the documentation, and agreement between runs that must agree.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/app/command_line.h"

namespace perfora::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(CommandLine, HelpAndVersionAreNoErrors) {
  for (const std::string command : {"", "pack", "evaluate", "map", "optimize", "sweep", "correlate", "test",
                                    "calibrate", "check", "show", "plot", "export", "draw"}) {
    const Outcome help = run(command + " --help");
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_EQ(help.error, "") << command;
    EXPECT_THAT(help.output, HasSubstr("Usage: perfora")) << command;
  }
  EXPECT_THAT(run("--version").output, StartsWith("perfora 0."));
  EXPECT_THAT(run("--help").output, ::testing::Not(HasSubstr("\n  worker"))) << "hidden";
}

TEST_F(CommandLine, UsageErrorsAreOneLineAndExitCodeOne) {
  for (const std::string arguments :
       {"", "pack", "pack d.toml more.toml", "evaluate d.toml --threads many", "evaluate d.toml --until",
        "evaluate d.toml --resume --force", "evaluate d.toml --elastic --until 0.1",
        "evaluate d.toml --elastic --resume", "evaluate d.toml --elastic --replicates 2", "plot", "--sead 3",
        "pack d.toml --seed 1.5"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_EQ(outcome.output, "") << arguments;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  }
}

TEST_F(CommandLine, PackWritesShowAndPlotRead) {
  const Outcome packed = run("pack d.toml --json -o p.h5");
  ASSERT_EQ(packed.exit_code, 0) << packed.error;
  const json record = json::parse(packed.output);
  EXPECT_EQ(record["schema"], "perfora.pack/1");
  EXPECT_EQ(record["perforations"], 1);
  EXPECT_EQ(json::parse(run("show p.h5 --json").output), record);
  EXPECT_THAT(run("show p.h5").output, HasSubstr("bonds per disc"));
  EXPECT_EQ(run("plot p.h5 -o p.png").exit_code, 0);
  EXPECT_GT(fs::file_size(folder_ / "p.png"), 1000u);
}

TEST_F(CommandLine, WithoutAnOutputANameIsTakenAndTold) {
  const Outcome packed = run("pack d.toml");
  EXPECT_EQ(packed.exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "d-packing.h5"));
  EXPECT_THAT(packed.error, HasSubstr("d-packing.h5"));
}

TEST_F(CommandLine, AnOutputThatExistsNeedsForce) {
  ASSERT_EQ(run("pack d.toml -o p.h5").exit_code, 0);
  const Outcome refused = run("pack d.toml -o p.h5");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.error, HasSubstr("--force"));
  EXPECT_EQ(run("pack d.toml -o p.h5 --force").exit_code, 0);
}

TEST_F(CommandLine, EvaluateWritesItsFilesAndPrintsOneObject) {
  const Outcome outcome = run("evaluate d.toml -o r.h5 --json --threads 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json record = json::parse(outcome.output);
  EXPECT_EQ(record["schema"], "perfora.evaluate/1");
  EXPECT_EQ(record["status"], "completed");
  EXPECT_EQ(record["performance"]["threads"], 1);
  for (const char* name : {"r.h5", "r.csv", "r.xdmf"}) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  EXPECT_FALSE(fs::exists(folder_ / "r.part"));
  EXPECT_THAT(read_text(folder_ / "r.csv"), HasSubstr("stress_yy"));
  EXPECT_EQ(json::parse(run("show r.h5 --json").output), record);
  EXPECT_EQ(run("plot r.h5 -o r.png").exit_code, 0);
  EXPECT_EQ(run("plot r.h5 ./r.h5").exit_code, 0);
  EXPECT_GT(fs::file_size(folder_ / "comparison.png"), 1000u);
  EXPECT_EQ(run("plot r.h5 r.h5 --collapse -o both.png").exit_code, 0);
  ASSERT_EQ(run("pack d.toml -o p.h5").exit_code, 0);
  const Outcome refused = run("plot r.h5 p.h5 -o never.png");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.error, HasSubstr("p.h5: several files are compared as runs"));
  EXPECT_FALSE(fs::exists(folder_ / "never.png"));
}

TEST_F(CommandLine, MeasuredCurvesStandBesideRuns) {
  std::ofstream(folder_ / "press.csv") << "strain [%], stress [MPa]\n0, 0\n1, 0.5\n2, 0.1\n";
  ASSERT_EQ(run("evaluate d.toml -o r.h5 --set output.curve=press.csv --quiet").exit_code, 0);
  const Outcome named = run("plot r.h5 -o named.png");
  EXPECT_EQ(named.exit_code, 0) << named.error;
  EXPECT_EQ(run("plot r.h5 --curve r.csv --curve press.csv -o two.png").exit_code, 0);
  EXPECT_EQ(run("plot r.h5 r.h5 --curve press.csv -o both.png").exit_code, 0);
  fs::remove(folder_ / "press.csv");
  const Outcome gone = run("plot r.h5 -o without.png");
  EXPECT_THAT(gone.error, HasSubstr("the measured curve of the design is not drawn"));
  EXPECT_NE(read_text(folder_ / "named.png"), read_text(folder_ / "without.png"));
  const Outcome refused = run("plot r.h5 --curve press.csv -o never.png");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.error, HasSubstr("press.csv: does not exist"));
  const Outcome frames = run("plot r.h5 --collapse --curve r.csv -o never.png");
  EXPECT_EQ(frames.exit_code, 1);
  EXPECT_THAT(frames.error, HasSubstr("--curve"));
  EXPECT_FALSE(fs::exists(folder_ / "never.png"));
}

TEST_F(CommandLine, ElasticAnswerInsteadOfARun) {
  const Outcome outcome = run("evaluate d.toml --elastic --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json record = json::parse(outcome.output);
  EXPECT_EQ(record["schema"], "perfora.elastic/1");
  EXPECT_GT(record["young_y"], 0.0);
  EXPECT_LT(record["young_y"], record["oedometric_modulus"]);
  EXPECT_EQ(json::parse(run("show d-elastic.h5 --json").output), record);
  EXPECT_THAT(run("show d-elastic.h5").output, HasSubstr("First yield"));
  EXPECT_EQ(run("plot d-elastic.h5 -o e.png").exit_code, 0);
  EXPECT_GT(fs::file_size(folder_ / "e.png"), 1000u);
  EXPECT_THAT(run("evaluate d.toml --elastic").error, HasSubstr("--force"));
  EXPECT_THAT(run("evaluate d.toml --elastic --replicates 2").error, HasSubstr("exclude each other"));
}

TEST_F(CommandLine, PackingFromAFileIsTheSameEvaluation) {
  ASSERT_EQ(run("pack d.toml -o p.h5 --seed 4").exit_code, 0);
  const Outcome from_file = run("evaluate d.toml -o a.h5 --json --threads 1 --seed 4 --packing p.h5");
  const Outcome made = run("evaluate d.toml -o b.h5 --json --threads 1 --seed 4");
  EXPECT_EQ(comparable(from_file.output), comparable(made.output));
  EXPECT_EQ(read_text(folder_ / "a.csv"), read_text(folder_ / "b.csv"));
}

TEST_F(CommandLine, SeedsCanBeSetApart) {
  const json whole = json::parse(run("pack d.toml --json -o a.h5 --seed 9").output)["seeds"];
  const std::string flags = " --packing-seed " + whole["packing"].dump() + " --noise-seed " + whole["noise"].dump() +
                            " --layout-seed " + whole["layout"].dump() + " --search-seed " + whole["search"].dump();
  EXPECT_EQ(json::parse(run("pack d.toml --json -o b.h5" + flags).output)["seeds"], whole);
  EXPECT_NE(json::parse(run("pack d.toml --json -o c.h5 --seed 10").output)["seeds"], whole);
}

TEST_F(CommandLine, SetAndUntilReachTheDesign) {
  const Outcome outcome = run("evaluate d.toml -o r.h5 --json --threads 1 --until '0.5 %' --set layout.diameter=5mm");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json record = json::parse(outcome.output);
  EXPECT_NEAR(record["final_strain"].get<double>(), 0.005, 1e-9);
  EXPECT_NEAR(record["thinnest_wall"].get<double>(), 0.007, 1e-12);
  EXPECT_TRUE(record["plateau_stress"].is_null());
}

TEST_F(CommandLine, AWallTimeStopsWithACheckpointAndResumeEndsTheSame) {
  const std::string command = "evaluate d.toml --json --threads 1 ";
  const Outcome stopped = run(command + "-o r.h5 --wall-time 1e-6");
  EXPECT_EQ(stopped.exit_code, 75);
  EXPECT_EQ(json::parse(stopped.output)["status"], "stopped");
  EXPECT_TRUE(fs::exists(folder_ / "r.part"));
  EXPECT_EQ(run(command + "-o r.h5").exit_code, 1) << "neither --resume nor --force";
  const Outcome resumed = run(command + "-o r.h5 --resume");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.error;
  EXPECT_FALSE(fs::exists(folder_ / "r.part"));
  EXPECT_EQ(comparable(resumed.output), comparable(run(command + "-o s.h5").output));
  EXPECT_EQ(read_text(folder_ / "r.csv"), read_text(folder_ / "s.csv"));
  const Outcome again = run(command + "-o r.h5 --resume");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(again.output, resumed.output) << "a finished run is read, not run";
}

TEST_F(CommandLine, ASignalStopsWithACheckpoint) {
  const std::string output = folder_ / "long.h5", design = folder_ / "d.toml";
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl(PERFORA_PROGRAM, "perfora", "evaluate", design.c_str(), "-o", output.c_str(), "--quiet", "--threads", "1",
            "--set", "loading.rate=0.01", "--set", "output.checkpoint_interval=0.05", nullptr);
    ::_exit(127);
  }
  for (int k = 0; k < 600 && !fs::exists(folder_ / "long.part/checkpoint.h5"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ASSERT_TRUE(fs::exists(folder_ / "long.part/checkpoint.h5"));
  ::kill(child, SIGTERM);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 75);
  EXPECT_TRUE(fs::exists(folder_ / "long.part/checkpoint.h5"));
}

TEST_F(CommandLine, ReplicatesMakeAnEnsemble) {
  const Outcome outcome = run("evaluate d.toml --replicates 2 -o e --json --threads 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json record = json::parse(outcome.output);
  EXPECT_EQ(record["schema"], "perfora.ensemble/1");
  EXPECT_EQ(record["statistics"]["plateau_stress"]["count"], 2);
  for (const char* name : {"replicate-000.h5", "replicate-001.csv", "ensemble.json", "ensemble.csv"})
    EXPECT_TRUE(fs::exists(folder_ / "e" / name)) << name;
  EXPECT_EQ(json::parse(run("show e --json").output), record);
  EXPECT_THAT(run("show e").output, HasSubstr("over the replicates"));
  EXPECT_EQ(run("evaluate d.toml --replicates 2 -o e").exit_code, 1);
  EXPECT_THAT(run("evaluate d.toml --replicates 2 -o e.h5").error, HasSubstr("written to a folder"));
  const Outcome resumed = run("evaluate d.toml --replicates 3 -o e --json --threads 1 --resume");
  EXPECT_EQ(json::parse(resumed.output)["statistics"]["plateau_stress"]["count"], 3);
  EXPECT_THAT(resumed.error, HasSubstr("was finished"));
}

TEST_F(CommandLine, CheckSaysWhatWouldRun) {
  const fs::path designs = fs::path(PERFORA_SOURCE_DIR) / "designs";
  const Outcome table1 = run("check '" + (designs / "table1.toml").string() + "' --json --threads 2");
  ASSERT_EQ(table1.exit_code, 0) << table1.error;
  const json record = json::parse(table1.output);
  EXPECT_EQ(record["kind"], "design");
  EXPECT_NEAR(record["discs"].get<double>(), 36607.0, 366.0);  // Table 1
  EXPECT_EQ(record["warnings"].size(), 0u);
  const json study = json::parse(run("check '" + (designs / "study-quick.toml").string() + "' --json").output);
  EXPECT_EQ(study["kind"], "study");
  EXPECT_GT(study["study"]["candidates"].get<int>(), 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"d.toml", "err.txt", "out.txt"})) << "check writes nothing";
}

// Two cases and the design, two replicates: tables, picture and run files appear; the same design alone gives the same
// numbers; a finished sweep resumed with one more value runs only that.
TEST_F(CommandLine, SweepGivesTablesAPictureAndGrows) {
  std::ofstream(folder_ / "s.toml") << "[sweep]\ndesign = \"d.toml\"\nreplicates = 2\nbase = true\nrun_files = true\n"
                                       "[each]\nmaterial.horizon = [2.0, 2.5]\n";
  const json check = json::parse(run("check s.toml --json").output);
  EXPECT_EQ(check["kind"], "sweep");
  EXPECT_EQ(check["sweep"]["simulations"], 6);
  const json longer = json::parse(run("check s.toml --json --set 'each.material.horizon=[2.0, 3.5]'").output);
  EXPECT_EQ(longer["sweep"]["described_case"], 2) << "the longest horizon has the most bonds";
  EXPECT_GT(longer["bonds"], check["bonds"]);
  EXPECT_EQ(json::parse(run("check s.toml --only 2.5 --only none --json").output)["sweep"]["simulations"], 4);
  const Outcome outcome = run("sweep s.toml -o out --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json record = json::parse(outcome.output);
  ASSERT_EQ(record["cases"].size(), 3u);
  EXPECT_EQ(record["cases"][1]["settings"]["material.horizon"], 2.0);
  for (const char* name : {"cases.csv", "runs.csv", "curves.csv", "result.json", "sweep.png"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "out/runs"), {}), 6);
  const json alone = json::parse(run("evaluate d.toml -o r.h5 --json --set material.horizon=2").output);
  std::ifstream runs(folder_ / "out/runs.csv");
  std::string line;
  while (std::getline(runs, line) && !line.starts_with("1,\"horizon 2\",2.0,0,completed")) {
  }
  EXPECT_THAT(line, HasSubstr(fmt::format(",{:.12g},", alone["plateau_stress"].get<double>())));
  const Outcome grown = run("sweep s.toml -o out --resume --json --set 'each.material.horizon=[2.0, 2.5, 2.8]'");
  ASSERT_EQ(grown.exit_code, 0) << grown.error;
  EXPECT_EQ(json::parse(grown.output)["cases"].size(), 4u);
  EXPECT_THAT(grown.error, HasSubstr("run 8 of 8"));
  EXPECT_THAT(grown.error, ::testing::Not(HasSubstr("run 6 of 8")));
  EXPECT_THAT(run("show out").output, HasSubstr("horizon 2.8"));
  const Outcome itself = run("correlate out out --only horizon -o c.png --json");
  ASSERT_EQ(itself.exit_code, 0) << itself.error;
  EXPECT_EQ(json::parse(itself.output)["sweeps"][0]["measures"]["plateau_stress"]["rank_correlation"], 1.0);
  EXPECT_TRUE(fs::exists(folder_ / "c.png"));
  EXPECT_EQ(run("correlate out d.toml").exit_code, 1);
  EXPECT_THAT(run("correlate out out --measures plateau_stres").error, HasSubstr("did you mean plateau_stress"));
  EXPECT_THAT(run("correlate out out --measures plateau").error, HasSubstr("did you mean plateau_stress"));
  EXPECT_EQ(run("correlate out out --measures ''").exit_code, 1);
}

TEST_F(CommandLine, QuietLeavesResultsAndWarnings) {
  const Outcome outcome = run("pack d.toml --quiet -o p.h5");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.error, "");
  EXPECT_THAT(outcome.output, HasSubstr("bonds per disc"));
}

TEST_F(CommandLine, AWorkerAnswersLineByLine) {
  const json bad = {{"design", "[layout]\ndiameter = \"24 mm\"\n"}, {"replicate", 1}, {"until", 0.0}};
  const json good = {{"design", read_text(folder_ / "d.toml")}, {"replicate", 0}, {"until", 0.002}};
  std::ofstream(folder_ / "requests") << bad.dump() << "\n" << good.dump() << "\n";
  const Outcome outcome = run("worker --quiet < requests");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  std::istringstream lines(outcome.output);
  std::string first, second, rest;
  std::getline(lines, first);
  std::getline(lines, second);
  EXPECT_EQ(json::parse(first)["status"], "failed");
  EXPECT_EQ(json::parse(first)["replicate"], 1);
  EXPECT_EQ(json::parse(second)["status"], "completed");
  EXPECT_GT(json::parse(second)["curve"]["strain_yy"].size(), 2u);
  EXPECT_FALSE(std::getline(lines, rest));
}

// A small sample: 6 mm of discs of 0.5 mm, horizon 2. The record names what was asked for; file and picture appear.
TEST_F(CommandLine, TestOfAMaterialGivesRecordFileAndPicture) {
  const std::string small = " --set test.size=6mm --set material.horizon=2 --set loading.transits=5";
  const Outcome outcome = run("test d.toml -o t.h5 --json --set test.shear=false --set test.oedometric=false" + small);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json record = json::parse(outcome.output);
  EXPECT_EQ(record.at("schema"), "perfora.test/1");
  ASSERT_EQ(record.at("tests").size(), 2u);
  EXPECT_GT(record.at("material").at("compressive_strength").at("mean").get<double>(),
            record.at("material").at("tensile_strength").at("mean").get<double>());
  EXPECT_FALSE(record.at("material").contains("shear_strength"));
  EXPECT_TRUE(fs::exists(folder_ / "t.h5") && fs::exists(folder_ / "t.png"));
  EXPECT_EQ(run("test d.toml -o t.h5 --quiet" + small).exit_code, 1) << "exists";
  EXPECT_EQ(json::parse(run("show t.h5 --json").output).at("material"), record.at("material"));
  EXPECT_EQ(run("plot t.h5 -o again.png --title \"My mortar\"").exit_code, 0);
}

// Killed after its first points and resumed, a calibration ends with the numbers of one that was not; only the first
// pair of strengths is asked for, coarsely, so that it takes seconds. E is met: it is solved for.
TEST_F(CommandLine, CalibrationResumesFromItsJournal) {
  std::ofstream(folder_ / "c.toml") << "[calibrate]\ndesign = \"d.toml\"\nyoung_modulus = \"1 GPa\"\n"
                                       "poisson_ratio = 0.2\ntensile_strength = \"0.5 MPa\"\n"
                                       "compressive_strength = \"2 MPa\"\nmaxeval = 4\nreplicates = 1\nchart = false\n"
                                       "tolerance = 0.2\n";
  const std::string small = " --set test.size=6mm --set material.horizon=2 --set loading.transits=5 --json";
  const Outcome whole = run("calibrate c.toml -o whole" + small);
  ASSERT_EQ(whole.exit_code, 0) << whole.error;
  const json record = json::parse(whole.output);
  EXPECT_EQ(record.at("schema"), "perfora.calibrate/1");
  for (const json& target : record.at("targets")) {
    if (target.at("name") == "young_modulus") {
      EXPECT_TRUE(target.at("met").get<bool>()) << target;
    }
  }
  EXPECT_TRUE(fs::exists(folder_ / "whole" / "material.toml") && fs::exists(folder_ / "whole" / "confirmation.png"));
  EXPECT_EQ(run("check whole/material.toml").exit_code, 0);
  // It ends with the lines that hand the material to another design.
  const Outcome told = run("calibrate c.toml -o whole --resume" + small.substr(0, small.find(" --json")));
  ASSERT_EQ(told.exit_code, 0) << told.error;
  const std::string lines = "[material]\nfrom = \"whole/calibrated.toml\"\n";
  EXPECT_TRUE(told.output.ends_with(lines)) << told.output;
  std::ofstream(folder_ / "m.toml") << "[cell]\nwidth = \"12 mm\"\nheight = \"12 mm\"\n[layout]\nrows = 1\ncolumns = "
                                       "1\ndiameter = \"6 mm\"\n"
                                    << lines;
  EXPECT_EQ(run("check m.toml").exit_code, 0);
  EXPECT_EQ(run("calibrate c.toml -o whole" + small).exit_code, 1) << "exists";
  // Cut the journal after its second point, as a kill there would leave it.
  fs::create_directory(folder_ / "cut");
  std::ifstream journal(folder_ / "whole" / "journal.jsonl");
  std::ofstream shorter(folder_ / "cut" / "journal.jsonl");
  std::string line;
  for (int k = 0; k < 3 && std::getline(journal, line); ++k) shorter << line << "\n";
  shorter.close();
  const Outcome resumed = run("calibrate c.toml -o cut --resume" + small);
  ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
  EXPECT_EQ(json::parse(resumed.output).at("found"), record.at("found"));
  EXPECT_EQ(json::parse(resumed.output).at("points"), record.at("points"));
}

}  // namespace
}  // namespace perfora::test
