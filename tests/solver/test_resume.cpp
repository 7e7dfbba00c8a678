// What is here: runs that are stopped and resumed again and again, with other numbers of threads, end with the bits of
// the run that was never stopped; what is damaged in R.part/ is passed over or refused with its reason. What is not:
// the members of a checkpoint (test_checkpoint.cpp), kills by a signal (tests/app/test_kill_resume.cpp). Expected
// values: the straight run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "io/cancellation.h"
#include "io/files.h"
#include "io/hdf5.h"
#include "sample_packings.h"
#include "solver/run.h"
#include "solver/run_folder.h"
#include "tests/io/io_support.h"

namespace perfora::solver {
namespace {

namespace fs = std::filesystem;
using io::input_error;
using io::TemporaryFolder;
using ::testing::HasSubstr;

constexpr double pitch = 0.5e-3;

/// A block with a hole, so that its curve has a first peak.
struct Block {
  explicit Block(std::uint64_t seed)
      : packing(with_hole(test::jittered_packing(10, pitch, seed))), layout(test::no_holes(packing)) {}

  static geometry::Packing with_hole(geometry::Packing whole) {
    constexpr double radius = 3.5 * pitch;
    geometry::Packing left = whole;
    left.x.clear(), left.y.clear(), left.radius.clear();
    for (std::size_t k = 0; k < whole.x.size(); ++k) {
      if (std::hypot(whole.x[k] - 0.5 * whole.width, whole.y[k] - 0.5 * whole.height) < radius) continue;
      left.x.push_back(whole.x[k]);
      left.y.push_back(whole.y[k]);
      left.radius.push_back(whole.radius[k]);
    }
    return left;
  }

  RunRequest request(const fs::path& file) const {
    RunRequest made;
    made.clipped = &packing;
    made.layout = &layout;
    made.options.loading.until = 0.012;
    made.options.material.strength = 0.1;  // brittle for its size
    made.options.loading.transits = 3.0;
    made.options.noise.kind = NoiseKind::weibull;
    made.options.output.frames = FrameChoice::all;
    made.mean_diameter = pitch;
    made.run_file = file;
    made.provenance.config = "[design]\nuntil = 0.012\n";
    return made;
  }

