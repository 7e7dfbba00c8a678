// What is here: maps: which designs they hold, one map for every target, evaluations taken from another folder without
// a run, folders that do not fit. What is not: their pictures, the command.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <atomic>
#include <csignal>

#include "io/files.h"
#include "io/progress.h"
#include "optimize/search/map_plan.h"
#include "optimize/search/map_run.h"
#include "optimize/search/study_parts.h"
#include "optimize/search/study_plan.h"
#include "optimize/search/study_record.h"
#include "optimize/search/study_result.h"
#include "optimize/search/study_run.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

const char* const map_arms = "rows = [1, 2]";
const std::string map_keys = "[map]\ndesigns = 10\n";

class MapTest : public testing::Test {
 protected:
  StudyFolder folder;
  void SetUp() override { io::set_verbosity(io::Verbosity::quiet); }
  void TearDown() override { io::set_verbosity(io::Verbosity::normal); }

  Study read(const std::string& text, const std::vector<std::string>& overrides = {}, StudyUse use = StudyUse::search) {
    return read_study(folder.file("study.toml", text), overrides, use);
  }
  Study mapped(const std::vector<std::string>& overrides = {}) {
    return read(study_text("", map_arms) + map_keys, overrides, StudyUse::map);
  }
  /// Counts what is asked.
  WorkOptions options(const std::string& name, int workers = 1) {
    WorkOptions made;
    made.folder = folder / name;
    made.make_executor = [this, workers] {
      return make_in_process_executor(
          [this](const Request& request) {
            ++asked;
            return fake_with_history(request);
          },
          workers);
    };
    return made;
  }
  /// With a history that a queue keeps, so that it can be measured anew.
  static Evaluation fake_with_history(const Request& request) {
    Evaluation evaluation = fake_with_failures(request);
    if (evaluation.status != results::RunStatus::completed) return evaluation;
    results::History& curve = evaluation.curve;
    const std::size_t rows = curve.strain_yy.size();
    evaluation.summary.final_strain = curve.strain_yy.back();
    for (const results::History::Column& column : results::History::columns())
      if (!column.optional && (curve.*column.values).empty()) (curve.*column.values).assign(rows, 0.0);
    return evaluation;
  }
  std::atomic<int> asked = 0;
};

TEST_F(MapTest, ItsDesignsKeepTheConstraintsAndFillAllArms) {
  const Study study = read(study_text("", map_arms, "thinnest_wall = \"6 mm\"") + map_keys, {}, StudyUse::map);
  CandidateBook book(study);
  const MapChoice choice = choose_map(study, book, 40);
  ASSERT_EQ(choice.points.size(), 40U);
  EXPECT_GT(choice.tried, 40) << "some break the wall";
  int of_first = 0;
  for (const BatchPoint& one : choice.points) {
    const Candidate& candidate = book.at(one.arm, study.values_at(one.point));
    EXPECT_GE(candidate.layout.thinnest_wall, 0.006 - 1e-9);
    of_first += one.arm == 0;
    for (const double x : one.point) EXPECT_EQ(x * 4096.0, std::round(x * 4096.0));
  }
  EXPECT_GT(of_first, 10);
  EXPECT_LT(of_first, 30);
  const MapChoice fewer = choose_map(study, book, 25);
  EXPECT_TRUE(std::equal(fewer.points.begin(), fewer.points.end(), choice.points.begin()));
}

TEST_F(MapTest, GivesUpWhereHardlyAnythingKeepsTheConstraints) {
  const Study study = read(study_text("", "", "thinnest_wall = \"11 mm\"") + map_keys, {}, StudyUse::map);
  CandidateBook book(study);
  const MapChoice choice = choose_map(study, book, 3);
  EXPECT_TRUE(choice.points.empty());
  EXPECT_EQ(choice.tried, 600);
}

