// What is here: A run killed by SIGKILL at random moments and resumed each time ends with the same bits as the run that
// was never stopped; so do one and two threads. Expected values: the straight run of the same program.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "io/hdf5.h"
#include "processes.h"

namespace perfora {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string until;
  int kills;
  double seconds;  ///< longest life of a run before it is killed
};

/// PERFORA_LONG_KILL_TEST=1 takes quick.toml to 60 % and kills it twenty times (some minutes); otherwise a short run.
Case wanted_case() {
  if (std::getenv("PERFORA_LONG_KILL_TEST") != nullptr) return {"0.6", 20, 4.0};
  return {"0.08", 5, 0.4};
}

std::vector<std::string> command(const fs::path& out, const std::string& until, int threads) {
  return {"evaluate",  std::string(PERFORA_SOURCE_DIR) + "/designs/quick.toml",
          "-o",        out.string(),
          "--until",   until,
          "--threads", std::to_string(threads),
          "--set",     "output.checkpoint_interval=0.2",
          "--quiet"};
}

void expect_same_run(const fs::path& a, const fs::path& b) {
  const io::Hdf5Reader first(a), second(b);
  for (const std::string& column : first.children("/history"))
    EXPECT_EQ(first.doubles("/history/" + column), second.doubles("/history/" + column)) << column;
  EXPECT_EQ(first.int32s("/events/bond"), second.int32s("/events/bond"));
  EXPECT_EQ(first.doubles("/events/time"), second.doubles("/events/time"));
  ASSERT_EQ(first.children("/frames"), second.children("/frames"));
  for (const std::string& frame : first.children("/frames"))
    EXPECT_EQ(first.doubles("/frames/" + frame + "/discs/position"),
              second.doubles("/frames/" + frame + "/discs/position"))
        << frame;
}

TEST(KillAndResume, SameBitsAsTheStraightRun) {
  const Case wanted = wanted_case();
  const fs::path folder = fs::temp_directory_path() / ("perfora-kill-" + std::to_string(getpid()));
  fs::create_directories(folder);
  ASSERT_EQ(finish(start(command(folder / "one.h5", wanted.until, 1))), 0);
  ASSERT_EQ(finish(start(command(folder / "two.h5", wanted.until, 2))), 0);
  expect_same_run(folder / "one.h5", folder / "two.h5");

  std::mt19937 random(20);  // moments differ with the machine's speed anyway
  int killed = 0, resumed = 0;
  for (bool done = false; !done;) {
    auto arguments = command(folder / "killed.h5", wanted.until, 1 + killed % 2);
    if (killed > 0) arguments.push_back("--resume");
    resumed += fs::exists(folder / "killed.part" / "checkpoint.h5") ? 1 : 0;
    const pid_t pid = start(arguments);
    if (killed < wanted.kills) {
      const double life = wanted.seconds * (0.25 + 0.75 * static_cast<double>(random()) / 4294967296.0);
      // The first checkpoint is waited for, however slow the machine; later moments fall anywhere, restarts included.
      const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(120);
      while (!fs::exists(folder / "killed.part" / "checkpoint.h5") && !fs::exists(folder / "killed.h5") &&
             std::chrono::steady_clock::now() < give_up)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      std::this_thread::sleep_for(std::chrono::duration<double>(life));
      kill(pid, SIGKILL);
    }
    const int code = finish(pid);
    if (code == -SIGKILL) {
      ++killed;
      EXPECT_FALSE(fs::exists(folder / "killed.h5"));  // nothing half-written appears under the final name
    } else {
      ASSERT_EQ(code, 0);
      done = true;
    }
  }
  RecordProperty("killed", killed);
  RecordProperty("resumed", resumed);
  EXPECT_GT(resumed, 0);
  EXPECT_FALSE(fs::exists(folder / "killed.part"));
  expect_same_run(folder / "one.h5", folder / "killed.h5");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace perfora