  geometry::Packing packing;
  geometry::PerforationLayout layout;
};

fs::path part_of(fs::path file) {
  return file.replace_extension(".part");
}

/// Goes on for `looks` looks at the stress (every 0.05 % of strain), then asks for a stop.
Response go_on(RunRequest request, int looks, bool resume) {
  io::CancellationSource source;
  request.cancellation = source.token();
  request.resume = resume;
  request.progress = [&, seen = 0](const results::Progress&) mutable {
    if (++seen == looks) source.request();
  };
  return run_compression(request);
}

void expect_same_run(const fs::path& a, const fs::path& b) {
  const io::Hdf5Reader first(a), second(b);
  ASSERT_EQ(first.children("/history"), second.children("/history"));
  for (const std::string& column : first.children("/history"))
    EXPECT_EQ(first.doubles("/history/" + column), second.doubles("/history/" + column)) << column;
  for (const char* column : {"/events/time", "/events/energy", "/events/x"})
    EXPECT_EQ(first.doubles(column), second.doubles(column)) << column;
  EXPECT_EQ(first.int32s("/events/bond"), second.int32s("/events/bond"));
  ASSERT_EQ(first.children("/frames"), second.children("/frames"));
  for (const std::string& frame : first.children("/frames")) {
    EXPECT_EQ(first.attribute_double("/frames/" + frame, "strain"),
              second.attribute_double("/frames/" + frame, "strain"));
    for (const char* field : {"/discs/position", "/discs/angle", "/bonds/damage"})
      EXPECT_EQ(first.doubles("/frames/" + frame + field), second.doubles("/frames/" + frame + field)) << frame;
  }
}

void expect_same_summary(const results::Summary& a, const results::Summary& b) {
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.broken_bonds, b.broken_bonds);
  const auto same = [](double one, double other) { return one == other || (std::isnan(one) && std::isnan(other)); };
  EXPECT_PRED2(same, a.first_peak_stress, b.first_peak_stress);
  EXPECT_PRED2(same, a.kinetic_ratio_at_peak, b.kinetic_ratio_at_peak);
  EXPECT_EQ(a.energy_residual, b.energy_residual);
}

/// PERFORA_LONG_RESUME_TEST: many seeds (label slow).
#if defined(PERFORA_LONG_RESUME_TEST)
constexpr int seeds = 120;
#else
constexpr int seeds = 5;
#endif

// Seeds go round edges, kernels, frames, rates and the strictness of checkpoints; each run is cut at random places.
TEST(Resume, SameBitsAsTheStraightRunWhereverItIsCut) {
  const TemporaryFolder folder;
  int cuts = 0, peaks = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    const Block block(static_cast<std::uint64_t>(seed + 1));
    RunRequest request = block.request(folder / "straight.h5");
    request.options.boundary.top_bottom = seed % 2 == 0 ? TopBottom::periodic : TopBottom::platens;
    request.options.boundary.sides = seed % 3 == 0 ? Sides::periodic : (seed % 3 == 1 ? Sides::walls : Sides::free);
    request.options.dynamics.kernel = seed % 5 == 4 ? KernelChoice::reference : KernelChoice::openmp;
    request.options.dynamics.cundall_scope = seed % 4 == 1 ? CundallScope::bonded : CundallScope::all;
    request.options.output.history_interval = seed % 2 == 0 ? 5e-4 : 7.3e-4;
    request.options.output.checkpoint_interval = seed % 4 == 0 ? 0.02 : 60.0;
    request.options.output.frames = seed % 6 == 5 ? FrameChoice::none : FrameChoice::all;
    if (seed % 4 == 3) request.options.loading.rate = 40.0;
    if (seed % 5 == 2) request.options.material.strength = 0.5;  // no first peak
    request.noise_seed = static_cast<std::uint64_t>(seed + 3);
    const Response straight = run_compression(request);
    ASSERT_EQ(straight.summary.status, results::RunStatus::completed) << straight.summary.reason;
    peaks += std::isnan(straight.summary.first_peak_stress) ? 0 : 1;

    request.run_file = folder / "cut.h5";
    fs::remove(request.run_file);
    Response last;
    bool resume = false;
    do {
      request.threads = 1 + static_cast<int>(random() % 2);
      last = go_on(request, 1 + static_cast<int>(random() % 9), resume);
      resume = true;
      ++cuts;
    } while (last.summary.status == results::RunStatus::stopped);
    ASSERT_EQ(last.summary.status, results::RunStatus::completed) << last.summary.reason;
    EXPECT_FALSE(fs::exists(part_of(request.run_file)));
    expect_same_run(folder / "straight.h5", request.run_file);
    expect_same_summary(straight.summary, last.summary);
  }
  EXPECT_GT(cuts, 3 * seeds);
  EXPECT_GT(peaks, seeds / 2);
}

/// A run that was stopped twice, so that two checkpoints stand in its folder, beside the straight one.
class ResumeTest : public testing::Test {
 protected:
  ResumeTest() : block(3), request(block.request(folder / "cut.h5")), part(part_of(request.run_file)) {
    RunRequest whole = block.request(folder / "straight.h5");
    straight = run_compression(whole);
    EXPECT_EQ(go_on(request, 9, false).summary.status, results::RunStatus::stopped);
    EXPECT_EQ(go_on(request, 13, true).summary.status, results::RunStatus::stopped);
    EXPECT_TRUE(fs::exists(older()));
    EXPECT_TRUE(fs::exists(newer()));
    request.resume = true;
  }

  fs::path older() const { return part / "checkpoint.h5"; }
  fs::path newer() const { return part / "checkpoint-2.h5"; }
  static void damage(const fs::path& file) {
    std::string text = io::read_file(file);
    text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 0x10);
    std::ofstream(file, std::ios::binary) << text;
  }
  /// The frame files, by rising step.
  std::vector<fs::path> frames() const {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(part / "frames")) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }
  /// What the resumed run says on standard error.
  std::string resumed_with(results::RunStatus wanted) {
    testing::internal::CaptureStderr();
    const Response last = run_compression(request);
    EXPECT_EQ(last.summary.status, wanted);
    return testing::internal::GetCapturedStderr();
  }

  const TemporaryFolder folder;
  const Block block;
  RunRequest request;
  fs::path part;
  Response straight;
};

