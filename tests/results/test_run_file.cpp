// What is here: R.h5 and P.h5 come back as they were written; bad files are refused in words. What is not: pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/error.h"
#include "io/hdf5.h"
#include "results/pack_file.h"
#include "results/run_file.h"
#include "results/summary_numbers.h"
#include "tests/results/synthetic_run.h"

namespace perfora::results {
namespace {

using testing::fresh_folder;
using ::testing::HasSubstr;
using testing::make_run;
using testing::SyntheticRun;

const SyntheticRun& small_run() {
  static const SyntheticRun run = make_run(0.05, 2, 1e-3, 0.6);
  return run;
}

std::string refusal(const std::filesystem::path& path) {
  try {
    const RunResult run = read_run(path);
    for (std::size_t k = 0; k < run.frames.size(); ++k) read_frame(run, k);
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "";
}

// What was written is the expectation.
TEST(ReadRun, GivesBackWhatWasWritten) {
  const SyntheticRun& written = small_run();
  const auto path = fresh_folder("round-trip") / "R.h5";
  write_run(written, path);
  const RunResult run = read_run(path);
  EXPECT_EQ(run.status, "completed");
  EXPECT_EQ(run.width, 0.05);
  EXPECT_EQ(run.mean_diameter, 1e-3);
  EXPECT_EQ(run.history.stress_yy, written.run.history.stress_yy);
  EXPECT_EQ(run.history.filled_columns(), 10u);
  EXPECT_EQ(run.bonds.pairs, written.run.bonds.pairs);
  ASSERT_EQ(run.events.size(), written.run.events.size());
  for (std::size_t k = 0; k < run.events.size(); ++k) {
    EXPECT_EQ(run.events[k].mode, written.run.events[k].mode);
    EXPECT_EQ(run.events[k].strain, written.run.events[k].strain);
  }
  EXPECT_EQ(run.clipped.radius, written.run.clipped.radius);
  EXPECT_EQ(run.layout.perforations.size(), 4u);
  EXPECT_EQ(run.summary, written.run.summary);
  EXPECT_EQ(run.provenance.config, written.run.provenance.config);
  ASSERT_EQ(run.frames.size(), written.frames.size());
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    const Frame frame = read_frame(run, k);
    EXPECT_EQ(frame.info.strain, written.frames[k].info.strain);
    EXPECT_EQ(frame.position, written.frames[k].position);
    EXPECT_EQ(frame.fragment, written.frames[k].fragment);
    EXPECT_EQ(frame.bond_pairs, written.frames[k].bond_pairs);
  }
}

TEST(ReadRun, RefusesAnotherFormat) {
  const auto folder = fresh_folder("format");
  write_pack(small_run(), folder / "P.h5");
  EXPECT_THAT(refusal(folder / "P.h5"), HasSubstr("perfora.pack/1"));
  {
    io::Hdf5Writer file(folder / "other.h5");
    file.group("/history");
    file.commit();
  }
  EXPECT_THAT(refusal(folder / "other.h5"), HasSubstr("no attribute `format`"));
  EXPECT_THAT(refusal(folder / "missing.h5"), HasSubstr("missing.h5"));
}

/// A run with one thing wrong in it.
template <class Break>
std::string refusal_of(const std::string& name, const Break& spoil) {
  SyntheticRun broken = small_run();
  spoil(broken);
  const auto path = fresh_folder(name) / "R.h5";
  write_run(broken, path);
  return refusal(path);
}

TEST(ReadRun, RefusesColumnsOfUnequalLength) {
  EXPECT_THAT(refusal_of("unequal", [](SyntheticRun& run) { run.run.history.stress_yy.pop_back(); }),
              HasSubstr("/history/stress_yy: has 1200 numbers where 1201 belong"));
}

TEST(ReadRun, RefusesNumbersThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal_of("nan", [&](SyntheticRun& run) { run.run.history.stress_yy[7] = nan; }),
              HasSubstr("/history/stress_yy: entry 7 is nan"));
  EXPECT_THAT(refusal_of("nan-position", [&](SyntheticRun& run) { run.frames[1].position[3] = nan; }),
              HasSubstr("/frames/00001/discs/position: entry 3 is nan"));
  EXPECT_THAT(refusal_of("radius", [](SyntheticRun& run) { run.run.clipped.radius[5] = -1.0; }), HasSubstr("radius"));
}

TEST(ReadRun, RefusesIndicesOutsideTheDiscs) {
  EXPECT_THAT(refusal_of("pairs", [](SyntheticRun& run) { run.frames[2].bond_pairs[0] = 99999; }),
              HasSubstr("names disc 99999"));
  EXPECT_THAT(refusal_of("events", [](SyntheticRun& run) { run.run.events[0].i = -1; }),
              HasSubstr("/events/i: names disc -1"));
  EXPECT_THAT(refusal_of("cell", [](SyntheticRun& run) { run.frames[0].info.h_yy = 0.0; }), HasSubstr("positive size"));
}

TEST(ReadPack, GivesBackWhatWasWritten) {
  const auto path = fresh_folder("pack") / "P.h5";
  write_pack(small_run(), path);
  const PackResult pack = read_pack(path);
  EXPECT_EQ(pack.clipped.x, small_run().run.clipped.x);
  EXPECT_EQ(pack.layout.perforations.size(), 4u);
  EXPECT_EQ(summary_number(pack.summary, "thinnest_wall"), 0.005);
}

TEST(Summary, NullAndMissingAreNotReached) {
  const nlohmann::json summary = {{"a", nullptr}, {"b", 2.5}, {"summary", {{"c", 3}}}};
  EXPECT_EQ(summary_number(summary, "a"), std::nullopt);
  EXPECT_EQ(summary_number(summary, "d"), std::nullopt);
  EXPECT_EQ(summary_number(summary, "b"), 2.5);
  EXPECT_EQ(summary_number(summary, "c"), 3.0);
  EXPECT_EQ(plateau_window({{"plateau_window", {0.2, 0.4}}}), std::pair(0.2, 0.4));
  EXPECT_EQ(plateau_window({{"plateau_window", nullptr}}), std::nullopt);
}

// 17 digits give every double back (IEEE 754).
TEST(HistoryCsv, EveryNumberComesBack) {
  const RunResult& run = small_run().run;
  const std::string text = history_csv(run.history);
  EXPECT_THAT(text, ::testing::StartsWith("strain_yy,strain_yy_log,stress_yy,"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), static_cast<std::ptrdiff_t>(run.history.rows() + 1));
  const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
  EXPECT_EQ(std::strtod(text.c_str() + last, nullptr), run.history.strain_yy.back());
}

}  // namespace
}  // namespace perfora::results
