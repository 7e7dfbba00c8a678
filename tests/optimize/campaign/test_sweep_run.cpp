// What is here: sweeps run with a formula for a simulation: once a run, resumed, extended, their statistics against
// closed forms. What is not: real simulations, pictures (tests/report).
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>

#include "io/csv.h"
#include "io/journal.h"
#include "tests/optimize/campaign/sweep_support.h"

namespace perfora::optimize {
namespace {

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

// Plateaus of 1e5 (3 + r) + 1e4 zeta, r = 0, 1, 2: mean 4e5 + 1e4 zeta, half of its interval 4.303/sqrt(3) 1e5 =
// 248.4 kPa (Student, two degrees of freedom). Wished 100 to 900 kPa: zeta = 1.1 gives 411 +- 248 kPa, within; 41.1
// gives 811 +- 248 kPa, across its upper end; 81.1 gives 1,211 +- 248 kPa, outside.
TEST_F(SweepTest, EveryCaseHasAVerdictWhereSomethingIsWished) {
  const std::string wish =
      "[set]\ntarget.plateau_stress = \"500 kPa\"\ntarget.tolerance = 0.8\ntarget.window = [0.08, 0.23]\n";
  SweepRun run(sweep(sweep_text(wish + "[each]\nmaterial.rupture_delay = [1.1, 41.1, 81.1]\n")), options("out"));
  run.run();
  const auto cases = to_json(run).at("cases");
  EXPECT_EQ(cases[0].at("verdict").at("outcome"), "met");
  EXPECT_EQ(cases[1].at("verdict").at("outcome"), "not shown");
  EXPECT_EQ(cases[2].at("verdict").at("outcome"), "missed");
  // Of the blocks themselves 311, 411 and 511 kPa keep it; 711 and 811, not 911; none of 1,111 and more. Clopper and
  // Pearson: all of three say at least 0.025^(1/3) of all blocks.
  const auto blocks = [&](std::size_t k) { return cases[k].at("single_blocks").at("keeping").get<int>(); };
  EXPECT_EQ(blocks(0), 3);
  EXPECT_EQ(blocks(1), 2);
  EXPECT_EQ(blocks(2), 0);
  EXPECT_NEAR(cases[0].at("single_blocks").at("probability")[0].get<double>(), std::cbrt(0.025), 1e-9);
  EXPECT_EQ(to_json(run).at("plateau_window"), nlohmann::json({0.08, 0.23})) << "of the target, not of [measures]";
  const std::string table = cases_csv(run);
  EXPECT_NE(table.find(",problem,outcome,"), std::string::npos);
  EXPECT_NE(table.find(",not shown,"), std::string::npos);
  const SweepRun begun(sweep(sweep_text("[each]\nmaterial.horizon = [2]\n")), options("other"));
  EXPECT_FALSE(case_result(begun, begun.sweep().cases[0]).judgement) << "nothing is known there";
}

// Stresses are those of grade 1 times the grade (theory.md): one simulation a replicate answers all of them.
TEST_F(SweepTest, GradesCostNoSimulation) {
  const std::string text = sweep_text("[each]\nmaterial.grade = [2, 6, 0.5]\n", "replicates = 2\nbase = true");
  for (const bool resume : {false, true}) {
    SweepRun run(sweep(text), options("out", resume));
    run.run();
    EXPECT_EQ(asked, 2) << "the design itself, two replicates";
    const auto& cases = run.sweep().cases;
    const double one = run.known(cases[0], 1)->summary.plateau_stress;
    EXPECT_EQ(run.known(cases[1], 1)->summary.plateau_stress, 2.0 * one);
    EXPECT_EQ(run.known(cases[2], 1)->summary.plateau_stress, 6.0 * one);
    EXPECT_EQ(run.known(cases[3], 1)->summary.plateau_stress, 0.5 * one);
  }
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
// on with; one of other results is refused.
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
    if (!same_results) {
      EXPECT_THROW(SweepRun(sweep(text), options(name, true)), io::InputError);
      continue;
    }
    SweepRun again(sweep(text), options(name, true));
    again.run();
    EXPECT_EQ(asked - before, 0);
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
