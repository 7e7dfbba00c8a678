// What is here: batches: written to the journal before they run, taken from it on a resume, computed anew to the same
// points, whatever workers and kills. What is not: the searchers of the program that ask so.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "io/progress.h"
#include "optimize/search/study_result.h"
#include "optimize/search/study_run.h"
#include "results/campaign_folder.h"
#include "tests/optimize/search/batch_searcher.h"
#include "tests/optimize/search/study_support.h"
#include "tests/support/thinned.h"

namespace perfora::optimize {
namespace {

class Batches : public testing::Test {
 protected:
  StudyFolder folder;
  void SetUp() override { io::set_verbosity(io::Verbosity::quiet); }
  void TearDown() override { io::set_verbosity(io::Verbosity::normal); }

  Study study(const std::string& keys = "maxeval = 11\nalgorithm = \"batches\"\nfinal_replicates = 2",
              const std::string& arms = "rows = [1, 2]") {
    return read_study(folder.file("study.toml", study_text(keys, arms)), {}, {std::make_shared<BatchSearcher>()});
  }
  WorkOptions options(const std::string& name, int workers = 1, Evaluate evaluate = fake_with_failures) {
    WorkOptions made;
    made.folder = folder / name;
    made.make_executor = [evaluate, workers] { return make_in_process_executor(evaluate, workers); };
    return made;
  }
  std::vector<Batch> journalled(const std::string& name, const Study& of) const {
    std::vector<Batch> found;
    for (const auto& event : results::journal_events(folder / name))
      if (event.at("event") == "batch") found.push_back(batch_from_json(event, of));
    return found;
  }
  static nlohmann::json finish(StudyRun& run) {
    run.run();
    nlohmann::json record = to_json(run);
    record.erase("performance");
    return record;
  }
};

TEST_F(Batches, StandInTheJournalBeforeTheyRun) {
  const Study one = study();
  std::size_t seen = 0;
  StudyRun run(one, options("order", 1, [&](const Request& request) {
                 const auto batches = journalled("order", one);
                 bool known = request.replicate >= one.keys.replicates || request.design->layout.diameter == 0.016;
                 for (const Batch& batch : batches)
                   for (const BatchPoint& point : batch.points)
                     known = known || one.values_at(point.point)[0] == request.design->layout.diameter;
                 EXPECT_TRUE(known) << "a candidate is run that no batch of the journal holds";
                 seen = std::max(seen, batches.size());
                 return fake_with_failures(request);
               }));
  run.run();
  EXPECT_EQ(seen, 3U);  // 11 candidates in batches of four
  EXPECT_EQ(journalled("order", one)[2].points.size(), 3U);
}

TEST_F(Batches, ComputedAnewTheyAreTheSame) {
  const Study one = study();
  StudyRun run(one, options("anew", 2));
  run.run();
  const auto batches = journalled("anew", one);
  ASSERT_EQ(batches.size(), 3U);
  // A driver that is given none of them computes the first again, then the second from the first, ...
  for (std::size_t given = 0; given < batches.size(); ++given) {
    Driver driver(one);
    for (std::size_t k = 0; k < given; ++k) driver.take(batches[k]);
    Answers answers;  // of the batches that were given and of the start alone
    for (const Batch& batch : batches) {
      if (batch.number > static_cast<int>(given)) break;
      for (const BatchPoint& point : batch.points) {
        const Request request = driver.book().at(point.arm, one.values_at(point.point)).request(0);
        answers.add(request.key(), fake_with_failures(request));
      }
    }
    const Plan plan = driver.plan(answers);
    ASSERT_EQ(plan.new_batches.size(), 1U);
    EXPECT_EQ(plan.new_batches.front(), batches[given]);
  }
}

TEST_F(Batches, NeitherWorkersNorKillsChangeThem) {
  const Study one = study();
  StudyRun straight(one, options("straight"));
  const auto expected = finish(straight);
  const auto batches = journalled("straight", one);
  for (const int workers : {2, 7}) {
    StudyRun run(one, options("workers", workers));
    EXPECT_EQ(finish(run), expected);
    EXPECT_EQ(journalled("workers", one), batches);
    std::filesystem::remove_all(folder / "workers");
  }
  const int evaluations = expected.at("evaluations").get<int>();
  for (int kill_at = 1; kill_at <= evaluations; kill_at += test::thinned(4, 13)) {
    const pid_t child = ::fork();
    if (child == 0) {
      int count = 0;
      WorkOptions dying = options("killed");
      dying.make_executor = [&] {
        return make_calling_executor([&](const Request& request) {
          if (++count == kill_at) ::kill(::getpid(), SIGKILL);
          return fake_with_failures(request);
        });
      };
      StudyRun run(one, dying);
      run.run();
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    WorkOptions again = options("killed", 3);
    again.resume = true;
    StudyRun resumed(one, again);
    EXPECT_EQ(finish(resumed), expected) << kill_at;
    EXPECT_EQ(journalled("killed", one), batches) << kill_at;
    std::filesystem::remove_all(folder / "killed");
  }
}

// A limit of time ends the search; what was open then stays out for good, and race and verification go on.
TEST_F(Batches, AnEarlyEndIsAnEventThatIsSeen) {
  const Study one = study();
  nlohmann::json first;
  {
    StudyRun run(one, options("late"), 1e-9);
    first = finish(run);
  }
  EXPECT_EQ(first.at("status"), "completed");
  EXPECT_NE(first.at("reason").get<std::string>().find("ended early"), std::string::npos);
  EXPECT_FALSE(first.at("finals").is_null());
  EXPECT_LT(first.at("evaluations").get<int>(), 11);
  int ends = 0;
  for (const auto& event : results::journal_events(folder / "late")) ends += event.at("event") == "early_end";
  EXPECT_EQ(ends, 1);
  WorkOptions again = options("late");
  again.resume = true;
  StudyRun resumed(one, again);
  EXPECT_EQ(finish(resumed), first) << "nothing is searched further";
}

TEST_F(Batches, ComeBackFromTheJournal) {
  const Study one = study();
  const Batch batch{"search", 3, {{1, {0.0, 1.0}}, {0, {1229.0 / 4096.0, 0.5}}}};
  EXPECT_EQ(batch_from_json(to_json(batch, one), one), batch);
}

}  // namespace
}  // namespace perfora::optimize
