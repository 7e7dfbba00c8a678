// What is here: signals that end the program: every kind gives a checkpoint and exit code 75 while there is something
// to keep, and an end within a second with nothing left behind where there is not. What is not: SIGKILL
// (test_kill_resume.cpp). Expected: the exit codes of the documentation.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/processes.h"

namespace perfora {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// The program in a folder of its own.
class Signals : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    std::string pattern = fs::temp_directory_path() / "perfora-signals.XXXXXX";
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> command(const std::string& verb, const std::vector<std::string>& more) const {
    std::vector<std::string> all = {verb, std::string(PERFORA_SOURCE_DIR) + "/designs/quick.toml", "--quiet",
                                    "--threads", "1"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  static void wait_for(const fs::path& path) {
    const auto give_up = Clock::now() + std::chrono::seconds(60);
    while (!fs::exists(path) && Clock::now() < give_up) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }

  struct End {
    int exit_code;  ///< minus the signal that ended it
    double seconds;
  };
  /// Sends `signal` after `delay` and waits for the end.
  static End end_by(pid_t pid, int signal, std::chrono::milliseconds delay) {
    std::this_thread::sleep_for(delay);
    const Clock::time_point sent = Clock::now();
    kill(pid, signal);
    const int exit_code = finish(pid);
    return {exit_code, std::chrono::duration<double>(Clock::now() - sent).count()};
  }
  std::vector<std::string> left_behind() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename());
    return names;
  }

  fs::path folder_;
};

TEST_P(Signals, ACompressionWritesACheckpoint) {
  const fs::path out = folder_ / "r.h5";
  const pid_t pid = start(command("evaluate", {"-o", out, "--set", "output.checkpoint_interval=0.05"}));
  wait_for(folder_ / "r.part");
  EXPECT_EQ(end_by(pid, GetParam(), std::chrono::milliseconds(200)).exit_code, 75);
  EXPECT_TRUE(fs::exists(folder_ / "r.part"));
  EXPECT_TRUE(fs::exists(out)) << "what a stopped run has measured so far";
}

// A packing of 250,000 discs takes many seconds.
TEST_P(Signals, APackingEndsAtOnce) {
  for (const char* verb : {"pack", "evaluate"}) {
    const pid_t pid = start(command(verb, {"-o", folder_ / "p.h5", "--set", "cell.width=\"400 mm\"", "--set",
                                           "cell.height=\"400 mm\"", "--set", "layout.family=none"}));
    wait_for(folder_ / "p.h5.lock");  // the program is awake, the packing begins
    const End end = end_by(pid, GetParam(), std::chrono::milliseconds(200));
    EXPECT_EQ(end.exit_code, 75) << verb;
    EXPECT_LT(end.seconds, 5.0) << verb;  // a second is promised; machines of tests are loaded
    EXPECT_EQ(left_behind(), std::vector<std::string>()) << verb;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Signals, testing::Values(SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGXCPU),
                         [](const auto& info) { return std::string(sigabbrev_np(info.param)); });

}  // namespace
}  // namespace perfora
