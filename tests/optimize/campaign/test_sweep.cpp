// What is here: sweep files read to their cases; sweeps run with formulas for simulations: once a run, resumed,
// extended, their statistics against closed forms. What is not: real simulations, pictures (tests/report).
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>

#include "io/csv.h"
#include "io/journal.h"
#include "io/progress.h"
#include "optimize/campaign/sweep_result.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

std::string sweep_text(const std::string& tables, const std::string& keys = "replicates = 3") {
  return "[sweep]\ndesign = \"design.toml\"\n" + keys + "\n" + tables;
}

/// Plateau = 1e5 (horizon + replicate) + 1e4 zeta_max; fails at a horizon of 2.25.
Evaluation formula(const Request& request) {
  const solver::MaterialOptions& material = request.design->solver.material;
  const double horizon = material.horizon;
  if (horizon == 2.25) return failed_evaluation("unstable step", request.replicate);
  Evaluation evaluation = completed(request);
  evaluation.summary.plateau_stress = 1e5 * (horizon + request.replicate) + 1e4 * material.rupture_delay;
  evaluation.summary.first_peak_stress = std::nan("");
  evaluation.curve.strain_yy = {0.001, 0.002};
  evaluation.curve.stress_yy = {1.0, 2.0};
  return evaluation;
}

class SweepTest : public testing::Test {
 protected:
  StudyFolder folder;
  std::atomic<int> asked = 0;
  void SetUp() override { io::set_verbosity(io::Verbosity::quiet); }
  void TearDown() override { io::set_verbosity(io::Verbosity::normal); }

  Sweep sweep(const std::string& text, const std::vector<std::string>& only = {}) {
    return read_sweep(folder.file("sweep.toml", text), {}, only);
  }
  std::string refused(const std::string& text) {
    return input_error([&] { sweep(text); });
  }

  WorkOptions options(const std::string& name, bool resume = false, int workers = 1) {
    WorkOptions made;
    made.folder = folder / name;
    made.resume = resume;
    made.make_executor = [this, workers] {
      return make_in_process_executor(
          [this](const Request& request) {
            ++asked;
            return formula(request);
          },
          workers);
    };
    return made;
  }

  static const results::Statistic& statistic(const std::vector<results::Statistic>& all, const std::string& name) {
    for (const results::Statistic& one : all)
      if (one.name == name) return one;
    throw std::logic_error("no result " + name);
  }
};

// Walls of 15, 3, 2.5 and 2 mm at a pitch of 25 mm; two horizons are 6 x 0.5044 = 3.03 mm.
TEST_F(SweepTest, TellsEachKindOfWarningOnce) {
  const auto warnings = [&](const std::string& values) {
    std::vector<std::string> walls;
    for (const std::string& text : sweep(sweep_text("[each]\nlayout.diameter = [" + values + "]\n")).warnings)
      if (text.find("the thinnest wall") != std::string::npos) walls.push_back(text);
    return walls;
  };
  const auto thin = warnings("\"10 mm\", \"22 mm\", \"22.5 mm\", \"23 mm\"");
  ASSERT_EQ(thin.size(), 1U);
  EXPECT_TRUE(thin[0].starts_with("case 2 (diameter 22 mm): the thinnest wall")) << thin[0];
  EXPECT_TRUE(thin[0].ends_with("; 2 more cases have a warning of this kind")) << thin[0];
  EXPECT_TRUE(warnings("\"22 mm\"")[0].starts_with("the thinnest wall")) << "every case has it";
}