TEST_F(MapTest, IsTheSameWhateverTheWorkersAndKills) {
  MapRun straight(mapped(), options("straight"));
  straight.run();
  const auto expected = to_json(straight.record());
  EXPECT_EQ(expected.at("designs").size(), 10U);
  EXPECT_EQ(asked, 20);
  MapRun many(mapped(), options("many", 5));
  many.run();
  EXPECT_EQ(to_json(many.record()), expected);
  for (const int kill_at : {1, 7, 20}) {
    const pid_t child = ::fork();
    if (child == 0) {
      int count = 0;
      WorkOptions dying = options("killed");
      dying.make_executor = [&] {
        return make_calling_executor([&](const Request& request) {
          if (++count == kill_at) ::kill(::getpid(), SIGKILL);
          return fake_with_history(request);
        });
      };
      MapRun run(mapped(), dying);
      run.run();
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    WorkOptions again = options("killed");
    again.resume = true;
    MapRun resumed(mapped(), again);
    resumed.run();
    EXPECT_EQ(to_json(resumed.record()), expected) << kill_at;
    std::filesystem::remove_all(folder / "killed");
  }
}

TEST_F(MapTest, GrowsWithoutRunningADesignTwice) {
  { MapRun(mapped(), options("map")).run(); }
  asked = 0;
  WorkOptions again = options("map");
  again.resume = true;
  MapRun more(mapped({"map.designs=14"}), again);
  more.run();
  EXPECT_EQ(more.record().designs.size(), 14U);
  EXPECT_EQ(asked, 8);
}

// Another target, another window: no run of the map is made again, and the search begins with its best designs.
TEST_F(MapTest, OneMapServesEveryTarget) {
  { MapRun(mapped(), options("map")).run(); }
  const std::string taken = "[map]\nfrom = \"map\"\n";
  const Study study = read(study_text("maxeval = 2\nreplicates = 2\nfinal_replicates = 0", map_arms) + taken,
                           {"target.plateau_stress=3e5", "target.window=[0.1, 0.3]"});
  asked = 0;
  nlohmann::json record;
  {
    StudyRun run(study, options("study"));
    EXPECT_EQ(run.taken_over(), 20);
    run.run();
    EXPECT_EQ(asked, 4 + 2) << "two candidates and the start, with two replicates each";
    record = to_json(run);
    EXPECT_EQ(record.at("map").at("designs"), 10);
    ASSERT_NE(run.plan().best, nullptr);
    for (const Visit& visit : run.plan().map)
      if (visit.detail.valid) {
        EXPECT_LE(run.plan().best_score.value, visit.score);
        EXPECT_NEAR(run.known(*visit.candidate, 0, 1).front()->summary.plateau_start, 0.1, 1e-12);
      }
    EXPECT_TRUE(std::filesystem::exists(folder / "study" / "map.csv"));
    // What is recommended stands in the table and in the picture, be it of the map.
    const bool of_map = best_beside_search(run.plan()).has_value();
    EXPECT_EQ(evaluations_csv(run).find("\nmap,") != std::string::npos, of_map);
    EXPECT_TRUE(of_map) << "two candidates do not beat ten mapped designs";
    EXPECT_GT(study_record(run).best_number, 0);
  }
  // On a resume the other folder is not needed any more.
  std::filesystem::remove_all(folder / "map");
  asked = 0;
  WorkOptions again = options("study");
  again.resume = true;
  StudyRun resumed(study, again);
  resumed.run();
  EXPECT_EQ(asked, 0);
  auto same = to_json(resumed);
  EXPECT_EQ(same.at("best"), record.at("best"));
  EXPECT_EQ(same.at("map"), record.at("map"));
}

TEST_F(MapTest, AFirstStageIsWhatAMapAloneIs) {
  MapRun alone(mapped(), options("map"));
  alone.run();
  StudyRun run(read(study_text("maxeval = 2\nfinal_replicates = 0", map_arms) + map_keys), options("study"));
  run.run();
  ASSERT_TRUE(run.map());
  EXPECT_EQ(to_json(*run.map()).at("designs"), to_json(alone.record()).at("designs"));
}

TEST_F(MapTest, RefusesAnotherSpaceByItsFirstKey) {
  { MapRun(mapped(), options("map")).run(); }
  const auto refusal = [&](const std::string& text, const std::vector<std::string>& overrides = {}) {
    return input_error([&] { read(text + "[map]\nfrom = \"map\"\n", overrides); });
  };
  const std::string same = study_text("maxeval = 2", map_arms);
  EXPECT_NE(refusal(same, {"material.horizon=2.9"}).find("design.material.horizon is 3 there and 2.9 here"),
            std::string::npos);
  EXPECT_NE(refusal(study_text("maxeval = 3", "rows = [1, 2, 3]")).find("arms is"), std::string::npos);
  EXPECT_NE(refusal(same, {"study.until=0.5"}).find("loading.until"), std::string::npos);
  std::string wider = same;
  wider.replace(wider.find("14 mm"), 5, "13 mm");
  EXPECT_NE(refusal(wider).find("variables.layout.diameter is [0.014, 0.021] there and [0.013, 0.021] here"),
            std::string::npos)
      << refusal(wider);
  EXPECT_NE(refusal(same + "[fidelity.coarse]\n\"packing.mean_diameter\" = \"0.6 mm\"\n", {"study.fidelity=coarse"})
                .find("study.fidelity"),
            std::string::npos);
  EXPECT_NE(input_error([&] {
              const Study study = read(same + "[map]\nfrom = \"nowhere\"\n");
              StudyRun(study, options("none"));
            }).find("holds no map"),
            std::string::npos);
}

// What another folder paid for is no part of a plan, and what it took is kept beside it.
TEST_F(MapTest, ABudgetDoesNotCountWhatIsTaken) {
  { MapRun(mapped(), options("map")).run(); }
  const std::string text = study_text("replicates = 2\nfinal_replicates = 0", map_arms) + "[map]\nfrom = \"map\"\n";
  const Study alone = read(text, {"study.budget=40 h"});
  EXPECT_EQ(alone.keys.map.designs, 0) << "the map is there";
  EXPECT_EQ(alone.taken.designs, 10);
  EXPECT_EQ(alone.taken.evaluations, 20);
  EXPECT_EQ(alone.taken.map_runs, 0);
  // Its best designs are run like candidates before the race: a third replicate of each.
  const StudyPlan third = plan_of(read(text, {"study.budget=40 h", "study.replicates=3", "race.finalists=4"}));
  const auto stage = std::find_if(third.stages.begin(), third.stages.end(),
                                  [](const PlannedStage& one) { return one.name == "best of the map"; });
  ASSERT_NE(stage, third.stages.end());
  EXPECT_EQ(stage->runs, 4);
  // Twelve designs are wished, of which the folder has ten: two are run, with two replicates.
  const Study more = read(text, {"study.budget=40 h", "map.designs=12"});
  EXPECT_EQ(more.taken.map_runs, 20);
  const StudyPlan plan = plan_of(more);
  EXPECT_EQ(plan.stages.front().name, "map");
  EXPECT_EQ(plan.stages.front().runs, 4);
  EXPECT_LE(plan.seconds(), 144000.0);
  EXPECT_EQ(planned(more).at("taken_evaluations"), 20);
}

// The model of a finished study speaks of every design that was run, those of the map among them.
TEST_F(MapTest, TheModelOfAFinishedStudyLearnsFromTheMap) {
  { MapRun(mapped({"map.designs=24", "map.replicates=1"}), options("map")).run(); }
  StudyRun run(read(study_text("maxeval = 4\nfinal_replicates = 0\nalgorithm = \"model\"", map_arms) +
                    "[map]\nfrom = \"map\"\n"),
               options("study"));
  run.run();
  int completed = 0;  // one replicate each
  for (const auto& [key, evaluation] : run.answers()) completed += evaluation.status == results::RunStatus::completed;
  EXPECT_GT(completed, 20);
  const nlohmann::json model = to_json(run).at("model");
  EXPECT_NE(model.at("in_words").get<std::string>().find(fmt::format("{} designs", completed)), std::string::npos)
      << model.at("in_words");
  EXPECT_TRUE(model.contains("importance"));
}

// The other half of one map for all targets: a finished study that goes on with another wish.
TEST_F(MapTest, AFinishedStudyWithAnotherTargetIsMeasuredAnew) {
  const std::string text = study_text("maxeval = 8\nfinal_replicates = 0", map_arms);
  nlohmann::json first;
  {
    StudyRun run(read(text), options("study"));
    run.run();
    first = to_json(run);
  }
  EXPECT_EQ(asked, 9);
  asked = 0;
  WorkOptions again = options("study");
  again.resume = true;
  StudyRun run(read(text, {"target.plateau_stress=2.4e5"}), again);
  EXPECT_EQ(run.taken_over(), 9);
  run.run();
  EXPECT_LE(asked, 6) << "points that both searches ask for are not run again";
  const auto second = to_json(run);
  EXPECT_NE(second.at("score"), first.at("score"));
  EXPECT_EQ(second.at("map").at("designs"), 9);
}

TEST_F(MapTest, NeedsNoWish) {
  std::string text = study_text("", map_arms) + map_keys;
  text.erase(text.find("[target]"), text.find("[variables]") - text.find("[target]"));
  MapRun run(read(text, {}, StudyUse::map), options("map"));
  run.run();
  EXPECT_EQ(run.status(), results::RunStatus::completed);
  EXPECT_NE(input_error([&] { read(study_text("", map_arms), {}, StudyUse::map); }).find("--designs"),
            std::string::npos);
}

}  // namespace
}  // namespace perfora::optimize
