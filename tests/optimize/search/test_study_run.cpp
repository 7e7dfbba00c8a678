// What is here: studies in their folder: killed at every evaluation and resumed they end with the same record; refused
// folders; result files. What is not: real simulations (tests/verification).
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <set>

#include "io/files.h"
#include "io/journal.h"
#include "io/progress.h"
#include "optimize/search/study_record.h"
#include "optimize/search/study_result.h"
#include "optimize/search/study_run.h"
#include "tests/optimize/search/study_support.h"
#include "tests/support/thinned.h"

namespace perfora::optimize {
namespace {

const char* const keys =
    "maxeval = 8\nreplicates = 2\nfinal_replicates = 3\nrefine = \"LN_SBPLX\"\nrefine_maxeval = 3\nalgorithm = "
    "\"GN_DIRECT_L\"";
const char* const arms = "rows = [1, 2]";

class StudyRunTest : public testing::Test {
 protected:
  StudyFolder folder;
  void SetUp() override { io::set_verbosity(io::Verbosity::quiet); }
  void TearDown() override { io::set_verbosity(io::Verbosity::normal); }

  Study study(const std::string& text = study_text(keys, arms)) { return read_study(folder.file("study.toml", text)); }

  WorkOptions options(const std::string& name, Evaluate evaluate = fake_with_failures, int workers = 1) {
    WorkOptions made;
    made.folder = folder / name;
    made.make_executor = [evaluate, workers] { return make_in_process_executor(evaluate, workers); };
    return made;
  }