TEST_F(SweepTest, MakesEveryCombinationThenOneAtATime) {
  const Sweep made = sweep(sweep_text(
      "[set]\nmaterial.rupture_delay = 1.2\n[rows]\nname = [\"soft\", \"stiff\"]\nmaterial.normal_stiffness = [1e7, "
      "2e7]\nmaterial.tangential_stiffness = [4e6, 8e6]\n[grid]\nmaterial.horizon = [2, 2.5, "
      "3]\n[each]\nlayout.diameter "
      "= [\"15 mm\", \"16 mm\"]\n",
      "replicates = 2\nbase = true"));
  ASSERT_EQ(made.cases.size(), 1U + 2U * 3U + 2U);
  EXPECT_EQ(made.cases[0].number, 0);
  EXPECT_TRUE(made.cases[0].settings.empty());
  EXPECT_EQ(made.cases[1].label, "soft, horizon 2");
  EXPECT_EQ(made.cases[6].label, "stiff, horizon 3");
  EXPECT_EQ(made.cases[6].number, 6);
  EXPECT_EQ(made.cases[7].label, "diameter 15 mm");
  EXPECT_EQ(made.cases[7].group, "layout.diameter");
  EXPECT_EQ(made.runs(), 2 * 8);  // a diameter of 16 mm is the design itself
  const solver::MaterialOptions& stiff = made.cases[6].design->solver.material;
  EXPECT_EQ(stiff.normal_stiffness, 2e7);
  EXPECT_EQ(stiff.tangential_stiffness, 8e6);
  EXPECT_EQ(stiff.horizon, 3.0);
  EXPECT_EQ(stiff.rupture_delay, 1.2);
  EXPECT_EQ(made.cases[7].design->layout.diameter, 0.015);
  EXPECT_EQ(made.columns, (std::vector<std::string>{"material.normal_stiffness", "material.tangential_stiffness",
                                                    "material.horizon", "layout.diameter"}));
}

TEST_F(SweepTest, LabelsSayWhatTellsCasesApart) {
  const Sweep made = sweep(
      sweep_text("[grid]\nnoise.kind = [\"perlin\"]\nmaterial.horizon = [2, 3]\n[each]\nnoise.kind = [\"weibull\"]\n"));
  ASSERT_EQ(made.cases.size(), 3U);
  EXPECT_EQ(made.cases[0].label, "horizon 2");
  EXPECT_EQ(made.cases[2].label, "kind weibull");
  EXPECT_EQ(sweep(sweep_text("[grid]\nmaterial.horizon = [2]\n")).cases[0].label, "horizon 2");
}

TEST_F(SweepTest, TheCommandLineHasTheLastWord) {
  const auto path = folder.file("sweep.toml", sweep_text("[each]\nmaterial.horizon = [2, 3]\n"));
  const Sweep made =
      read_sweep(path, {"sweep.replicates=5", "each.material.horizon=[2.5]", "material.rupture_delay=1.3"});
  EXPECT_EQ(made.keys.replicates, 5);
  ASSERT_EQ(made.cases.size(), 1U);
  EXPECT_EQ(made.cases[0].design->solver.material.horizon, 2.5);
  EXPECT_EQ(made.cases[0].design->solver.material.rupture_delay, 1.3);
}

