// What is here: both executors: answers, crashes, garbage, time limits, stopped children, stops, and that no child
// outlives its parent. What is not: what is asked (campaign.h).
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <map>
#include <new>
#include <thread>

#include "optimize/campaign/time_limit.h"
#include "optimize/evaluate/estimate.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

using namespace std::chrono_literals;

ChildOptions child_options(const StudyFolder& folder, int workers) {
  ChildOptions options;
  options.command = {PERFORA_FAKE_WORKER, "numbers", (folder / "").string()};
  options.workers = workers;
  return options;
}

Request request_of(int replicate) {
  return make_request(DesignFile(), replicate, 0.4);
}

std::map<std::string, Answer> ask(Executor& executor, const std::vector<int>& replicates) {
  for (const int replicate : replicates) executor.submit(std::to_string(replicate), request_of(replicate));
  std::map<std::string, Answer> answers;
  for (int k = 0; k < 600 && answers.size() < replicates.size(); ++k)
    if (auto answer = executor.next(100ms)) answers.emplace(answer->key, *answer);
  EXPECT_EQ(answers.size(), replicates.size());
  return answers;
}

std::vector<pid_t> pids(const StudyFolder& folder) {
  std::ifstream file(folder / "pids");
  std::set<pid_t> all;
  for (pid_t pid; file >> pid;) all.insert(pid);
  return {all.begin(), all.end()};
}

bool alive(pid_t pid) {
  return ::kill(pid, 0) == 0;
}

TEST(InProcess, AnswersEverythingWithAnyNumberOfWorkers) {
  for (const int workers : {1, 4}) {
    const auto executor = make_in_process_executor(
        [](const Request& request) {
          Evaluation evaluation;
          evaluation.replicate = request.replicate;
          if (request.replicate == 2) throw std::bad_alloc();
          if (request.replicate == 3) throw std::runtime_error("words");
          if (request.replicate == 4) throw io::InputError({}, "no such hole");
          return evaluation;
        },
        workers);
    EXPECT_EQ(executor->workers(), workers);
    const auto answers = ask(*executor, {1, 2, 3, 4, 5});
    EXPECT_EQ(answers.at("5").evaluation.replicate, 5);
    EXPECT_EQ(answers.at("3").trouble, "words") << "no result of a design";
    EXPECT_EQ(answers.at("4").evaluation.status, results::RunStatus::failed);
    EXPECT_EQ(answers.at("4").evaluation.reason, "no such hole");
    EXPECT_EQ(answers.at("4").trouble, "");
    EXPECT_EQ(answers.at("2").trouble, "out of memory");
  }
}

TEST(InProcess, StopsBetweenEvaluations) {
  const auto executor = make_in_process_executor(
      [](const Request&) {
        std::this_thread::sleep_for(20ms);
        return Evaluation{};
      },
      1);
  for (int k = 0; k < 100; ++k) executor->submit(std::to_string(k), request_of(k));
  executor->stop();
  EXPECT_FALSE(executor->next(10ms));
}

TEST(Children, AnswerEverythingWithAnyNumberOfWorkers) {
  for (const int workers : {1, 2, 5}) {
    const StudyFolder folder;
    const auto executor = make_child_executor(child_options(folder, workers));
    const auto answers = ask(*executor, {1, 2, 3, 4, 5, 6, 7, 8});
    for (int k = 1; k <= 8; ++k) {
      EXPECT_EQ(answers.at(std::to_string(k)).evaluation.summary.plateau_stress, 1000.0 * k);
      EXPECT_EQ(answers.at(std::to_string(k)).trouble, "");
    }
    EXPECT_LE(pids(folder).size(), static_cast<std::size_t>(workers)) << "workers are kept";
  }
}

TEST(Children, ACrashIsATroubleAndNoEvaluation) {
  const StudyFolder folder;
  const auto executor = make_child_executor(child_options(folder, 2));
  const auto answers = ask(*executor, {1, 103, 2, 105, 3, 106, 4, 108, 5, 109, 6, 111, 113, 114});
  for (int k = 1; k <= 6; ++k) EXPECT_EQ(answers.at(std::to_string(k)).evaluation.summary.plateau_stress, 1000.0 * k);
  const std::map<std::string, std::string> reasons{
      {"103", "exit code 42"}, {"105", "cannot be read"}, {"106", "signal 9"},     {"108", "cannot be read"},
      {"109", "signal 11"},    {"111", "told to stop"},   {"114", "no space left"}};
  for (const auto& [key, reason] : reasons) {
    const Answer& answer = answers.at(key);
    EXPECT_NE(answer.trouble.find(reason), std::string::npos) << answer.trouble;
  }
  EXPECT_EQ(answers.at("113").evaluation.summary.plateau_stress, 113000.0) << "signs of life are no answers";
}

TEST(Children, TellHowFarTheyHaveCome) {
  const StudyFolder folder;
  const auto executor = make_child_executor(child_options(folder, 1));
  EXPECT_TRUE(executor->under_way().empty());
  executor->submit("a", request_of(115));
  std::vector<UnderWay> seen;
  std::optional<Answer> answer;
  while (!(answer = executor->next(5ms)))
    for (UnderWay& one : executor->under_way())
      if (!one.progress.text.empty()) seen.push_back(std::move(one));
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.back().key, "a");
  EXPECT_EQ(seen.back().progress.fraction, 0.4);
  EXPECT_EQ(seen.back().progress.text, "strain 4 %");
  EXPECT_GE(seen.back().seconds, seen.front().seconds);
  EXPECT_EQ(answer->evaluation.summary.plateau_stress, 115000.0);
  EXPECT_TRUE(executor->under_way().empty());
}

