// What is here: pictures of how runs collapse: their lines and rows. What is not: other pictures (test_plot.cpp).
#include <gtest/gtest.h>

#include <cmath>

#include "report/plot.h"
#include "results/run_file.h"
#include "tests/report/image.h"
#include "tests/results/synthetic_run.h"

namespace perfora::report {
namespace {

using results::testing::fresh_folder;
using results::testing::make_run;
using results::testing::write_run;
using testing::Image;

// Eight frames of a block eight times as wide as high: two in a line, each 749 by 94 points, four lines.
TEST(Collapse, OfWideBlocksTakesSeveralLines) {
  const auto folder = fresh_folder("collapse-wide");
  write_run(make_run(0.05, 2, 1e-3, 0.6), folder / "R.h5");
  results::RunResult run = results::read_run(folder / "R.h5");
  ASSERT_EQ(run.frames.size(), 8u);
  plot_collapse({{"as it is", run}}, folder / "square.png", {});
  const double shape = run.height / run.width;
  run.width = 8.0 * run.height;  // its discs fill the left of that width
  plot_collapse({{"wide", run}}, folder / "wide.png", {});
  const Image square(folder / "square.png"), wide(folder / "wide.png");
  // The one line of the other: eight blocks 176.75 points wide, a gap of 14 between them, captions of 62 points below.
  const int one_line = static_cast<int>(std::ceil(176.75 * shape + 62.0));
  EXPECT_EQ(wide.height() - (square.height() - one_line), 4 * (94 + 62)) << "lines of block and caption";
  const auto inked = [&](int x, int y) {
    for (int dy = 0; dy < 90; ++dy)
      for (int dx = 0; dx < 90; ++dx)
        if (wide.at(x + dx, y + dy) != 0xffffffu) return true;
    return false;
  };
  for (const int line : {0, 1, 2, 3})
    for (const int x : {44, 44 + 749 + 14}) EXPECT_TRUE(inked(x, 164 + line * 156)) << line << " " << x;
}

// Two rows of every frame; the page is as high as both need and shows what stands in the file.
TEST(Collapse, ARowARun) {
  const auto folder = fresh_folder("collapse");
  write_run(make_run(0.05, 2, 1e-3, 0.6), folder / "R.h5");
  const results::RunResult run = results::read_run(folder / "R.h5");
  plot_collapse({{"one", run}}, folder / "one.png", {});
  plot_collapse({{"one", run}, {"two", run}}, folder / "two.png", {});
  const Image one(folder / "one.png"), two(folder / "two.png");
  EXPECT_EQ(one.width(), 1600);
  EXPECT_GT(two.height(), one.height() + 100);
  // The second row is the first again, but for its label: the same blocks that much lower.
  const int lower = two.height() - one.height();
  int equal = 0, dark = 0;
  for (int y = 200; y < one.height() - 20; ++y)
    for (int x = 0; x < 1600; ++x) {
      if (two.at(x, y) == 0xffffffu) continue;
      ++dark;
      equal += two.at(x, y) == two.at(x, y + lower);
    }
  EXPECT_GT(dark, 1000);
  EXPECT_GT(equal, 0.95 * dark);  // rounding moves the rims of some discs by a shade
}

}  // namespace
}  // namespace perfora::report