TEST_F(ResumeTest, ADamagedNewestCheckpointCostsTheWayFromTheOneBefore) {
  damage(newer());
  EXPECT_THAT(resumed_with(results::RunStatus::completed),
              testing::AllOf(HasSubstr("a checkpoint is passed over"), HasSubstr("checkpoint-2.h5"),
                             HasSubstr("goes on from"), HasSubstr("checkpoint.h5")));
  expect_same_run(folder / "straight.h5", request.run_file);
}

TEST_F(ResumeTest, TheNewestSoundOneIsTaken) {
  damage(older());
  EXPECT_THAT(resumed_with(results::RunStatus::completed), HasSubstr("a checkpoint is passed over"));
  expect_same_run(folder / "straight.h5", request.run_file);
}

TEST_F(ResumeTest, NoneThatIsSoundIsRefusedWithBothReasons) {
  damage(newer());
  fs::resize_file(older(), fs::file_size(older()) / 2);
  EXPECT_THAT(input_error([&] { run_compression(request); }),
              testing::AllOf(HasSubstr("cut.part"), HasSubstr("checkpoint.h5"), HasSubstr("checkpoint-2.h5"),
                             HasSubstr("--force")));
  EXPECT_TRUE(fs::exists(newer())) << "a refusal destroys nothing";
}

TEST_F(ResumeTest, AnotherConfigurationIsRefusedAnotherEndIsNot) {
  request.provenance.config = "[design]\nuntil = 0.012\nwidth = 1\n";
  EXPECT_THAT(input_error([&] { run_compression(request); }), HasSubstr("another configuration"));
  request.provenance.config = "[design]\nuntil = 0.0115\n";
  request.options.loading.until = 0.0115;
  EXPECT_EQ(run_compression(request).summary.status, results::RunStatus::completed);
}

// A kill at a write leaves what stood there before and a temporary file; the next run goes on.
TEST_F(ResumeTest, WhatAKillLeavesIsGoneOnWith) {
  std::ofstream(part / "checkpoint.h5.tmp-1") << "half a checkpoint";
  std::ofstream(part / "frames" / "000000000001.h5.tmp-1") << "half a frame";
  EXPECT_THAT(resumed_with(results::RunStatus::completed), testing::Not(HasSubstr("passed over")));
  expect_same_run(folder / "straight.h5", request.run_file);
}

// Frames written after the last checkpoint, by a run that was killed then, are written again.
TEST_F(ResumeTest, ACheckpointThatIsLostTakesItsFramesAlong) {
  fs::remove(newer());
  EXPECT_THAT(resumed_with(results::RunStatus::completed), testing::Not(HasSubstr("warning")));
  expect_same_run(folder / "straight.h5", request.run_file);
}

TEST_F(ResumeTest, AFrameThatOnlyTheNewestNamesIsTakenAgain) {
  const std::vector<fs::path> files = frames();
  ASSERT_GE(files.size(), 3u);
  fs::remove(files.back());
  EXPECT_THAT(resumed_with(results::RunStatus::completed),
              testing::AllOf(HasSubstr("takes the frame again"), HasSubstr(files.back().filename().string())));
  expect_same_run(folder / "straight.h5", request.run_file);
}

TEST_F(ResumeTest, AFrameThatIsLostIsSaidAndTheRunIsNotLost) {
  const std::vector<fs::path> files = frames();
  damage(files[0]);
  EXPECT_THAT(
      resumed_with(results::RunStatus::completed),
      testing::AllOf(HasSubstr("is lost"), HasSubstr("goes on without it"), HasSubstr(files[0].filename().string())));
  const io::Hdf5Reader first(folder / "straight.h5"), second(request.run_file);
  EXPECT_EQ(first.doubles("/history/stress_yy"), second.doubles("/history/stress_yy"));
  EXPECT_EQ(second.children("/frames").size() + 1, first.children("/frames").size());
}

TEST_F(ResumeTest, TheFolderOfAFinishedRunIsRemovedHoweverLittleIsLeftOfIt) {
  const RunFolder left(request.run_file);
  fs::remove(older());
  left.remove();
  EXPECT_FALSE(fs::exists(part));
  EXPECT_NO_THROW(left.remove());
}

}  // namespace
}  // namespace perfora::solver
