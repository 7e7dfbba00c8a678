// What is here: the course that every campaign takes, on one whose evaluations are numbers: folder, journal, stop,
// kill, resume, results. What is not: what studies, sweeps and the others ask.
#include "optimize/campaign/campaign.h"

#include <gmock/gmock.h>

#include <fstream>

#include "io/files.h"
#include "io/journal.h"
#include "io/progress.h"
#include "tests/optimize/campaign/counting.h"
#include "tests/optimize/evaluate/design_support.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CampaignTest : public ::testing::Test {
 protected:
  void SetUp() override { io::set_verbosity(io::Verbosity::quiet); }
  void TearDown() override { io::set_verbosity(io::Verbosity::normal); }

  /// The evaluation number `stop_after` of all asks for a stop; 0: none does.
  WorkOptions options(bool resume = false, int stop_after = 0) {
    WorkOptions made;
    made.folder = folder_ / "work";
    made.resume = resume;
    made.command_line = "count";
    made.make_executor = [this] {
      return make_calling_executor([this](const Request& request) {
        if (++asked_ == stop_after_) source_->request();
        return Counting::plateau(request);
      });
    };
    stop_after_ = stop_after;
    source_ = std::make_unique<io::CancellationSource>();
    made.cancellation = source_->token();
    return made;
  }

  std::vector<std::string> events() const {
    std::vector<std::string> names;
    std::ifstream journal(folder_ / "work/journal.jsonl");
    for (std::string line; std::getline(journal, line);)
      names.push_back(json::parse(line.substr(line.find('{'))).at("event"));
    return names;
  }

  DesignFolder folder_;
  int asked_ = 0, stop_after_ = 0;
  std::unique_ptr<io::CancellationSource> source_;
};

TEST_F(CampaignTest, AsksUntilNothingIsLeft) {
  Counting run("a", 4, options());
  EXPECT_EQ(run.status(), results::RunStatus::stopped) << "not begun";
  run.run();
  EXPECT_EQ(run.status(), results::RunStatus::completed);
  EXPECT_EQ(run.reason(), "counted");
  EXPECT_EQ(run.sum(), 0.0 + 1.0 + 2.0 + 3.0);
  EXPECT_THAT(run.heard, ElementsAre("0", "1", "2", "3"));
  EXPECT_THAT(run.written, ElementsAre("completed, counted"));
  EXPECT_THAT(events(), ElementsAre("count", "evaluation", "evaluation", "evaluation", "evaluation", "finished"));
  std::ifstream journal(folder_ / "work/journal.jsonl");
  std::string line;
  std::getline(journal, line);
  EXPECT_EQ(json::parse(line.substr(line.find('{'))), json({{"event", "count"},
                                                            {"name", "a"},
                                                            {"results_version", results_version},
                                                            {"command_line", "count"},
                                                            {"run_files_kept", false}}));
}

TEST_F(CampaignTest, StoppedItKeepsWhatIsFinishedAndGoesOn) {
  {
    // The evaluation during which the stop comes is finished and kept: this one cannot be cut short.
    Counting run("a", 4, options(false, 2));
    run.run();
    EXPECT_EQ(run.status(), results::RunStatus::stopped);
    EXPECT_THAT(run.reason(), HasSubstr("--resume"));
    EXPECT_EQ(run.answers().size(), 2u);
    EXPECT_THAT(run.written, ElementsAre("stopped, " + run.reason()));
  }
  Counting more("a", 5, options(true));
  more.run();
  EXPECT_EQ(asked_, 5) << "nothing is asked twice";
  EXPECT_EQ(more.sum(), 10.0);
  EXPECT_THAT(events(), ElementsAre("count", "evaluation", "evaluation", "stop", "count", "evaluation", "evaluation",
                                    "evaluation", "finished"));
}

TEST_F(CampaignTest, ResultsOfUnfinishedWorkAreThereToLookAt) {
  WorkOptions often = options();
  often.results_interval = std::chrono::seconds(0);
  Counting run("a", 3, often);
  run.run();
  EXPECT_THAT(run.written, ElementsAre("stopped, not finished yet", "stopped, not finished yet", "completed, counted"));
}

// A first half without its second is not in the journal: it is asked again.
TEST_F(CampaignTest, AnswersThatMakeOneEventAreWrittenTogether) {
  {
    Counting run("a", 4, options(false, 3), true);
    run.run();
    EXPECT_EQ(run.answers().size(), 3u);
  }
  EXPECT_THAT(events(), ElementsAre("count", "pair", "stop"));
  Counting again("a", 4, options(true), true);
  EXPECT_EQ(again.answers().size(), 2u);
  again.run();
  EXPECT_EQ(asked_, 3 + 2);
  EXPECT_EQ(again.sum(), 6.0);
  EXPECT_THAT(events(), ElementsAre("count", "pair", "stop", "count", "pair", "finished"));
}

