// What is here: both executors: answers, crashes, garbage, time limits, stops, and that no child outlives its parent.
// What is not: what is asked (campaign.h).
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <map>
#include <thread>

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
          if (request.replicate == 3) throw std::runtime_error("words");
          return evaluation;
        },
        workers);
    EXPECT_EQ(executor->workers(), workers);
    const auto answers = ask(*executor, {1, 2, 3, 4, 5});
    EXPECT_EQ(answers.at("5").evaluation.replicate, 5);
    EXPECT_EQ(answers.at("3").evaluation.status, results::RunStatus::failed);
    EXPECT_EQ(answers.at("3").evaluation.reason, "words");
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
      EXPECT_EQ(answers.at(std::to_string(k)).attempts, 1);
    }
    EXPECT_LE(pids(folder).size(), static_cast<std::size_t>(workers)) << "workers are kept";
  }
}

TEST(Children, ACrashCostsOneEvaluation) {
  const StudyFolder folder;
  const auto executor = make_child_executor(child_options(folder, 2));
  const auto answers = ask(*executor, {1, 103, 2, 105, 3, 106, 4, 108, 5, 109, 6, 111});
  for (int k = 1; k <= 6; ++k) EXPECT_EQ(answers.at(std::to_string(k)).evaluation.summary.plateau_stress, 1000.0 * k);
  const std::map<std::string, std::string> reasons{{"103", "exit code 42"}, {"105", "cannot be read"},
                                                   {"106", "signal 9"},     {"108", "cannot be read"},
                                                   {"109", "signal 11"},    {"111", "told to stop"}};
  for (const auto& [key, reason] : reasons) {
    const Answer& answer = answers.at(key);
    EXPECT_EQ(answer.evaluation.status, results::RunStatus::failed) << key;
    EXPECT_EQ(answer.attempts, 2) << key;
    EXPECT_NE(answer.evaluation.reason.find(reason), std::string::npos) << answer.evaluation.reason;
  }
}

TEST(Children, AreAskedASecondTime) {
  const StudyFolder folder;
  const auto executor = make_child_executor(child_options(folder, 1));
  const auto answers = ask(*executor, {104});
  EXPECT_EQ(answers.at("104").attempts, 2);
  EXPECT_EQ(answers.at("104").evaluation.summary.plateau_stress, 104000.0);
}

TEST(Children, AreKilledAtTheTimeLimit) {
  const StudyFolder folder;
  ChildOptions options = child_options(folder, 2);
  options.time_limit = 0.3;
  const auto executor = make_child_executor(options);
  const auto answers = ask(*executor, {1, 107, 2});
  EXPECT_EQ(answers.at("107").evaluation.status, results::RunStatus::failed);
  EXPECT_NE(answers.at("107").evaluation.reason.find("more than 0.3 s"), std::string::npos);
  EXPECT_EQ(answers.at("2").evaluation.summary.plateau_stress, 2000.0);
}

TEST(Children, EndAtAStop) {
  const StudyFolder folder;
  const auto executor = make_child_executor(child_options(folder, 3));
  for (const int k : {107, 107, 107}) executor->submit(std::to_string(k), request_of(k));
  for (int k = 0; k < 100 && pids(folder).size() < 3; ++k) static_cast<void>(executor->next(20ms));
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
  for (int k = 0; k < 400 && pids(folder).size() < 2; ++k) std::this_thread::sleep_for(10ms);
  const auto all = pids(folder);
  ASSERT_EQ(all.size(), 2U);
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  for (const pid_t pid : all) {
    // Gone, or a zombie that nobody has collected yet.
    bool gone = false;
    for (int k = 0; k < 400 && !gone; ++k) {
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
      std::runtime_error);
}

}  // namespace
}  // namespace perfora::optimize