TEST_F(SweepTest, SaysWhatIsWrong) {
  EXPECT_NE(refused(sweep_text("[grid]\nmaterial.horizont = [2, 3]\n")).find("horizon"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[grid]\nmaterial.horizon = 2\n")).find("list"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[grid]\nmaterial.horizon = [2, -1]\n")).find("material.horizon"), std::string::npos);
  EXPECT_NE(refused(sweep_text("")).find("nothing is varied"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[rows]\nmaterial.horizon = [2, 3]\nnoise.amplitude = [1]\n")).find("equally long"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[rows]\nname = [\"a\"]\nmaterial.horizon = [2, 3]\n")).find("1 names for 2 rows"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[rows]\nmaterial.horizon = [2]\n[grid]\nmaterial.horizon = [2]\n")).find("one table"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[each]\nmaterial.horizon = [2]\n", "measures = \"plateau\"")).find("plateau_stress"),
            std::string::npos);
  EXPECT_NE(refused("[sweep]\nreplicates = 2\n[each]\nmaterial.horizon = [2]\n").find("sweep.design"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[grids]\nmaterial.horizon = [2]\n")).find("[grid]"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[[rows]]\nmaterial.horizon = 2\n")).find("one table of lists"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[each]\nmaterial.horizon = []\n")).find("empty"), std::string::npos);
  EXPECT_NE(refused(sweep_text("[rows]\nname = [\"a\", \"a\"]\nmaterial.horizon = [2, 3]\n")).find("two rows"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[set]\nmaterial.horizon = 2\n[grid]\nmaterial.horizon = [2, 3]\n")).find("varied"),
            std::string::npos);
  EXPECT_NE(refused(sweep_text("[each]\nloading.until = [0.3, 0.4]\n", "until = 0.5")).find("varied"),
            std::string::npos);
  EXPECT_NE(input_error([&] {
              read_sweep(folder.file("sweep.toml", sweep_text("[each]\nmaterial.horizon = [2, 3]\n")),
                         {"material.horizon=2.5"});
            }).find("varied"),
            std::string::npos);
  const std::string message = refused(sweep_text("[grid]\nmaterial.horizon = [2, -1]\n"));
  EXPECT_NE(message.find("sweep.toml:5"), std::string::npos) << message;
}

TEST_F(SweepTest, ACaseThatCannotBeLaidStaysInTheTable) {
  const std::string text = sweep_text("[each]\nlayout.diameter = [\"16 mm\", \"30 mm\"]\n");
  SweepRun run(sweep(text), options("out"));
  ASSERT_EQ(run.sweep().cases.size(), 2U);
  EXPECT_NE(run.sweep().cases[1].problem.find("hole"), std::string::npos) << run.sweep().cases[1].problem;
  run.run();
  EXPECT_EQ(run.status(), results::RunStatus::completed);
  EXPECT_EQ(asked, 3);
  EXPECT_TRUE(to_json(run).at("cases").at(1).at("problem").is_string());
  EXPECT_NE(refused(sweep_text("[each]\nlayout.diameter = [\"30 mm\"]\n")).find("no case can be run"),
            std::string::npos);
}

// Replicates give 1e5 (h + r) + 1e4 zeta with r = 0, 1, 2: mean 1e5 (h + 1) + 1e4 zeta, deviation 1e5; the paired
// change to the design (h = 3, zeta = 1.1) is the same in every replicate, so its interval is 0 up to rounding.
TEST_F(SweepTest, StatisticsAndPairedChanges) {
  SweepRun run(sweep(sweep_text("[each]\nmaterial.horizon = [2, 2.25]\nmaterial.rupture_delay = [2.0]\n",
                                "replicates = 3\nbase = true")),
               options("out", false, 3));
  run.run();
  const CaseResult two = case_result(run, run.sweep().cases[1]);
  EXPECT_EQ(two.completed, 3);
  EXPECT_NEAR(statistic(two.statistics, "plateau_stress").mean, 3e5 + 1.1e4, 1e-6);
  EXPECT_NEAR(statistic(two.statistics, "plateau_stress").standard_deviation, 1e5, 1e-6);
  EXPECT_NEAR(statistic(two.changes, "plateau_stress").mean, -1e5, 1e-6);
  EXPECT_NEAR(statistic(two.changes, "plateau_stress").confidence_95, 0.0, 1e-6);
  EXPECT_EQ(statistic(two.statistics, "first_peak_stress").count, 0);
  EXPECT_EQ(case_result(run, run.sweep().cases[2]).failed, 3);
  const CaseResult slow = case_result(run, run.sweep().cases[3]);
  EXPECT_NEAR(statistic(slow.changes, "plateau_stress").mean, 0.9e4, 1e-6);
  EXPECT_EQ(to_json(run).at("reason"), "9 of 12 runs completed");
}

TEST_F(SweepTest, TheSameDesignIsRunOnceAndExtendedSweepsKeepWhatTheyHave) {
  {
    // The design's horizon is 3: with base, that case is case 0 once more.
    SweepRun run(sweep(sweep_text("[each]\nmaterial.horizon = [2, 3]\n", "replicates = 2\nbase = true")),
                 options("out"));
    run.run();
    EXPECT_EQ(asked, 4);
    EXPECT_NE(run.known(run.sweep().cases[2], 1), nullptr);
  }
  EXPECT_NE(input_error([&] {
              SweepRun again(sweep(sweep_text("[each]\nmaterial.horizon = [2]\n")), options("out"));
            }).find("--resume"),
            std::string::npos);
  SweepRun more(sweep(sweep_text("[each]\nmaterial.horizon = [2, 2.5, 3]\n", "replicates = 3\nbase = true")),
                options("out", true));
  more.run();
  EXPECT_EQ(asked, 4 + 2 + 3);  // the third replicate of two designs, all of the new one
  const auto runs =
      io::read_csv(folder / "out/runs.csv", {"case", "replicate", "material.horizon", "plateau_stress"}, 100);
  ASSERT_EQ(runs.rows(), 12U);
  for (std::size_t k = 0; k < runs.rows(); ++k)
    EXPECT_NEAR(runs.columns[3][k], 1e5 * (runs.columns[2][k] + runs.columns[1][k]) + 1.1e4, 1e-3);
}

// Strain and window are no part of a run's path: such cases have one key, and each its own answer.
TEST_F(SweepTest, CasesThatDifferInStrainOrWindowAreAnsweredEach) {
  const std::string text =
      sweep_text("[each]\nloading.until = [0.45, 0.5]\nmeasures.plateau_end = [0.3]\n", "replicates = 2\nbase = true");
  for (const bool resume : {false, true}) {
    SweepRun run(sweep(text), options("out", resume));
    run.run();
    EXPECT_EQ(asked, 8) << "resumed: nothing more";
    EXPECT_EQ(run.reason(), "8 of 8 runs completed");
    const auto& cases = run.sweep().cases;
    EXPECT_EQ(cases[1].request(0).key(), cases[3].request(0).key());
    EXPECT_EQ(run.known(cases[1], 1)->summary.final_strain, 0.45);
    EXPECT_EQ(run.known(cases[2], 1)->summary.final_strain, 0.5);
    EXPECT_EQ(run.known(cases[3], 1)->summary.plateau_end, 0.3);
  }
}

// The journal of a program that knew a key less (under other names of its requests) and gave the same results is gone
// on with; one of other results is not.
TEST_F(SweepTest, AnOlderProgramsJournalIsGoneOnWith) {
  const std::string text = sweep_text("[grid]\nmaterial.horizon = [2, 2.5]\n");
  {
    SweepRun run(sweep(text), options("out"));
    run.run();
  }
  const std::vector<std::string> events = io::Journal(folder / "out/journal.jsonl").events();
  for (const bool same_results : {true, false}) {
    const std::string name = same_results ? "older" : "other";
    std::filesystem::create_directory(folder / name);
    {
      io::Journal journal(folder / name / "journal.jsonl");
      for (const std::string& event : events) {
        auto record = nlohmann::json::parse(event);
        if (record.contains("results_version") && !same_results) record["results_version"] = results_version - 1;
        if (record.contains("request")) {
          record["key"] = "older " + record["key"].get<std::string>();
          auto design = record["request"]["design"].get<std::string>();
          const std::string line = "damage_form = \"linear_damage\"\n";
          record["request"]["design"] = design.erase(design.find(line), line.size());
        }
        journal.append(record.dump());
      }
    }
    const int before = asked;
    SweepRun again(sweep(text), options(name, true));
    again.run();
    EXPECT_EQ(asked - before, same_results ? 0 : 6);
  }
}

TEST_F(SweepTest, AStopIsResumedWithTheSameResult) {
  const std::string text = sweep_text("[grid]\nmaterial.horizon = [2, 2.5]\nmaterial.rupture_delay = [1.1, 1.5]\n");
  SweepRun straight(sweep(text), options("straight", false, 2));
  straight.run();
  auto expected = to_json(straight);
  expected.erase("performance");
  int seen = 0;
  {
    io::CancellationSource source;
    WorkOptions stopping = options("stopped");
    stopping.cancellation = source.token();
    stopping.make_executor = [&] {
      return make_in_process_executor(
          [&](const Request& request) {
            if (++seen == 3) source.request();
            return formula(request);
          },
          1);
    };
    SweepRun run(sweep(text), stopping);
    run.run();
    EXPECT_EQ(run.status(), results::RunStatus::stopped);
  }
  std::ofstream(folder / "stopped/journal.jsonl", std::ios::app)
      << "0123abcd {\"event\":\"evaluation\",\"key\"";  // torn
  SweepRun again(sweep(text), options("stopped", true));
  again.run();
  auto record = to_json(again);
  record.erase("performance");
  EXPECT_EQ(record, expected);
  EXPECT_EQ(cases_csv(again), cases_csv(straight));
  EXPECT_EQ(curves_csv(again), curves_csv(straight));
}

// Chosen cases run alone, with the numbers and answers that they have among all; the others follow with --resume.
TEST_F(SweepTest, ChosenCasesAreRunFirstAndTheRestLater) {
  const std::string text = sweep_text("[each]\nmaterial.horizon = [2, 2.5]\nmaterial.rupture_delay = [1.5]\n",
                                      "replicates = 3\nbase = true");
  SweepRun straight(sweep(text), options("straight"));
  straight.run();
  const Sweep some = sweep(text, {"horizon 2.5", "delay"});
  EXPECT_EQ(some.left_out, 1);
  ASSERT_EQ(some.cases.size(), 3u);
  EXPECT_EQ(some.cases[0].number, 0);
  EXPECT_EQ(some.cases[1].number, 2);
  EXPECT_EQ(some.cases[2].number, 3);
  const int before = asked;
  {
    SweepRun first(some, options("chosen"));
    first.run();
    EXPECT_EQ(asked - before, 9);
    EXPECT_EQ(first.reason(), "9 of 9 runs completed");
    EXPECT_EQ(to_json(first)["cases"][1], to_json(straight)["cases"][2]);
  }
  SweepRun rest(sweep(text), options("chosen", true));
  rest.run();
  EXPECT_EQ(asked - before, 12);
  EXPECT_EQ(cases_csv(rest), cases_csv(straight));
}

TEST_F(SweepTest, AChoiceThatLeavesNothingToRunIsRefused) {
  const std::string rows = "[rows]\nname = [\"thin\", \"thick\"]\nlayout.diameter = [0.005, 0.03]\n";
  const std::string text = sweep_text(rows), with_base = sweep_text(rows, "base = true");
  const auto refused_choice = [&](const std::string& file, const std::string& only) {
    return input_error([&] { sweep(file, {only}); });
  };
  EXPECT_NE(refused_choice(text, "wide").find("no case has \"wide\" in its name; the names are \"thin\", \"thick\";"),
            std::string::npos);
  EXPECT_NE(refused_choice(text, "thick").find("can be run"), std::string::npos) << "its holes overlap";
  EXPECT_EQ(sweep(text).cases.size(), 2u);
  EXPECT_EQ(sweep(text, {"thin"}).warnings.size(), 0u) << "thick is not warned of where it is not chosen";
  EXPECT_EQ(sweep(with_base, {"design itself"}).cases.size(), 1u);
}

// Where a simulation may leave its file, and when it is thrown away: never what a stop left half done.
TEST_F(SweepTest, RunFilesStayOnlyWhereTheyAreWanted) {
  const std::string tables = "[each]\nmaterial.horizon = [2, 2.5]\n";
  for (const bool keep : {false, true}) {
    WorkOptions writing = options(keep ? "kept" : "dropped");
    writing.keep_run_files = keep;
    writing.make_executor = [&] {
      return make_in_process_executor(
          [&](const Request& request) {
            EXPECT_EQ(request.frames, keep);
            EXPECT_EQ(request.run_file.parent_path(), std::filesystem::absolute(writing.folder / "runs"));
            std::ofstream(request.run_file) << "run";
            Evaluation evaluation = formula(request);
            if (request.replicate == 1) evaluation.status = results::RunStatus::stopped;
            return evaluation;
          },
          1);
    };
    SweepRun run(sweep(sweep_text(tables, std::string("replicates = 2\nrun_files = ") + (keep ? "true" : "false"))),
                 writing);
    run.run();
    EXPECT_EQ(run.status(), results::RunStatus::stopped);
    const SweepCase& one = run.sweep().cases[0];
    const auto file = [&](int replicate) { return writing.folder / EvaluationQueue::run_file(one.request(replicate)); };
    EXPECT_EQ(std::filesystem::exists(file(0)), keep);
    EXPECT_TRUE(std::filesystem::exists(file(1)));
    EXPECT_EQ(runs_csv(run).find("runs/") != std::string::npos, keep);
  }
}

TEST_F(SweepTest, RefusesTheFolderOfOtherWorkAndLeavesItsFiles) {
  std::filesystem::create_directories(folder / "out");
  {
    io::Journal journal(folder / "out/journal.jsonl");
    journal.append(R"({"event":"study"})");
  }
  folder.file("out/result.json", "{}");
  const std::string text = sweep_text("[each]\nmaterial.horizon = [2]\n");
  for (const bool resume : {false, true})
    for (const bool force : {false, true}) {
      WorkOptions other = options("out", resume);
      other.force = force;
      EXPECT_NE(input_error([&] { SweepRun run(sweep(text), other); }).find("holds a study, not a sweep"),
                std::string::npos);
      EXPECT_TRUE(std::filesystem::exists(folder / "out/result.json"));
    }
  // A folder of somebody's own is none of ours.
  std::filesystem::create_directories(folder / "mine/runs");
  folder.file("mine/runs/precious.h5", "");
  WorkOptions forced = options("mine");
  forced.force = true;
  EXPECT_NE(input_error([&] { SweepRun run(sweep(text), forced); }).find("would overwrite"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "mine/runs/precious.h5"));
}

}  // namespace
}  // namespace perfora::optimize
