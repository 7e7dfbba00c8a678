// What is here: a compression that is asked to stop from another thread, and that only the one asked stops.
// What is not: tokens (io/test_cancellation.cpp), the bits of a checkpoint (test_walls.cpp).
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>

#include "io/cancellation.h"
#include "sample_packings.h"
#include "solver/material_test.h"
#include "solver/run.h"

namespace perfora::solver {
namespace {

constexpr double pitch = 0.5e-3;

class Stopping : public testing::Test {
 protected:
  Stopping() : packing(test::jittered_packing(12, pitch, 6)), layout(test::no_holes(packing)) {
    std::filesystem::remove(file);
    std::filesystem::remove_all(part);
  }
  ~Stopping() override {
    std::filesystem::remove(file);
    std::filesystem::remove_all(part);
  }

  RunRequest request() const {
    RunRequest made;
    made.clipped = &packing;
    made.layout = &layout;
    made.options.loading.until = 0.003;
    made.options.loading.rate = 20.0;
    made.mean_diameter = pitch;
    return made;
  }

  const geometry::Packing packing;
  const geometry::PerforationLayout layout;
  // Tests of this file may run at the same time, each in a process of its own.
  const std::string name = "perfora-test-stopping-" + std::to_string(::getpid());
  const std::filesystem::path file = std::filesystem::temp_directory_path() / (name + ".h5");
  const std::filesystem::path part = std::filesystem::temp_directory_path() / (name + ".part");
};

TEST_F(Stopping, TheRunThatIsAskedWritesACheckpointAndTheNextOneEnds) {
  const Response straight = run_compression(request());
  ASSERT_EQ(straight.summary.status, results::RunStatus::completed);

  io::CancellationSource source;
  RunRequest stopped = request();
  stopped.run_file = file;
  stopped.cancellation = source.token();
  stopped.progress = [&](const results::Progress&) {  // at the first row: another thread asks
    if (!source.token().requested()) std::thread([&] { source.request(); }).join();
  };
  const Response half = run_compression(stopped);
  EXPECT_EQ(half.summary.status, results::RunStatus::stopped);
  EXPECT_EQ(half.summary.reason, "signal");
  EXPECT_LT(half.history.rows(), straight.history.rows());
  EXPECT_TRUE(std::filesystem::exists(part / "checkpoint.h5"));

  // The source of the first run still asks; this one has a token of its own.
  RunRequest resumed = stopped;
  resumed.resume = true;
  resumed.progress = {};
  resumed.cancellation = io::CancellationSource().token();
  const Response whole = run_compression(resumed);
  EXPECT_EQ(whole.summary.status, results::RunStatus::completed);
  EXPECT_EQ(whole.history.stress_yy, straight.history.stress_yy);
}

TEST_F(Stopping, AMaterialTestStopsAtItsNextRow) {
  io::CancellationSource source;
  MaterialTestRequest test;
  test.sample = &packing;
  test.mean_diameter = pitch;
  test.cancellation = source.token();
  int rows = 0;
  test.progress = [&](double) {
    if (++rows == 2) source.request();
  };
  const MaterialTestResult result = run_material_test(test);
  EXPECT_EQ(result.status, results::RunStatus::stopped);
  EXPECT_EQ(result.reason, "signal");
  EXPECT_EQ(rows, 2);
}

}  // namespace
}  // namespace perfora::solver
