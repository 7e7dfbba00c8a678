// What is here: pictures are drawn whole, in every kind of file, fast, with the right pixels in the right places.
// What is not: whether they are beautiful.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "io/error.h"
#include "io/files.h"
#include "report/block_picture.h"
#include "report/chart.h"
#include "report/plot.h"
#include "report/plot_correlation.h"
#include "report/plot_study.h"
#include "report/plot_sweep.h"
#include "report/search_panel.h"
#include "tests/report/image.h"
#include "tests/results/synthetic_run.h"

namespace perfora::report {
namespace {

using results::testing::fresh_folder;
using results::testing::make_run;
using results::testing::SyntheticRun;
using testing::Image;

// 1, 2, 5 times powers of ten: by hand.
TEST(Ticks, AreRound) {
  EXPECT_THAT(nice_ticks(0.0, 60.0, 6), ::testing::ElementsAre(0, 10, 20, 30, 40, 50, 60));
  EXPECT_THAT(tick_texts(nice_ticks(0.0, 0.7, 7)),
              ::testing::ElementsAre("0.0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"));
  EXPECT_THAT(tick_texts(nice_ticks(-0.03, 0.05, 4)), ::testing::ElementsAre("-0.02", "0.00", "0.02", "0.04"));
  EXPECT_THAT(decade_ticks(0.004, 2.0),
              ::testing::ElementsAre(::testing::DoubleEq(0.01), ::testing::DoubleEq(0.1), ::testing::DoubleEq(1.0)));
  EXPECT_TRUE(nice_ticks(1.0, 1.0, 5).empty());
}

class TicksOfRanges : public ::testing::TestWithParam<unsigned> {};
TEST_P(TicksOfRanges, LieWithinAndAreNotTooMany) {
  const double low = std::sin(GetParam()) * std::pow(10.0, static_cast<int>(GetParam() % 13) - 6);
  const double high =
      low + std::pow(10.0, static_cast<int>(GetParam() % 7) - 3) * (1.0 + std::abs(std::cos(GetParam())));
  const std::vector<double> ticks = nice_ticks(low, high, 6);
  ASSERT_GE(ticks.size(), 2u);
  EXPECT_LE(ticks.size(), 13u);
  const double slack = 1e-6 * (high - low);
  for (double tick : ticks) {
    EXPECT_GE(tick, low - slack);
    EXPECT_LE(tick, high + slack);
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, TicksOfRanges, ::testing::Range(1u, 60u));

// Two discs of fragments 1 and 2 side by side must not share a colour; fragment 0 has none; crumbs have theirs.
TEST(FragmentColours, DifferWhereFragmentsTouch) {
  results::Frame frame;
  frame.info.h_xx = frame.info.h_yy = 0.1;
  std::vector<double> radius;
  const auto add = [&](double x, double y, std::int32_t fragment) {
    frame.position.insert(frame.position.end(), {x, y});
    frame.fragment.push_back(fragment);
    radius.push_back(0.5e-3);
  };
  for (int k = 0; k < 50; ++k) add(0.01 + 1e-3 * (k % 10), 0.05 + 1e-3 * (k / 10), 0);
  // A chequer of 5 x 5 fragments of 3 x 3 discs each.
  for (int k = 0; k < 225; ++k) add(0.05 + 1e-3 * (k % 15), 0.05 + 1e-3 * (k / 15), 1 + (k % 15) / 3 + 5 * (k / 45));
  add(0.09, 0.09, 26);
  const std::vector<int> colour = colour_fragments(frame, radius, 5);
  ASSERT_EQ(colour.size(), 27u);
  EXPECT_EQ(colour[0], main_colour);
  EXPECT_EQ(colour[26], dust_colour);
  for (std::size_t row = 0; row < 5; ++row)
    for (std::size_t column = 0; column < 5; ++column) {
      const std::size_t here = 1 + column + 5 * row;
      if (column < 4) {
        EXPECT_NE(colour[here], colour[here + 1]);
      }
      if (row < 4) {
        EXPECT_NE(colour[here], colour[here + 5]);
      }
    }
}

// A cell of 10 x 10 mm drawn on 100 x 100 pixels: one disc at the corner shows in all four corners (periodic), y points
// up.
TEST(Block, PeriodicImagesAndDirections) {
  const auto path = fresh_folder("block") / "b.png";
  BlockPicture block;
  block.h_xx = block.h_yy = 0.01;
  block.x = {0.0, 0.005};
  block.y = {0.0, 0.0075};
  block.radius = {1e-3, 1e-3};
  block.colour = {hex(0xff0000), hex(0x0000ff)};
  block.growth = {0.0, 0.0};
  Canvas canvas(path, 120.0, 120.0);
  draw_block(canvas, {10.0, 10.0, 100.0, 100.0}, block);
  canvas.write();
  const Image image(path);
  for (const auto& [x, y] : {std::pair(14, 14), std::pair(105, 14), std::pair(14, 105), std::pair(105, 105)})
    EXPECT_EQ(image.at(x, y), 0xff0000u) << x << ' ' << y;
  EXPECT_EQ(image.at(60, 35), 0x0000ffu);  // 7.5 mm up is 75 pixels above the lower rim
  EXPECT_EQ(image.at(60, 85), 0xffffffu);
  EXPECT_EQ(image.at(3, 3), 0xffffffu);  // nothing outside the cell
}

TEST(Block, KeepsItsShape) {
  BlockPicture block;
  block.h_xx = 0.15;
  block.h_yy = 0.06;
  const Box box = fit_block(block, {100.0, 50.0, 300.0, 300.0}, 0.0);
  EXPECT_DOUBLE_EQ(box.width, 300.0);
  EXPECT_DOUBLE_EQ(box.height, 120.0);
  EXPECT_DOUBLE_EQ(box.y, 50.0);
}

const SyntheticRun& small_run() {
  static const SyntheticRun run = make_run(0.05, 2, 1e-3, 0.6);
  return run;
}

TEST(PlotRun, WritesEveryKindOfPicture) {
  const auto folder = fresh_folder("plot");
  write_run(small_run(), folder / "R.h5");
  for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
    plot_run(folder / "R.h5", folder / name, {.title = "", .target_stress = 0.04e6});
    EXPECT_GT(std::filesystem::file_size(folder / name), 10'000u) << name;
  }
  const Image image(folder / "a.png");
  EXPECT_EQ(image.width(), 1600);
  EXPECT_EQ(image.height(), 1000);
  EXPECT_TRUE(io::read_file(folder / "a.pdf").starts_with("%PDF"));
  EXPECT_TRUE(io::read_file(folder / "a.svg").starts_with("<?xml"));
}

// Nothing numerical is expected: one more curve and its name change the picture, wherever it reaches.
TEST(PlotRun, DrawsMeasuredCurvesBesideTheRun) {
  const auto folder = fresh_folder("measured");
  write_run(small_run(), folder / "R.h5");
  plot_run(folder / "R.h5", folder / "a.svg");
  const results::Curve press{{0.0, 0.01, 0.9}, {0.0, 1e6, 2e3}, "press 7"};
  plot_run(folder / "R.h5", folder / "b.svg", {.title = "", .target_stress = {}, .measured = {press, press}});
  EXPECT_GT(std::filesystem::file_size(folder / "b.svg"), std::filesystem::file_size(folder / "a.svg"));
}

TEST(PlotRun, RefusesOtherExtensions) {
  const auto folder = fresh_folder("extension");
  write_run(small_run(), folder / "R.h5");
  for (const char* name : {"a.jpg", "a"}) {
    try {
      plot_run(folder / "R.h5", folder / name);
      ADD_FAILURE();
    } catch (const io::InputError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(".png, .svg or .pdf"));
    }
    EXPECT_FALSE(std::filesystem::exists(folder / name));
  }
}

TEST(PlotRun, TakesRunsThatEndedEarlyOrHaveNoFrames) {
  const auto folder = fresh_folder("early");
  for (double until : {0.0, 0.0005, 0.005, 0.05, 0.3}) {
    SyntheticRun run = make_run(0.05, 2, 2e-3, until);
    if (until < 0.009) run.run.summary["first_peak_strain"] = run.run.summary["first_peak_stress"] = nullptr;
    write_run(run, folder / "R.h5");
    plot_run(folder / "R.h5", folder / "R.png");
    EXPECT_EQ(Image(folder / "R.png").width(), 1600);
  }
  SyntheticRun run = make_run(0.05, 2, 2e-3, 0.3);
  run.frames.clear();
  run.run.summary = nlohmann::json::object();
  write_run(run, folder / "R.h5");
  plot_run(folder / "R.h5", folder / "R.png");
}

TEST(PlotRun, SnapshotsAreIntactPeakAndLast) {
  EXPECT_THAT(snapshot_frames(small_run().run), ::testing::ElementsAre(0, 1, 7));
  // Frames at 0, 0.9, 10, ... 60 %: two more lie at a third and two thirds of the last strain, 20 and 40 %.
  EXPECT_THAT(snapshot_frames(small_run().run, 5), ::testing::ElementsAre(0, 1, 3, 5, 7));
  results::RunResult run;
  EXPECT_TRUE(snapshot_frames(run).empty());
  run.frames.resize(1);
  EXPECT_THAT(snapshot_frames(run), ::testing::ElementsAre(0));
}

// The size of the paper's block (Table 1: 36,607 discs). How long it takes is noted, not judged.
TEST(PlotRun, TakesTheFullSize) {
  const SyntheticRun run = make_run(0.15, 6, 0.5044e-3, 0.6);
  ASSERT_GT(run.run.clipped.size(), 30'000);
  RunPicture picture{&run.run, {}};
  for (std::size_t k : snapshot_frames(run.run)) picture.snapshots.push_back({"", run.frames[k]});
  const auto path = fresh_folder("full") / "R.png";
  const auto begin = std::chrono::steady_clock::now();
  draw_run(picture, path);
  RecordProperty("seconds",
                 std::to_string(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()));
  EXPECT_EQ(Image(path).width(), 1600);
}

TEST(PlotPacking, WritesAPicture) {
  const auto folder = fresh_folder("plot-pack");
  write_pack(small_run(), folder / "P.h5");
  plot_packing(folder / "P.h5", folder / "P.png");
  EXPECT_EQ(Image(folder / "P.png").width(), 1600);
}

TEST(Study, IncumbentIsTheRunningMinimumOfFeasibleScores) {
  std::vector<results::StudyPoint> evaluations(6);
  const double scores[] = {3.0, 1.0, NAN, 2.0, 0.5, 0.7};
  for (std::size_t k = 0; k < 6; ++k) evaluations[k].score = scores[k];
  evaluations[1].feasible = false;
  EXPECT_THAT(incumbent_scores(evaluations), ::testing::ElementsAre(3.0, 3.0, 3.0, 2.0, 0.5, 0.5));
}

TEST(Study, AnEmptyAndAFullPictureAreDrawn) {
  const auto folder = fresh_folder("study");
  plot_study({}, folder / "empty.png");
  results::StudyRecord picture;
  picture.title = "Study";
  for (int k = 1; k <= 30; ++k)
    picture.points.push_back({k, "arm " + std::to_string(k % 12), {1.0}, k % 7 ? 10.0 / k : NAN, k % 5 != 0});
  picture.best_number = 29;
  picture.best.push_back({small_run().run.history.strain_yy, small_run().run.history.stress_yy});
  picture.start.push_back({{}, {}});
  picture.best_layout = picture.start_layout = small_run().run.layout;
  picture.best_plateau = 0.025e6;
  picture.target = 0.03e6;
  picture.facts = {{"diameter", "18.2 mm", "20 mm"}};
  plot_study(picture, folder / "full.png");
  EXPECT_EQ(Image(folder / "full.png").height(), 1000);
}

/// Mean height of the pixels of a colour right of `left`; 0 where there are none.
double mean_row(const Image& image, unsigned colour, int left, int right = 1600) {
  double sum = 0.0, count = 0.0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = left; x < std::min(right, image.width()); ++x)
      if (image.at(x, y) == colour) sum += y, count += 1.0;
  return count > 0.0 ? sum / count : 0.0;
}

TEST(Sweep, DrawsGroupsWithTheirResults) {
  const auto folder = fresh_folder("sweep");
  plot_sweep({}, folder / "empty.png");
  SweepPicture picture;
  picture.title = "Sweep";
  picture.measures = {"plateau_stress"};
  const results::Curve curve{small_run().run.history.strain_yy, small_run().run.history.stress_yy};
  SweepGroup group;
  group.label = "material.horizon";
  group.places = {"2", "3"};
  group.series = {""};
  group.points.push_back({0, 0, {curve, curve}, {{{1e4, 3e4}, 2e4, 1e4}}});
  group.points.push_back({1, 0, {curve}, {{{9e4}, 9e4, NAN}}});
  picture.groups = {group, group};
  picture.groups[1].places = {"a long name that has to stand upright because", "two of them do not fit"};
  picture.groups[1].points.push_back({1, 0, {}, {{{}, NAN, NAN}}});  // not run yet
  picture.base.push_back({0, 0, {curve}, {{{5e4, 5e4}, 5e4, 0.0}}});
  plot_sweep(picture, folder / "full.png");
  const Image image(folder / "full.png");
  EXPECT_EQ(image.width(), 1600);
  // Colours of the first and the last place: 20 kPa stands below 90 kPa.
  const double low = mean_row(image, 0x2d4a9a, 650), high = mean_row(image, 0xc8401c, 650);
  EXPECT_GT(low, 0.0);
  EXPECT_GT(high, 0.0);
  EXPECT_GT(low, high);
  EXPECT_THROW(plot_sweep(picture, folder / "full.gif"), io::InputError);
}

// Two blocks at 100 and 300 kPa: three level blue lines, of both and of their mean, where nothing stands beside them.
TEST(Sweep, OneCaseShowsTheCurveOfEachBlock) {
  const auto folder = fresh_folder("sweep_alone");
  SweepPicture picture;
  picture.measures = {"plateau_stress"};
  SweepGroup group;
  group.series = {""};
  group.places = {"alone"};
  const results::Curve low{{0.0, 0.2, 0.4}, {1e5, 1e5, 1e5}}, high{{0.0, 0.2, 0.4}, {3e5, 3e5, 3e5}};
  group.points.push_back({0, 0, {low, high}, {{{1e5, 3e5}, 2e5, NAN}}});
  picture.groups = {group};
  const auto level_lines = [&] {
    plot_sweep(picture, folder / "s.png");
    const Image image(folder / "s.png");
    int lines = 0;
    bool before = false;
    for (int y = 150; y < image.height() - 100; ++y) {
      int blue = 0;
      for (int x = 130; x < 560; ++x) blue += (image.at(x, y) & 0xffu) > (image.at(x, y) >> 16) + 20u;
      lines += blue > 300 && !before;
      before = blue > 300;
    }
    return lines;
  };
  EXPECT_EQ(level_lines(), 3);
  picture.groups[0].places.push_back("another");
  picture.groups[0].points.push_back({1, 0, {}, {{{}, NAN, NAN}}});
  EXPECT_EQ(level_lines(), 1) << "beside others its mean alone";
}

// Names that would take more of the page than the panels stand in a list, a line each, however long they are.
TEST(Sweep, LongNamesStandInAList) {
  const auto folder = fresh_folder("sweep_names");
  SweepPicture picture;
  picture.measures = {"plateau_stress"};
  const auto height = [&](const std::vector<std::string>& names) {
    SweepGroup group;
    group.series = {""};
    group.places = names;
    for (int place = 0; place < static_cast<int>(names.size()); ++place)
      group.points.push_back({place, 0, {}, {{{1e4}, 1e4, NAN}}});
    picture.groups = {group};
    plot_sweep(picture, folder / "s.png");
    return Image(folder / "s.png").height();
  };
  const int lying = height({"a", "b"});
  const std::string longer(60, 'x'), longest(120, 'x');
  const int two = height({longer, longer}), three = height({longer, longer, longest});
  EXPECT_GT(two, lying);
  EXPECT_EQ(2 * (three - two), two - lying) << "one line each";
  EXPECT_GT(height({std::string(20, 'x'), std::string(20, 'x'), std::string(20, 'x'), std::string(20, 'x'),
                    std::string(20, 'x'), std::string(20, 'x')}),
            lying)
      << "shorter ones stand upright";
}

// Two cases on the diagonal: the one with the larger result stands higher, and as far right of the other as above it.
TEST(Correlation, DrawsAPointACase) {
  const auto folder = fresh_folder("correlation");
  plot_correlation({}, folder / "empty.png");
  CorrelationPicture picture;
  picture.reference = "dear";
  const auto draw = [&](double x, double y) {
    CorrelationPanel panel{
        "plateau_stress", "rank correlation", {{"low", 1e4, 0.0, 1e4, 0.0}, {"high", x, 1e3, y, NAN}}};
    panel.points.push_back({"unknown", NAN, NAN, 3e4, 1e3});
    picture.rows = {{"cheap", {panel}}};
    plot_correlation(picture, folder / "c.png");
    return Image(folder / "c.png").height();
  };
  EXPECT_GT(draw(6e4, 6e4), 500);
  const double level = mean_row(Image(folder / "c.png"), 0x0072b2, 100);
  draw(6e4, 1e4);
  EXPECT_GT(mean_row(Image(folder / "c.png"), 0x0072b2, 100), level) << "the second point has come down";
  EXPECT_THROW(plot_correlation(picture, folder / "c.gif"), io::InputError);
}

// Runs of two designs have two colours, two runs of one design a colour and a lighter one. The page grows with the
// table where that is longer than the charts.
TEST(Comparison, ColoursSayTheDesign) {
  constexpr unsigned blue = 0x0072b2, orange = 0xe69f00, light_blue = 0x80b9d9;  // first two of the series; half white
  const auto folder = fresh_folder("comparison");
  write_run(small_run(), folder / "R.h5");
  const results::RunResult run = results::read_run(folder / "R.h5");
  const auto count = [&](const std::vector<LabelledRun>& runs, unsigned colour) {
    plot_comparison(runs, folder / "c.png", {});
    const Image image(folder / "c.png");
    int found = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) found += image.at(x, y) == colour;
    return found;
  };
  const std::vector<LabelledRun> two_designs{{"one", run, "a"}, {"two", run, "b"}};
  EXPECT_GT(count(two_designs, blue), 50);
  EXPECT_GT(count(two_designs, orange), 50);
  const std::vector<LabelledRun> three_runs{{"one", run, "a"}, {"two", run, "a"}, {"three", run, "b"}};
  EXPECT_GT(count(three_runs, light_blue), 50);
  EXPECT_GT(count(three_runs, orange), 50);
  EXPECT_GT(count({{"one", run, "a"}, {"two", run, "a"}}, orange), 50) << "one design only: a colour a run";
  const int height = Image(folder / "c.png").height();
  count(std::vector<LabelledRun>(40, {"one", run, "a"}), blue);
  EXPECT_GT(Image(folder / "c.png").height(), height + 100);
  EXPECT_THROW(plot_comparison(two_designs, folder / "c.gif", {}), io::InputError);
  EXPECT_THROW(plot_comparison({}, folder / "none.png", {}), io::InputError);
}

// The linear axis reaches to the highest first peak whatever the order, also beside a run that was stopped before its
// peak was known: the same curve ends in the same row.
TEST(Comparison, AxisIsThatOfTheFirstPeaks) {
  const auto folder = fresh_folder("comparison-axis");
  write_run(small_run(), folder / "R.h5");
  const results::RunResult whole = results::read_run(folder / "R.h5");
  results::RunResult stopped = whole;
  stopped.summary.erase("first_peak_stress");
  for (double& value : stopped.history.stress_yy) value *= 1e-3;
  plot_comparison({{"one", whole, "a"}, {"two", stopped, "b"}}, folder / "ab.png", {});
  plot_comparison({{"two", stopped, "b"}, {"one", whole, "a"}}, folder / "ba.png", {});
  constexpr int charts_left = 130, charts_right = 1000;  // the table stands right of them
  EXPECT_NEAR(mean_row(Image(folder / "ab.png"), 0x0072b2, charts_left, charts_right),
              mean_row(Image(folder / "ba.png"), 0xe69f00, charts_left, charts_right), 2.0);
}

}  // namespace
}  // namespace perfora::report
