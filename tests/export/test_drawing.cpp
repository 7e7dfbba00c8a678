// What is here: workshop drawings: read back as layouts they give the holes they were made of, and say the numbers that
// the layout has by hand. What is not: how they look (printed and looked at by people), DXF in another program
// (tests/viewers/check_dxf.py).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <tuple>

#include "geometry/layout.h"
#include "geometry/wall.h"
#include "report/export/block_drawing.h"
#include "report/export/hole_list.h"
#include "tests/results/synthetic_run.h"

namespace perfora::report {
namespace {

using geometry::LayoutFamily;
using geometry::LayoutOptions;
using geometry::PerforationLayout;
using geometry::ShapeKind;
using ::testing::HasSubstr;

constexpr double micrometre = 1e-6;

BlockSheet sheet_of(const PerforationLayout& layout) {
  return {"A block & <co>", "test", layout, {{"material", "concrete"}}};
}

/// Farthest that the holes of `a` are from those of `b`, by centres and extents; both in the same order or not.
double difference(const PerforationLayout& a, const PerforationLayout& b) {
  double farthest = 0.0;
  for (const geometry::Perforation& hole : a.perforations) {
    double nearest = 1.0;
    for (const geometry::Perforation& other : b.perforations) {
      const double place =
          std::hypot(std::remainder(hole.x - other.x, a.width), std::remainder(hole.y - other.y, a.height));
      const auto box = hole.bounds(), other_box = other.bounds();
      nearest = std::min(nearest, std::max({place, std::abs(box.width() - other_box.width()),
                                            std::abs(box.height() - other_box.height()),
                                            std::abs(hole.largest_extent() - other.largest_extent()),
                                            std::abs(hole.area() - other.area()) / hole.largest_extent()}));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

class RoundTrip : public ::testing::TestWithParam<int> {};

LayoutOptions example(int number) {
  LayoutOptions options;
  options.width = 0.12;
  options.height = 0.09;
  options.rows = 2;
  options.columns = 3;
  options.diameter = 0.02;
  switch (number) {
    case 0:  // the middle of rows lies on the edges
      options.family = LayoutFamily::staggered;
      break;
    case 1:
      options.shape = ShapeKind::slot;
      options.aspect = 2.0;
      options.angle = 0.5;
      break;
    case 2:
      options.shape = ShapeKind::ellipse;
      options.aspect = 1.5;
      options.angle = -0.3;
      break;
    case 3:
      options.shape = ShapeKind::teardrop;
      options.aspect = 1.4;
      break;
    case 4:
      options.shape = ShapeKind::diamond;
      options.corner_radius = 0.002;
      break;
    default:
      options.family = LayoutFamily::random;
      options.count = 12;
      options.size_spread = 0.5;
      options.diameter = 0.012;
      options.minimum_wall = 0.003;
  }
  return options;
}

TEST_P(RoundTrip, ADrawingReadBackIsTheSameLayout) {
  const auto folder = results::testing::fresh_folder("drawing");
  const LayoutOptions options = example(GetParam());
  const PerforationLayout layout = geometry::make_layout(options, 5);
  const Drawing drawing = draw_block_sheet(sheet_of(layout));
  for (const char* name : {"block.svg", "block.dxf"}) {
    std::ofstream(folder / name) << (std::string(name).ends_with("svg") ? as_svg(drawing) : as_dxf(drawing));
    LayoutOptions list;
    list.width = options.width;
    list.height = options.height;
    list.family = LayoutFamily::list;
    list.file = folder / name;
    const PerforationLayout read = geometry::make_layout(list, 1);
    EXPECT_EQ(read.perforations.size(), layout.perforations.size()) << name;
    EXPECT_LT(difference(layout, read), micrometre) << name;
    EXPECT_NEAR(geometry::thinnest_wall(read).thickness, geometry::thinnest_wall(layout).thickness, micrometre) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Layouts, RoundTrip, ::testing::Range(0, 6));

// 6 x 6 holes of 20 mm in 150 mm: pitch 25 mm, the first 12.5 mm from the edge, walls of 5 mm; the block fits on A3.
TEST(Drawing, SaysTheDimensionsOfTable1) {
  LayoutOptions options;
  const PerforationLayout layout = geometry::make_layout(options, 1);
  const Drawing drawing = draw_block_sheet(sheet_of(layout));
  EXPECT_EQ(drawing.width, 420.0);
  EXPECT_EQ(drawing.height, 297.0);
  std::vector<std::string> texts;
  for (const auto& text : drawing.texts) texts.push_back(text.text);
  for (const char* wanted : {"150", "12.5", "5 x 25 = 125", "t 5", "Ø20", "36 x Ø20", "direction of loading", "36"})
    EXPECT_THAT(texts, ::testing::Contains(wanted));
  EXPECT_EQ(drawing.circles.size(), 36u);
  const std::string svg = as_svg(drawing);
  EXPECT_THAT(svg, HasSubstr("width=\"420mm\" height=\"297mm\" viewBox=\"0 0 420 297\""));
  EXPECT_THAT(svg, HasSubstr("A block &amp; &lt;co&gt;"));
  const std::string dxf = as_dxf(drawing);
  EXPECT_THAT(dxf, HasSubstr("%%c20"));
  for (const char c : dxf) ASSERT_LT(static_cast<unsigned char>(c), 0x80) << "R12 is ASCII";
}

// Blocks of many holes: each has a row in the list and a number beside its centre, on a larger sheet or in further
// columns. 48 x 10 slots of a block of 480 mm need them on A0.
TEST(Drawing, ListsEveryHole) {
  for (const auto& [rows, columns, width] : {std::tuple{5, 8, 0.1}, std::tuple{10, 48, 0.48}}) {
    LayoutOptions options;
    options.width = width;
    options.height = 0.04;
    options.rows = rows;
    options.columns = columns;
    options.shape = ShapeKind::slot;
    options.diameter = 0.0065;
    options.breadth = 0.0015;
    options.angle = 0.2;
    const Drawing drawing = draw_block_sheet(sheet_of(geometry::make_layout(options, 1)));
    const int holes = rows * columns;
    std::multiset<std::string> texts;
    for (const auto& text : drawing.texts) {
      texts.insert(text.text);
      EXPECT_THAT(text.text, ::testing::Not(HasSubstr("more: drawn"))) << holes;
    }
    for (int hole = 1; hole <= holes; ++hole)
      EXPECT_GE(texts.count(std::to_string(hole)), 2U) << hole << " of " << holes;
  }
}

// A long title and long notes are broken into lines, none is cut.
TEST(Drawing, LongTextsAreBrokenIntoLines) {
  BlockSheet sheet = sheet_of(geometry::make_layout(LayoutOptions(), 1));
  sheet.title = "Mortar block for a lining that gives way at eight hundred kilopascals";
  sheet.notes.emplace_back("mortar",
                           "C25/30, E 8 GPa, cast in Spring from the batch that was tested in March, see report 17");
  std::string all;
  for (const auto& text : draw_block_sheet(sheet).texts) all += text.text + " ";
  for (const std::string& whole : {sheet.title, sheet.notes.back().second}) {
    std::istringstream words(whole);
    for (std::string word; words >> word;) EXPECT_THAT(all, HasSubstr(word));
  }
  EXPECT_THAT(all, ::testing::Not(HasSubstr("...")));
  // A name without blanks is broken within; a note called scale is not that of the sheet.
  sheet.title = std::string(150, 'w');
  sheet.notes = {{"scale", "see contract"}};
  int letters = 0, contracts = 0;
  for (const auto& text : draw_block_sheet(sheet).texts) {
    EXPECT_LE(text.text.size(), 60U);
    letters += static_cast<int>(std::count(text.text.begin(), text.text.end(), 'w') *
                                (text.text.find_first_not_of('w') == std::string::npos));
    contracts += text.text == "see contract";
  }
  EXPECT_EQ(letters, 150);
  EXPECT_EQ(contracts, 1);
}

// Everything stands on the sheet: blocks from 12 mm to 1.5 m.
TEST(Drawing, NothingLiesOutsideTheSheet) {
  for (const double size : {0.012, 0.05, 0.4, 1.5}) {
    LayoutOptions options;
    options.width = size;
    options.height = 0.6 * size;
    options.diameter = 0.07 * size;
    const Drawing drawing = draw_block_sheet(sheet_of(geometry::make_layout(options, 1)));
    const auto inside = [&](Point p) { return p.x >= 0 && p.x <= drawing.width && p.y >= 0 && p.y <= drawing.height; };
    for (const auto& line : drawing.lines) EXPECT_TRUE(inside(line.from) && inside(line.to)) << size;
    for (const auto& text : drawing.texts) EXPECT_TRUE(inside(text.at)) << size << text.text;
  }
}

TEST(HoleListTest, CountsSizesAndLeavesOutLongChains) {
  PerforationLayout layout{0.1, 0.1, {}};
  for (int k = 0; k < 20; ++k)
    layout.perforations.push_back(
        {0.003 + 0.0045 * k + 0.0001 * (k % 3), 0.05, geometry::Circle{k < 5 ? 0.002 : 0.001}});
  const HoleList list(layout);
  EXPECT_EQ(list.summary(), "15 x Ø1, 5 x Ø2");
  PerforationLayout many = layout;
  for (std::size_t k = 0; k < many.perforations.size(); ++k)
    many.perforations[k].shape = geometry::Circle{0.002 + 0.0001 * static_cast<double>(k)};
  EXPECT_EQ(HoleList(many).summary(), "20, Ø2 to Ø3.9");
  EXPECT_TRUE(list.chain_x().empty());
  ASSERT_EQ(list.chain_y().size(), 1u);
  EXPECT_EQ(list.chain_y()[0].words, "50");
}

TEST(MmText, HasNoIdleZeros) {
  EXPECT_EQ(mm_text(12.5, 3), "12.5");
  EXPECT_EQ(mm_text(20.0, 3), "20");
  EXPECT_EQ(mm_text(-0.00001, 3), "0");
  EXPECT_EQ(mm_text(100.0, 0), "100");
}

}  // namespace
}  // namespace perfora::report