TEST_F(CampaignTest, FoldersOfOtherWorkAreRefused) {
  {
    Counting run("a", 1, options());
    run.run();
    EXPECT_THAT(complaint([&] { Counting("a", 1, options(true)); }), HasSubstr("in use"));
    WorkOptions forced = options();
    forced.force = true;
    EXPECT_THAT(complaint([&] { Counting("a", 1, forced); }), HasSubstr("in use"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "work/sum.txt")) << "nothing is removed of what is in use";
  }
  EXPECT_THAT(complaint([&] { Counting("a", 1, options()); }), HasSubstr("holds a count already; continue it with"));
  EXPECT_THAT(complaint([&] { Counting("b", 1, options(true)); }), HasSubstr("another count"));
  {
    std::filesystem::remove(folder_ / "work/journal.jsonl");
    io::Journal(folder_ / "work/journal.jsonl").append(R"({"event":"ensemble"})");
  }
  EXPECT_THAT(complaint([&] { Counting("a", 1, options(true)); }), HasSubstr("holds an ensemble, not a count"));
}

/// Options whose workers fail: number "1" `times` times with a trouble, number "2" by its own doing.
class TroubleTest : public CampaignTest {
 protected:
  WorkOptions troubled(int times, OnTrouble on_trouble, bool resume = false) {
    WorkOptions made = options(resume);
    made.execution.on_trouble = on_trouble;
    made.make_executor = [this, times] {
      return make_in_process_executor(
          [this, times](const Request& request) {
            const auto number = request.design->seeds.seed - 1;
            ++asked_;
            if (number == 2) throw io::InputError({}, "cannot be laid out");
            if (number == 1 && troubles_++ < times) throw io::SurroundingsError("the disk is full");
            return Counting::plateau(request);
          },
          1);
    };
    troubles_ = 0;
    return made;
  }
  int troubles_ = 0;
};

TEST_F(TroubleTest, IsTriedAgainAndLeavesNoTrace) {
  Counting run("a", 4, troubled(2, OnTrouble::retry));
  run.run();
  EXPECT_EQ(run.status(), results::RunStatus::completed);
  EXPECT_TRUE(run.troubles().empty());
  EXPECT_EQ(run.retries(), 2);
  EXPECT_EQ(asked_, 4 + 2);
  EXPECT_EQ(run.answers().size(), 4U);
  EXPECT_THAT(events(), ::testing::UnorderedElementsAre("count", "evaluation", "trouble", "evaluation", "evaluation",
                                                        "trouble", "evaluation", "finished"));
}

TEST_F(TroubleTest, StopsTheWorkInTheEndAndIsTriedAgainByResume) {
  for (const OnTrouble policy : {OnTrouble::retry, OnTrouble::stop}) {
    std::filesystem::remove_all(folder_ / "work");
    asked_ = 0;
    {
      Counting run("a", 4, troubled(1000, policy));
      run.run();
      EXPECT_EQ(run.status(), results::RunStatus::stopped);
      EXPECT_EQ(troubles_, policy == OnTrouble::stop ? 1 : 3);
      ASSERT_EQ(run.troubles().size(), 1U);
      EXPECT_EQ(run.troubles().front(),
                policy == OnTrouble::stop ? "1: the disk is full" : "1: the disk is full, 3 times in a row");
      EXPECT_THAT(run.reason(), ::testing::AllOf(HasSubstr(run.troubles().front()), HasSubstr("--resume")));
    }
    Counting again("a", 4, troubled(0, policy, true));
    again.run();
    EXPECT_EQ(again.status(), results::RunStatus::completed);
    EXPECT_EQ(again.sum(), 0.0 + 1.0 + 3.0);
    EXPECT_EQ(again.answers().size(), 4U);
  }
}

TEST_F(TroubleTest, SkippedItGoesOnButIsNotCompleted) {
  {
    Counting run("a", 4, troubled(1000, OnTrouble::skip));
    run.run();
    EXPECT_EQ(troubles_, 3);
    EXPECT_EQ(run.answers().size(), 3U) << "the others";
    EXPECT_EQ(run.status(), results::RunStatus::stopped);
    EXPECT_THAT(run.reason(), ::testing::AllOf(HasSubstr("1: the disk is full"), HasSubstr("left out")));
  }
  Counting again("a", 4, troubled(0, OnTrouble::stop, true));  // The rule may change.
  again.run();
  EXPECT_EQ(again.status(), results::RunStatus::completed);
  EXPECT_EQ(again.answers().size(), 4U);
}

TEST_F(TroubleTest, WhatADesignDoesToItselfIsAResult) {
  Counting run("a", 4, troubled(0, OnTrouble::stop));
  run.run();
  EXPECT_EQ(run.status(), results::RunStatus::completed);
  const auto [first, last] = run.answers().of(Counting::request(2).key());
  ASSERT_NE(first, last);
  EXPECT_EQ(first->second.reason, "cannot be laid out");
}

