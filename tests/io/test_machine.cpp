// What is here: limits of control groups read from made files; processors by affinity and environment.
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "io/control_group.h"
#include "io/memory.h"
#include "io/processors.h"

namespace perfora::io {
namespace {

namespace fs = std::filesystem;

class ControlGroups : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("groups-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    files_ = {folder_ / "membership", folder_ / "root"};
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }

  fs::path folder_;
  ControlGroupFiles files_;
};

TEST_F(ControlGroups, NothingToReadIsNoLimit) {
  EXPECT_FALSE(processor_quota(files_));
  EXPECT_FALSE(memory_quota(files_));
  EXPECT_EQ(usable_processors(files_), usable_processors({"/nowhere", "/nowhere"}));
}

TEST_F(ControlGroups, VersionTwoTakesTheSmallestOnTheWayUp) {
  write("membership", "0::/slice/job\n");
  write("root/slice/job/cpu.max", "max 100000\n");
  write("root/slice/cpu.max", "150000 100000\n");
  write("root/cpu.max", "800000 100000\n");
  write("root/slice/job/memory.max", "2000000000\n");
  write("root/slice/memory.max", "max\n");
  EXPECT_DOUBLE_EQ(processor_quota(files_).value(), 1.5);
  EXPECT_DOUBLE_EQ(memory_quota(files_).value(), 2e9);
}

TEST_F(ControlGroups, VersionOneHasFoldersOfControllers) {
  write("membership", "5:cpu,cpuacct:/job\n4:memory:/job\n");
  write("root/cpu/job/cpu.cfs_quota_us", "50000\n");
  write("root/cpu/job/cpu.cfs_period_us", "100000\n");
  write("root/cpu/cpu.cfs_quota_us", "-1\n");
  write("root/cpu/cpu.cfs_period_us", "100000\n");
  write("root/memory/job/memory.limit_in_bytes", "1000000\n");
  EXPECT_DOUBLE_EQ(processor_quota(files_).value(), 0.5);
  EXPECT_DOUBLE_EQ(memory_quota(files_).value(), 1e6);
  EXPECT_EQ(usable_processors(files_), 1) << "half a processor is one thread";
}

TEST(Processors, FollowTheAffinityMask) {
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  if (sched_setaffinity(0, sizeof one, &one) != 0) GTEST_SKIP() << "the mask cannot be set here";
  EXPECT_EQ(usable_processors(), 1);
  EXPECT_EQ(default_threads(), 1);
  sched_setaffinity(0, sizeof before, &before);
}

TEST(Processors, OpenMpVariableCanOnlyLower) {
  const int usable = usable_processors();
  setenv("OMP_NUM_THREADS", "1", 1);
  EXPECT_EQ(default_threads(), 1);
  setenv("OMP_NUM_THREADS", "100000", 1);
  EXPECT_EQ(default_threads(), usable);
  setenv("OMP_NUM_THREADS", "1,4", 1);  // levels of nesting
  EXPECT_EQ(default_threads(), 1);
  setenv("OMP_NUM_THREADS", "some", 1);
  EXPECT_EQ(default_threads(), usable);
  unsetenv("OMP_NUM_THREADS");
  EXPECT_GE(most_threads(), static_cast<int>(std::thread::hardware_concurrency()));
}

TEST(Memory, IsThatOfAMachine) {
  EXPECT_GT(usable_memory_bytes(), peak_memory_bytes());
}

}  // namespace
}  // namespace perfora::io