TEST(Children, AreReplacedWhenTheyDied) {
  const StudyFolder folder;
  const auto executor = make_child_executor(child_options(folder, 1));
  EXPECT_NE(ask(*executor, {104}).at("104").trouble, "");
  EXPECT_EQ(ask(*executor, {104}).at("104").evaluation.summary.plateau_stress, 104000.0);
}

TEST(Children, ThatAreStoppedAreReplaced) {
  const StudyFolder folder;
  ChildOptions options = child_options(folder, 1);
  options.silence = 300ms;
  const auto executor = make_child_executor(options);
  const auto answers = ask(*executor, {112, 110, 2});
  EXPECT_NE(answers.at("112").trouble.find("was stopped"), std::string::npos) << answers.at("112").trouble;
  EXPECT_EQ(answers.at("110").trouble, "") << "silent, but at work";
  EXPECT_EQ(answers.at("2").evaluation.summary.plateau_stress, 2000.0);
}

TEST(Children, IdleOnesEndAtOnce) {
  const StudyFolder folder;
  const auto executor = make_child_executor(child_options(folder, 3));
  static_cast<void>(ask(*executor, {1, 2, 3}));
  const auto start = std::chrono::steady_clock::now();
  executor->stop();
  EXPECT_LT(std::chrono::steady_clock::now() - start, 1s);
  for (const pid_t pid : pids(folder)) EXPECT_FALSE(alive(pid));
}

TEST(TimeLimits, AreTwentyTimesTheEstimateAndAMinuteOfWhatWasSlowest) {
  TimeLimits limits(1);
  const double estimate = estimate_design(DesignFile(), 1).seconds;  // of the strain that the design goes to
  const Request request = make_request(DesignFile(), 0);
  EXPECT_DOUBLE_EQ(limits.of(request), 20.0 * estimate + 60.0);
  limits.learn(request, 0.1 * estimate);
  EXPECT_DOUBLE_EQ(limits.of(request), 20.0 * estimate + 60.0);
  limits.learn(request, 3.0 * estimate);
  EXPECT_DOUBLE_EQ(limits.of(request), 60.0 * estimate + 60.0);
  EXPECT_LT(limits.of(request_of(0)), limits.of(request)) << "a shorter run";
}

TEST(Children, AreKilledAtTheTimeLimit) {
  const StudyFolder folder;
  ChildOptions options = child_options(folder, 2);
  options.time_limit = 2s;
  const auto executor = make_child_executor(options);
  const auto answers = ask(*executor, {1, 107, 2});
  EXPECT_NE(answers.at("107").trouble.find("more than 2 s"), std::string::npos) << answers.at("107").trouble;
  EXPECT_EQ(answers.at("2").evaluation.summary.plateau_stress, 2000.0);
}

TEST(Children, EndAtAStop) {
  const StudyFolder folder;
  const auto executor = make_child_executor(child_options(folder, 3));
  for (const int k : {107, 107, 107}) executor->submit(std::to_string(k), request_of(k));
  for (int k = 0; k < 3000 && pids(folder).size() < 3; ++k) static_cast<void>(executor->next(20ms));
  const auto all = pids(folder);
  ASSERT_EQ(all.size(), 3U);
  executor->stop();
  for (const pid_t pid : all) EXPECT_FALSE(alive(pid));
  EXPECT_FALSE(executor->next(1ms));
}

TEST(Children, DieWithTheirParent) {
  const StudyFolder folder;
  const pid_t parent = ::fork();
  if (parent == 0) {
    const auto executor = make_child_executor(child_options(folder, 2));
    for (const int k : {107, 107}) executor->submit(std::to_string(k), request_of(k));
    while (true) static_cast<void>(executor->next(50ms));
  }
  // A program under a sanitizer takes long to start on a busy machine.
  for (int k = 0; k < 6000 && pids(folder).size() < 2; ++k) std::this_thread::sleep_for(10ms);
  const auto all = pids(folder);
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  ASSERT_EQ(all.size(), 2U);
  for (const pid_t pid : all) {
    // Gone, or a zombie that nobody has collected yet.
    bool gone = false;
    for (int k = 0; k < 6000 && !gone; ++k) {
      std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
      std::string text;
      std::getline(stat, text);
      gone = text.empty() || text.find(") Z ") != std::string::npos;
      std::this_thread::sleep_for(5ms);
    }
    EXPECT_TRUE(gone) << pid;
  }
}

TEST(Children, AProgramThatCannotStartIsAnErrorAndNotAFailedEvaluation) {
  ChildOptions options;
  options.command = {"/no/such/program"};
  const auto executor = make_child_executor(options);
  executor->submit("1", request_of(1));
  EXPECT_THROW(
      {
        for (int k = 0; k < 100; ++k) static_cast<void>(executor->next(50ms));
      },
      io::SurroundingsError);
}

}  // namespace
}  // namespace perfora::optimize