  /// The record of a study run to its end without what is allowed to differ.
  static nlohmann::json finish(StudyRun& run) {
    run.run();
    nlohmann::json record = to_json(run);
    record.erase("performance");
    return record;
  }
};

TEST_F(StudyRunTest, WorkersDoNotChangeTheResult) {
  nlohmann::json first;
  for (const int workers : {1, 2, 4}) {
    StudyRun run(study(), options("workers-" + std::to_string(workers), fake_with_failures, workers));
    const auto record = finish(run);
    if (first.is_null()) first = record;
    EXPECT_EQ(record, first);
  }
  EXPECT_EQ(first.at("status"), "completed");
}

// What people see while it runs: stage, best and verdict so far.
TEST_F(StudyRunTest, SaysHowItStands) {
  WorkOptions watched = options("watched", fake_evaluation);
  std::set<std::string> stages;
  std::string last;
  watched.progress = [&](const WorkProgress& progress) {
    last = progress.standing;
    const std::string stage = last.substr(0, last.find(','));
    stages.insert(stage);
    if (stage == "search" && last != stage) {
      EXPECT_NE(last.find(", best so far: "), std::string::npos) << last;
    }
  };
  StudyRun run(study(), watched);
  run.run();
  EXPECT_TRUE(stages.contains("search"));
  EXPECT_TRUE(stages.contains("verification"));
  EXPECT_NE(last.find(", recommended: "), std::string::npos) << last;
  EXPECT_NE(last.find(", verdict so far: "), std::string::npos) << last;
}

// Pictures and tables show the blocks that the verdict speaks of, and a fidelity that misleads is told.
TEST_F(StudyRunTest, ShowsTheVerificationAndTellsABiasedFidelity) {
  const auto evaluate = [](const Request& request) {
    Evaluation evaluation = fake_evaluation(request);
    if (request.fidelity != "coarse") evaluation.summary.plateau_stress *= 2.0;
    return evaluation;
  };
  const std::string text = study_text("fidelity = \"coarse\"\nmaxeval = 6\nreplicates = 1\nfinal_replicates = 3") +
                           "[fidelity.coarse]\n\"loading.transits\" = 12\n";
  StudyRun run(study(text), options("biased", evaluate));
  const nlohmann::json record = finish(run);
  const results::StudyRecord shown = study_record(run);
  EXPECT_EQ(shown.best.size(), 3U) << "the three blocks of the verification";
  EXPECT_EQ(shown.best_plateau, record.at("finals").at("best").at("mean").get<double>());
  EXPECT_NE(shown.subtitle.find("searched at coarse, verified at the design as it stands"), std::string::npos);
  const std::string told = record.at("remarks").dump();
  EXPECT_NE(told.find("coarse, gives 0.5 times the verified plateau"), std::string::npos) << told;
}

// A choice that is true or false is told as such.
TEST_F(StudyRunTest, TellsChoicesOfTheBestDesign) {
  StudyRun run(
      study(study_text("maxeval = 4\nreplicates = 1\nfinal_replicates = 0", "herringbone = [true]\nrows = [2]")),
      options("choices", fake_evaluation));
  const nlohmann::json best = finish(run).at("best");
  EXPECT_EQ(best.at("layout.herringbone"), true);
  EXPECT_EQ(best.at("layout.rows"), 2);
}

// A wish that the start keeps is not out of reach, whatever the candidates of the search gave.
TEST_F(StudyRunTest, WhatTheStartReachedIsNotOutOfReach) {
  const auto outcome = [&](const std::string& name, double peak_of_start) {
    const auto evaluate = [peak_of_start](const Request& request) {
      Evaluation evaluation = fake_evaluation(request);
      const bool start = std::abs(request.design->layout.diameter - 0.016) < 1e-9;
      evaluation.summary.first_peak_stress = start ? peak_of_start : 1e6;
      return evaluation;
    };
    std::string text = study_text("maxeval = 8\nreplicates = 2\nfinal_replicates = 3\nalgorithm = \"GN_DIRECT_L\"");
    const std::string target = "plateau_stress = \"0.2 MPa\"\n";
    text.replace(text.find(target), target.size(), target + "limit.first_peak_stress = \"0.4 MPa\"\n");
    StudyRun run(study(text), options(name, evaluate));
    return finish(run).at("verdict").at("outcome").get<std::string>();
  };
  EXPECT_EQ(outcome("kept", 3e5), "missed");
  EXPECT_EQ(outcome("broken", 9e5), "out of reach");
}

TEST_F(StudyRunTest, ChildProcessesGiveWhatThisProcessGives) {
  StudyRun here(study(), options("here", fake_evaluation));
  WorkOptions children = options("children");
  children.make_executor = [this] {
    ChildOptions made;
    made.command = {PERFORA_FAKE_WORKER, "formula", (folder / "").string()};
    made.workers = 2;
    return make_child_executor(made);
  };
  StudyRun there(study(), children);
  EXPECT_EQ(finish(there), finish(here));
}

TEST_F(StudyRunTest, KilledAtEveryEvaluationItEndsWithTheSameRecord) {
  StudyRun straight(study(), options("straight"));
  const auto expected = finish(straight);
  const int evaluations = expected.at("evaluations").get<int>();
  ASSERT_GT(evaluations, 20);
  for (int kill_at = 1; kill_at <= evaluations; kill_at += test::thinned(3, 11)) {
    const std::string name = "killed-" + std::to_string(kill_at);
    const pid_t child = ::fork();
    if (child == 0) {
      int count = 0;
      WorkOptions dying = options(name);
      dying.make_executor = [&] {
        return make_calling_executor([&](const Request& request) {
          if (++count == kill_at) ::kill(::getpid(), SIGKILL);
          return fake_with_failures(request);
        });
      };
      StudyRun run(study(), dying);
      run.run();
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    int asked = 0;
    WorkOptions again = options(name, [&](const Request& request) {
      ++asked;
      return fake_with_failures(request);
    });
    again.resume = true;
    StudyRun resumed(study(), again);
    EXPECT_EQ(finish(resumed), expected) << kill_at;
    EXPECT_EQ(asked, evaluations - (kill_at - 1)) << "nothing is evaluated twice";
  }
}

TEST_F(StudyRunTest, ATornLastLineCostsOneEvaluation) {
  WorkOptions first = options("torn");
  nlohmann::json expected;
  {
    StudyRun run(study(), first);
    expected = finish(run);
  }
  const std::string whole = io::read_file(folder / "torn/journal.jsonl");
  for (const double fraction : {0.2, 0.5, 0.77, 0.999}) {
    std::ofstream(folder / "torn/journal.jsonl", std::ios::binary | std::ios::trunc)
        << whole.substr(0, static_cast<std::size_t>(fraction * static_cast<double>(whole.size())));
    WorkOptions again = options("torn");
    again.resume = true;
    StudyRun run(study(), again);
    EXPECT_EQ(finish(run), expected) << fraction;
  }
}

TEST_F(StudyRunTest, AStopIsNotedAndCanBeResumed) {
  StudyRun straight(study(), options("straight"));
  const auto expected = finish(straight);
  int seen = 0;
  io::CancellationSource source;
  WorkOptions stopping = options("stopped", [&](const Request& request) {
    if (++seen == 8) source.request();
    return fake_with_failures(request);
  });
  stopping.cancellation = source.token();
  {
    StudyRun run(study(), stopping);
    run.run();
    EXPECT_EQ(run.status(), results::RunStatus::stopped);
    EXPECT_LT(run.answers().size(), expected.at("evaluations").get<std::size_t>());
    EXPECT_EQ(to_json(run).at("status"), "stopped");
  }
  EXPECT_NE(io::read_file(folder / "stopped/journal.jsonl").find("\"event\":\"stop\""), std::string::npos);
  WorkOptions again = options("stopped");
  again.resume = true;
  StudyRun run(study(), again);
  EXPECT_EQ(finish(run), expected);
}

TEST_F(StudyRunTest, AStoppedEvaluationIsNoAnswer) {
  StudyRun run(study(), options("half", [](const Request& request) {
                 Evaluation evaluation = fake_evaluation(request);
                 evaluation.status = results::RunStatus::stopped;
                 return evaluation;
               }));
  run.run();
  EXPECT_EQ(run.status(), results::RunStatus::stopped);
  EXPECT_TRUE(run.answers().empty());
}

TEST_F(StudyRunTest, AFinishedStudyResumedAsksNothing) {
  StudyRun run(study(), options("done"));
  const auto expected = finish(run);
  WorkOptions again = options("done2");
  std::filesystem::create_directories(folder / "done2");
  std::filesystem::copy_file(folder / "done/journal.jsonl", folder / "done2/journal.jsonl");
  again.resume = true;
  again.make_executor = []() -> std::unique_ptr<Executor> {
    ADD_FAILURE() << "something was asked";
    return nullptr;
  };
  StudyRun resumed(study(), again);
  EXPECT_EQ(finish(resumed), expected);
}

TEST_F(StudyRunTest, MoreCandidatesGoOnWhereFewerEnded) {
  const auto with = [](int maxeval) {
    return study_text("maxeval = " + std::to_string(maxeval) + "\nfinal_replicates = 0\nalgorithm = \"GN_CRS2_LM\"");
  };
  StudyRun straight(study(with(45)), options("straight"));
  const auto expected = finish(straight);
  {
    StudyRun run(study(with(20)), options("grown"));
    run.run();
  }
  WorkOptions again = options("grown");
  again.resume = true;
  StudyRun run(study(with(45)), again);
  EXPECT_EQ(finish(run), expected);
}

TEST_F(StudyRunTest, RefusesAFolderInUseAndAnotherStudy) {
  {
    StudyRun run(study(), options("out"));
    run.run();
    EXPECT_NE(input_error([&] {
                WorkOptions second = options("out");
                second.resume = true;
                StudyRun other(study(), second);
              }).find("in use"),
              std::string::npos);
  }
  EXPECT_NE(input_error([&] { StudyRun again(study(), options("out")); }).find("--resume"), std::string::npos);
  WorkOptions resume = options("out");
  resume.resume = true;
  const auto refused = [&](const std::string& text) {
    return input_error([&] { StudyRun other(study(text), resume); });
  };
  EXPECT_NE(refused(study_text(std::string(keys) + "\nxtol = 0.1", arms)).find("study.xtol"), std::string::npos);
  EXPECT_NE(refused(study_text(keys, "rows = [2]")).find("arms"), std::string::npos);
  const std::string longer = [] {
    std::string text = study_text(keys, arms);
    return text.replace(text.find("0.45"), 4, "0.50");
  }();
  const std::string message = refused(longer);
  EXPECT_NE(message.find("until"), std::string::npos) << message;
  EXPECT_NE(message.find("0.45"), std::string::npos) << message;
  EXPECT_NE(message.find("one has 0.5;"), std::string::npos) << message;
  WorkOptions force = options("out");
  force.force = true;
  StudyRun fresh(study(longer), force);
  EXPECT_TRUE(fresh.answers().empty());
}

TEST_F(StudyRunTest, RefusesADesignThatChangedBehindIt) {
  {
    StudyRun run(study(), options("out"));
    run.run();
  }
  std::ofstream(folder / "design.toml", std::ios::app) << "[material]\nhorizon = 2.5\n";
  WorkOptions resume = options("out");
  resume.resume = true;
  EXPECT_NE(input_error([&] { StudyRun other(study(), resume); }).find("design.material.horizon"), std::string::npos);
}

// A curve to draw beside the results, frames and checkpoints change no run and no search.
TEST_F(StudyRunTest, WhatIsOnlyDrawnOrWrittenMayChangeBehindIt) {
  const auto expected = [&] {
    StudyRun run(study(), options("out"));
    return finish(run);
  }();
  folder.file("press.csv", "strain,stress\n0,0\n0.1,1e6\n");
  std::ofstream(folder / "design.toml", std::ios::app)
      << "[output]\ncurve = \"press.csv\"\nframes = \"none\"\n[material]\ncharacteristic_length = \"8 mm\"\n";
  WorkOptions resume = options("out");
  resume.resume = true;
  StudyRun again(study(), resume);
  EXPECT_EQ(finish(again), expected);
}

TEST_F(StudyRunTest, GoesOnWithTheJournalOfAProgramThatKnewAKeyLess) {
  const auto expected = [&] {
    StudyRun run(study(), options("out"));
    return finish(run);
  }();
  const std::vector<std::string> events = io::Journal(folder / "out/journal.jsonl").events();
  std::filesystem::create_directory(folder / "older");
  {
    io::Journal journal(folder / "older/journal.jsonl");
    for (const std::string& event : events) {
      auto record = nlohmann::json::parse(event);
      if (record.contains("resolved")) record["resolved"].erase("design.material.damage_form");
      journal.append(record.dump());
    }
  }
  WorkOptions resume = options("older");
  resume.resume = true;
  StudyRun again(study(), resume);
  EXPECT_EQ(finish(again), expected);
}

TEST_F(StudyRunTest, WritesABestDesignThatReadsBack) {
  StudyRun run(study(), options("out"));
  const auto record = finish(run);
  const DesignFile best(folder / "out/best.toml");
  EXPECT_EQ(best.design().layout.diameter, record.at("best").at("layout.diameter").get<double>());
  EXPECT_EQ(best.design().layout.rows, record.at("best").at("layout.rows").get<int>());
  EXPECT_EQ(best.design().measures.plateau_end, 0.4);
  EXPECT_TRUE(best.validate().size() < 10);
  const auto written = nlohmann::json::parse(io::read_file(folder / "out/result.json"));
  EXPECT_EQ(written.at("schema"), "perfora.optimize/1");
  for (const char* key : {"status", "reason", "seeds", "results_version", "best", "score", "plateau_stress", "target",
                          "evaluations", "stop_reason", "performance"})
    EXPECT_TRUE(written.contains(key)) << key;
  EXPECT_TRUE(written.at("finals").at("significant").get<bool>());
}

TEST_F(StudyRunTest, WritesOneLineAPoint) {
  StudyRun run(study(), options("out"));
  finish(run);
  const std::string text = io::read_file(folder / "out/evaluations.csv");
  // A head, the start, eight candidates of the arms, at most three of the second stage.
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_GE(lines, 10);
  EXPECT_LE(lines, 13);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.substr(0, 55), "stage,arm,number,layout.diameter,layout.jitter,status,v");
}

TEST(CoarseCurve, AveragesOverStepsOfStrain) {
  results::History history;
  for (int k = 0; k < 100; ++k) {
    history.strain_yy.push_back(0.00025 + 0.0005 * k);  // Ten rows a step of 0.5 %.
    history.stress_yy.push_back(k);
  }
  const auto coarse = results::coarse_curve(history);
  ASSERT_EQ(coarse.rows(), 60U + 4U);  // as it is to 3 %, then a point a step
  for (std::size_t k = 0; k < 60; ++k) EXPECT_EQ(coarse.stress_yy[k], static_cast<double>(k));
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(coarse.strain_yy[60 + k], 0.0325 + 0.005 * static_cast<double>(k), 1e-12);
    EXPECT_NEAR(coarse.stress_yy[60 + k], 64.5 + 10.0 * static_cast<double>(k), 1e-9);
  }
}

}  // namespace
}  // namespace perfora::optimize
