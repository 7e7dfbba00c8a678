// What is here: studies whose evaluations are made by other processes that see the folder: the same requests and the
// same answer as in one process, also after kills of workers and of the process that asks; requests taken and answered
// by hand. Expected values: the study in one process. What is not: the commands (tests/app/test_shared_commands.cpp).
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <thread>

#include "io/progress.h"
#include "optimize/campaign/shared_folder.h"
#include "optimize/campaign/shared_work.h"
#include "optimize/search/study_result.h"
#include "optimize/search/study_run.h"
#include "results/campaign_folder.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

using namespace std::chrono_literals;

class SharedTest : public testing::Test {
 protected:
  StudyFolder folder;
  void SetUp() override { io::set_verbosity(io::Verbosity::quiet); }
  void TearDown() override { io::set_verbosity(io::Verbosity::normal); }

  Study study() {
    return read_study(folder.file(
        "study.toml",
        study_text("maxeval = 8\nreplicates = 2\nfinal_replicates = 3\nalgorithm = \"GN_DIRECT_L\"", "rows = [1, 2]")));
  }
  WorkOptions shared_options(const std::string& name, bool resume = false) {
    WorkOptions made;
    made.folder = folder / name;
    made.resume = resume;
    made.make_executor = [this, name] { return make_shared_executor(folder / name); };
    return made;
  }
  struct Outcome {
    nlohmann::json record;
    std::set<std::string> asked;  ///< keys that the journal has an evaluation of
    std::size_t evaluations = 0;
    bool operator==(const Outcome&) const = default;
  };
  static Outcome outcome_of(StudyRun& run) {
    Outcome found;
    found.record = to_json(run);
    found.record.erase("performance");
    for (const nlohmann::json& event : results::journal_events(run.options().folder))
      if (event.at("event") == "evaluation") {
        found.asked.insert(event.at("key").get<std::string>());
        ++found.evaluations;
      }
    return found;
  }
  Outcome in_one_process() {
    WorkOptions options;
    options.folder = folder / "one";
    options.make_executor = [] { return make_in_process_executor(fake_with_failures, 1); };
    StudyRun run(study(), options);
    run.run();
    return outcome_of(run);
  }
  /// Another process that works for `name`; it kills itself at its evaluation `last` (0: never).
  pid_t worker(const std::string& name, int last = 0) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    int count = 0;
    SharedWorkOptions options;
    options.patience = 20s;
    const auto evaluate = [&](const Request& request, const results::ProgressCallback&) {
      if (++count == last) ::kill(::getpid(), SIGKILL);
      std::this_thread::sleep_for(2ms);
      return fake_with_failures(request);
    };
    ::_exit(work_for(folder / name, evaluate, options) == SharedEnd::finished ? 0 : 1);
  }
  static int ended(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
  }
};

TEST_F(SharedTest, TwoProcessesGiveWhatOneGives) {
  const Outcome expected = in_one_process();
  const pid_t first = worker("many"), second = worker("many");
  StudyRun run(study(), shared_options("many"));
  run.run();
  EXPECT_EQ(outcome_of(run), expected);
  EXPECT_EQ(ended(first), 0);
  EXPECT_EQ(ended(second), 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "many" / "shared"));
}

// A claim of a dead process of this host is taken over by the next who wants it.
TEST_F(SharedTest, AKilledWorkerCostsNothingButItsTime) {
  const Outcome expected = in_one_process();
  std::mt19937 random(7);
  for (int round = 0; round < 2; ++round) {
    const std::string name = "killed-" + std::to_string(round);
    const pid_t dying = worker(name, 1 + static_cast<int>(random() % 8)), living = worker(name);
    StudyRun run(study(), shared_options(name));
    run.run();
    EXPECT_EQ(outcome_of(run), expected) << round;
    EXPECT_TRUE(WIFSIGNALED(ended(dying)));
    EXPECT_EQ(ended(living), 0);
  }
}

TEST_F(SharedTest, TheProcessThatAsksMayBeKilled) {
  const Outcome expected = in_one_process();
  std::mt19937 random(11);
  for (int round = 0; round < 2; ++round) {
    const std::string name = "asks-" + std::to_string(round);
    const pid_t first = worker(name), second = worker(name);
    const pid_t asking = ::fork();
    if (asking == 0) {
      StudyRun run(study(), shared_options(name));
      run.run();
      ::_exit(0);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50 + random() % 400));
    ::kill(asking, SIGKILL);
    ended(asking);
    StudyRun run(study(), shared_options(name, std::filesystem::exists(folder / name / "journal.jsonl")));
    run.run();
    EXPECT_EQ(outcome_of(run), expected) << round;
    EXPECT_EQ(ended(first), 0);
    EXPECT_EQ(ended(second), 0);
  }
}