// An earlier program wrote the death of a worker as a result.
TEST_F(TroubleTest, OldJournalsKeepNone) {
  {
    Counting run("a", 4, options());
    run.run();
  }
  const auto journal = folder_ / "work/journal.jsonl";
  std::vector<std::string> lines;
  {
    const io::Journal old(journal);
    lines = old.events();
  }
  std::filesystem::remove(journal);
  {
    io::Journal made(journal);
    const std::vector<std::string> reasons{"the worker was ended by signal 9 (Killed), 2 times in a row",
                                           "the worker ended with exit code 3, 2 times in a row",
                                           "the worker took more than 5 s, 2 times in a row", "unstable step"};
    std::size_t next = 0;
    for (const std::string& line : lines) {
      json event = json::parse(line);
      if (event.at("event") == "evaluation") {
        event["evaluation"]["status"] = "failed";
        event["evaluation"]["reason"] = reasons.at(next++);
      }
      made.append(event.dump());
    }
  }
  Counting again("a", 4, options(true));
  EXPECT_EQ(again.answers().size(), 1U) << "the unstable one";
  again.run();
  EXPECT_EQ(asked_, 4 + 3);
}

TEST_F(CampaignTest, WhatAKillLeftGoesWithTheEnd) {
  {
    Counting run("a", 2, options(false, 1));
    run.run();
  }
  for (const char* folder : {"work/runs/left.part", "work/histories"})
    std::filesystem::create_directories(folder_ / folder);
  const std::string own = io::temporary_name("").string();
  const std::string mark = ".tmp-4194305" + own.substr(own.rfind('-'));  // beyond the largest number of a process
  for (const char* name : {"work/runs/left.h5", "work/runs/left.part/x", "work/histories/left.h5"})
    folder_.file(name, "left");
  for (const char* name : {"work/sum.txt", "work/runs/left.h5", "work/histories/left.h5"})
    folder_.file(name + mark, "half");
  Counting again("a", 2, options(true));
  EXPECT_FALSE(std::filesystem::exists(folder_ / ("work/sum.txt" + mark)));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "work/runs/left.h5")) << "it may be resumed";
  again.run();
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "work"))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("journal.jsonl", "journal.jsonl.lock", "sum.txt"));
}

TEST_F(CampaignTest, ForceRemovesItsOwnFilesAlone) {
  std::filesystem::create_directory(folder_ / "work");
  for (const char* name : {"sum.txt", "part-1", "parting words"}) folder_.file(std::string("work/") + name, "here");
  EXPECT_THAT(complaint([&] { Counting("a", 1, options()); }), HasSubstr("a count would overwrite this file"));
  WorkOptions forced = options();
  forced.force = true;
  Counting("a", 1, forced);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "work/sum.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "work/part-1"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "work/parting words"));
}

// Folders that the end of any work cleans are its own from the start, or it does not begin there.
TEST_F(CampaignTest, FoldersOfSomebodysOwnStay) {
  for (const std::string name : {"runs", "histories", "shared"}) {
    std::filesystem::create_directories(folder_ / ("work/" + name));
    folder_.file("work/" + name + "/mine.txt", "mine");
    for (const bool force : {false, true}) {
      WorkOptions wanted = options();
      wanted.force = force;
      EXPECT_THAT(complaint([&] { Counting("a", 1, wanted); }),
                  HasSubstr("a count would overwrite this folder; name another folder with -o, or move this one"));
    }
    EXPECT_EQ(io::read_file(folder_ / ("work/" + name + "/mine.txt")), "mine");
    std::filesystem::remove_all(folder_ / "work");
  }
}

// The key that an earlier program filed a history under is another than today's: the history goes with the evaluation.
TEST_F(CampaignTest, AHistoryUnderAnEarlierKeyIsKept) {
  {
    Counting run("a", 2, options(false, 1));
    run.run();
  }
  const auto journal = folder_ / "work/journal.jsonl";
  const std::vector<std::string> events = io::Journal(journal).events();
  std::filesystem::remove(journal);
  std::string key;
  {
    io::Journal older(journal);
    for (const std::string& text : events) {
      json event = json::parse(text);
      if (event.at("event") == "evaluation") {
        key = event.at("key");
        event["key"] = "earlier";
      }
      older.append(event.dump());
    }
  }
  ASSERT_FALSE(key.empty());
  std::filesystem::create_directories(folder_ / "work/histories");
  folder_.file("work/histories/earlier.h5", "a history");
  const Counting again("a", 2, options(true));
  EXPECT_EQ(io::read_file(folder_ / ("work/histories/" + key + ".h5")), "a history");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "work/histories/earlier.h5"));
}

}  // namespace
}  // namespace perfora::optimize
