// What is here: the XDMF file names datasets that exist, of the sizes it says. What is not: ParaView
// (tests/viewers/check_paraview.py).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "io/files.h"
#include "io/hdf5.h"
#include "report/export/xdmf.h"
#include "tests/results/synthetic_run.h"

namespace perfora::report {
namespace {

using results::testing::fresh_folder;

/// What stands between `before` and `after`, from `start` on.
std::string between(const std::string& text, const std::string& before, const std::string& after, std::size_t start) {
  const std::size_t begin = text.find(before, start) + before.size();
  return text.substr(begin, text.find(after, begin) - begin);
}

TEST(Xdmf, EveryItemIsADatasetOfThatShape) {
  const auto folder = fresh_folder("xdmf");
  results::testing::SyntheticRun run = results::testing::make_run(0.05, 2, 1e-3, 0.3);
  run.frames.back().bond_pairs.clear();
  run.frames.back().bond_damage.clear();
  write_run(run, folder / "my run.h5");
  write_xdmf(folder / "my run.h5", folder / "my run.xdmf");
  const std::string text = io::read_file(folder / "my run.xdmf");
  const std::string opening = "<DataItem Format=\"HDF\"";
  std::size_t items = 0;
  for (std::size_t at = text.find(opening); at != std::string::npos; at = text.find(opening, at + 1), ++items) {
    const std::string dimensions = between(text, "Dimensions=\"", "\"", at);
    const std::string file_name = between(text, ">", ":", at);
    const std::string dataset = between(text, ".h5:", "<", at);
    const io::Hdf5Reader file(folder / file_name);
    EXPECT_EQ(dimensions, fmt::format("{}", fmt::join(file.shape(dataset), " "))) << dataset;
  }
  EXPECT_EQ(items, 9u * run.frames.size());  // 6 of the discs, 3 of the bonds
  EXPECT_THAT(text, ::testing::HasSubstr(fmt::format("\"{}\"", run.frames[1].info.time)));
}

// results::Bonds across the boundary are lines through the whole block: every line left is shorter than the longest
// bond of the synthetic run, 1.9 diameters.
TEST(Xdmf, NoLineCrossesTheBlock) {
  const auto folder = fresh_folder("xdmf-lines");
  const results::testing::SyntheticRun run = results::testing::make_run(0.05, 2, 1e-3, 0.0);
  write_run(run, folder / "R.h5");
  write_xdmf(folder / "R.h5", folder / "R.xdmf");
  const io::Hdf5Reader file(folder / "R.xdmf.h5");
  const std::vector<std::int32_t> pairs = file.int32s("/frames/00000/bonds/pairs");
  EXPECT_LT(pairs.size(), run.frames[0].bond_pairs.size());
  EXPECT_GT(pairs.size(), run.frames[0].bond_pairs.size() * 9 / 10);
  for (std::size_t b = 0; b < pairs.size(); b += 2) {
    const auto i = static_cast<std::size_t>(pairs[b]);
    const auto j = static_cast<std::size_t>(pairs[b + 1]);
    const std::vector<double>& at = run.frames[0].position;
    EXPECT_LT(std::hypot(at[2 * i] - at[2 * j], at[2 * i + 1] - at[2 * j + 1]), 1.9e-3 + 1e-12);
  }
}

}  // namespace
}  // namespace perfora::report