TEST_F(SharedTest, ARequestIsTakenOnceAndAnswersAreFoundLater) {
  const SharedFolder shared(folder / "work");
  shared.begin();
  const Request request = make_request(DesignFile(), 3, 0.4);
  shared.publish("key", request);
  ASSERT_EQ(shared.keys(), std::vector<std::string>{"key"});
  EXPECT_TRUE(shared.claim_for_later("key", false));
  EXPECT_FALSE(shared.claim_for_later("key", false));
  EXPECT_FALSE(shared.claim("key"));
  EXPECT_TRUE(shared.claim_for_later("key", true)) << "by the word of the user";
  const auto taken = shared.read("key");
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->request.replicate, 3);
  const SharedRequest again = shared_request_from_json(nlohmann::json::parse(to_line(*taken)));
  EXPECT_EQ(again.request.full_key(), request.full_key());
  shared.deliver(again.full_key, {"key", completed(request), 1.5});
  shared.release("key");
  EXPECT_TRUE(shared.keys().empty());
  EXPECT_FALSE(shared.read("key"));
  // Whoever asks finds it; one that asks for a longer run under the same key does not.
  const auto answer = shared.delivered("key", request);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->evaluation.replicate, 3);
  EXPECT_EQ(answer->seconds, 1.5);
  EXPECT_FALSE(shared.delivered("key", make_request(DesignFile(), 3, 0.5)));
  EXPECT_FALSE(shared.delivered("key", request)) << "it is gone";
}

// What a worker tells is seen by the process that asks, while the worker holds the request and no longer.
TEST_F(SharedTest, TellsHowFarItHasCome) {
  const SharedFolder shared(folder / "told");
  shared.begin();
  const Request request = make_request(DesignFile(), 3, 0.4);
  SharedWorkOptions options;
  options.patience = std::chrono::duration<double>(0.0);
  options.between_signs = std::chrono::duration<double>(0.0);
  std::vector<std::string> heard;
  options.progress = [&](const std::string& key, const results::Progress& progress) {
    heard.push_back(key + ": " + progress.text);
  };
  std::vector<UnderWay> seen;
  const auto evaluate = [&](const Request& asked, const results::ProgressCallback& progress) {
    results::Progress now{0.25, "strain 10 %"};
    now.strain = 0.1;
    progress(now);
    seen = shared.under_way();
    return completed(asked);
  };
  shared.publish("key", request);
  EXPECT_EQ(work_for(folder / "told", evaluate, options), SharedEnd::idle);
  EXPECT_EQ(heard, std::vector<std::string>{"key: strain 10 %"});
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].key, "key");
  EXPECT_EQ(seen[0].progress.text, "strain 10 %");
  EXPECT_EQ(seen[0].progress.fraction, 0.25);
  EXPECT_GE(seen[0].seconds, 0.0);
  EXPECT_TRUE(shared.under_way().empty()) << "it is answered";
  // What was told by a process that has ended says nothing of now.
  shared.tell("key", 5.0, {0.5, "strain 20 %"});
  EXPECT_TRUE(shared.under_way().empty());
}

TEST_F(SharedTest, ATroubleIsTriedAgain) {
  const std::string name = "trouble";
  const pid_t child = ::fork();
  if (child == 0) {
    int count = 0;
    SharedWorkOptions options;
    options.patience = 20s;
    const auto evaluate = [&](const Request& request, const results::ProgressCallback&) {
      if (++count == 2) throw std::runtime_error("the disk is full");
      return fake_with_failures(request);
    };
    ::_exit(work_for(folder / name, evaluate, options) == SharedEnd::finished ? 0 : 1);
  }
  StudyRun run(study(), shared_options(name));
  run.run();
  EXPECT_EQ(run.status(), results::RunStatus::completed);
  EXPECT_EQ(run.retries(), 1);
  EXPECT_EQ(ended(child), 0);
}

}  // namespace
}  // namespace perfora::optimize
