// What is here: holes read from drawings that are written here by hand: DXF, SVG, WKT. Expected: places and sizes that
// the drawing states, areas by formula. What is not: drawings that perfora wrote (tests/export/test_drawing.cpp).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "geometry/drawn_holes.h"
#include "geometry/drawn_shapes.h"
#include "geometry/layout.h"
#include "io/error.h"

namespace perfora::geometry {
namespace {

using ::testing::HasSubstr;
constexpr double pi = std::numbers::pi;

class DrawnHoles : public ::testing::Test {
 protected:
  void SetUp() override {
    options_.width = 0.1;
    options_.height = 0.05;
    options_.family = LayoutFamily::list;
  }
  void TearDown() override { std::filesystem::remove(options_.file); }

  std::vector<Perforation> read(const std::string& extension, const std::string& text) {
    std::filesystem::remove(options_.file);
    options_.file = std::filesystem::path(testing::TempDir()) / fmt::format("drawing-{}{}", ::getpid(), extension);
    std::ofstream(options_.file) << text;
    return drawn_holes(options_, 100);
  }
  std::string complaint(const std::string& extension, const std::string& text) {
    try {
      read(extension, text);
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  LayoutOptions options_;
};

std::string dxf(const std::string& entities, int unit = 4) {
  std::string text =
      fmt::format("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n{}\n0\nENDSEC\n", unit);
  return text + "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

std::string circle(double x, double y, double r, const std::string& layer = "0") {
  return fmt::format("0\nCIRCLE\n8\n{}\n10\n{}\n20\n{}\n30\n0\n40\n{}\n", layer, x, y, r);
}

std::string svg(const std::string& body,
                const std::string& head = "width=\"100mm\" height=\"50mm\" viewBox=\"0 0 100 50\"") {
  return "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" " + head + ">\n" + body + "\n</svg>\n";
}

TEST_F(DrawnHoles, DxfCirclesInMillimetresAndInches) {
  const auto holes = read(".dxf", dxf(circle(20, 10, 4) + circle(60, 30, 5)));
  ASSERT_EQ(holes.size(), 2u);
  EXPECT_DOUBLE_EQ(holes[0].x, 0.020);
  EXPECT_DOUBLE_EQ(holes[0].y, 0.010);
  EXPECT_DOUBLE_EQ(holes[0].largest_extent(), 0.008);
  EXPECT_NEAR(holes[1].area(), pi * 25e-6, 1e-15);
  const auto inches = read(".DXF", dxf(circle(1, 1, 0.25), 1));
  EXPECT_DOUBLE_EQ(inches.at(0).x, 0.0254);
  EXPECT_DOUBLE_EQ(inches.at(0).largest_extent(), 0.0127);
}

TEST_F(DrawnHoles, UnitsThatNobodySaysAreRefused) {
  EXPECT_THAT(complaint(".dxf", dxf(circle(20, 10, 4), 0)), HasSubstr("layout.file_unit: the drawing does not say"));
  EXPECT_THAT(complaint(".svg", svg("<circle cx=\"20\" cy=\"10\" r=\"4\"/>", "width=\"100\" height=\"50\"")),
              HasSubstr("layout.file_unit"));
  options_.file_unit = "mm";
  EXPECT_DOUBLE_EQ(read(".dxf", dxf(circle(20, 10, 4), 0)).at(0).x, 0.020);
  EXPECT_NEAR(read(".svg", svg("<circle cx=\"20\" cy=\"10\" r=\"4\"/>", "width=\"100\" height=\"50\"")).at(0).y, 0.040,
              1e-15);
  options_.file_unit = "stone";
  EXPECT_THAT(complaint(".dxf", dxf(circle(20, 10, 4), 0)), HasSubstr("\"stone\" is no unit of length"));
}

// A slot as one LWPOLYLINE with two half circles: 10 mm between the centres, radius 3 mm.
TEST_F(DrawnHoles, DxfPolylinesWithBulges) {
  const std::string slot =
      "0\nLWPOLYLINE\n5\n2F\n8\nHOLES\n90\n4\n70\n1\n10\n20\n20\n17\n10\n30\n20\n17\n42\n1\n10\n30\n20\n23\n10\n20\n20"
      "\n23\n42\n1\n";
  const auto holes = read(".dxf", dxf(slot + circle(70, 20, 5, "NOTES")));
  ASSERT_EQ(holes.size(), 1u) << "the layer holes alone";
  EXPECT_NEAR(holes[0].area(), (10 * 6 + 9 * pi) * 1e-6, 60e-3 * 1e-6);
  EXPECT_NEAR(holes[0].x, 0.025, 1e-9);
  EXPECT_NEAR(holes[0].y, 0.020, 1e-9);
  EXPECT_NEAR(holes[0].largest_extent(), 0.016, 1e-6);
  EXPECT_NEAR(holes[0].smallest_extent(), 0.006, 1e-6);
}

// R12: POLYLINE with two half circles is a circle of 8 mm; seen from behind (extrusion -1) x is turned around.
TEST_F(DrawnHoles, DxfPolylineOfTwoArcsIsACircle) {
  const std::string round =
      "0\nPOLYLINE\n8\n0\n66\n1\n70\n1\n0\nVERTEX\n8\n0\n10\n16\n20\n10\n42\n1\n0\nVERTEX\n8\n0\n10\n24\n20\n10\n42\n1"
      "\n"
      "0\nSEQEND\n8\n0\n";
  const auto holes = read(".dxf", dxf(round));
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_NEAR(holes[0].largest_extent(), 0.008, 1e-9);
  EXPECT_NEAR(holes[0].area(), 16 * pi * 1e-6, 1e-12);
  EXPECT_NEAR(holes[0].x, 0.020, 1e-9);
  const auto behind = read(".dxf", dxf("0\nCIRCLE\n8\n0\n10\n-20\n20\n10\n40\n4\n210\n0\n220\n0\n230\n-1\n"));
  EXPECT_DOUBLE_EQ(behind.at(0).x, 0.020);
}

// The rectangle of the size of the cell is the block: it says where the corner is.
TEST_F(DrawnHoles, TheBlockIsTheOrigin) {
  const std::string block =
      "0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n10\n1000\n20\n500\n10\n1100\n20\n500\n10\n1100\n20\n550\n10\n1000\n20\n550\n";
  const auto holes = read(".dxf", dxf(block + circle(1020, 510, 4)));
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_NEAR(holes[0].x, 0.020, 1e-12);
  EXPECT_NEAR(holes[0].y, 0.010, 1e-12);
  options_.width = 0.2;
  EXPECT_THAT(complaint(".dxf", dxf(block + circle(1020, 510, 4))), HasSubstr("lies outside the cell"));
}

TEST_F(DrawnHoles, ABlockOfAnotherSizeIsRefused) {
  EXPECT_THAT(
      complaint(".svg",
                svg("<g id=\"block\"><rect width=\"90\" height=\"50\"/></g><circle cx=\"20\" cy=\"10\" r=\"4\"/>")),
      HasSubstr("the block of the drawing is 90 x 50 mm; the cell of 100 x 50 mm"));
}

// Drawn at both edges it crosses, a hole is one; drawn twice inside, two that overlap.
TEST_F(DrawnHoles, ImagesAcrossTheEdgesAreOneHole) {
  const auto holes = read(".dxf", dxf(circle(0, 20, 4) + circle(100, 20, 4) + circle(50, 50, 3) + circle(50, 0, 3)));
  ASSERT_EQ(holes.size(), 2u);
  EXPECT_NEAR(holes[0].x, 0.0, 1e-12);
  EXPECT_NEAR(holes[1].y, 0.0, 1e-12);
  EXPECT_EQ(read(".dxf", dxf(circle(50, 20, 4) + circle(50, 20, 4))).size(), 2u);
}

TEST_F(DrawnHoles, DxfSaysWhatItCannotRead) {
  const std::string line = "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n5\n21\n5\n";
  EXPECT_EQ(read(".dxf", dxf(line + circle(20, 10, 4))).size(), 1u);
  EXPECT_THAT(complaint(".dxf", dxf("0\nLINE\n8\nHOLES\n10\n0\n20\n0\n11\n5\n21\n5\n" + circle(20, 10, 4, "holes"))),
              HasSubstr("single lines are not joined"));
  EXPECT_THAT(complaint(".dxf", dxf("0\nINSERT\n8\n0\n2\nHOLE\n10\n5\n20\n5\n" + circle(20, 10, 4))),
              HasSubstr(".dxf:20: layout.file: blocks are not read"));
  EXPECT_THAT(complaint(".dxf", dxf("0\nCIRCLE\n8\n0\n10\nfour\n20\n1\n40\n1\n")),
              HasSubstr(":24: layout.file: \"four\""));
  EXPECT_THAT(complaint(".dxf", "AutoCAD Binary DXF\r\n"), HasSubstr("binary"));
  EXPECT_THAT(complaint(".dxf", "x,y,diameter\n"), HasSubstr(":1: layout.file: \"x,y,diameter\" is no group code"));
  EXPECT_THAT(complaint(".dxf", dxf(line)), HasSubstr("holds no holes"));
  options_.file_layer = "bores";
  EXPECT_THAT(complaint(".dxf", dxf(circle(20, 10, 4, "Holes"))), HasSubstr("no layer or group \"bores\"; holes"));
}

// An ellipse of half axes 6 and 3 mm, turned by a third of a right angle: area 18 pi mm2.
TEST_F(DrawnHoles, DxfEllipse) {
  const auto holes =
      read(".dxf", dxf(fmt::format("0\nELLIPSE\n8\n0\n10\n40\n20\n20\n11\n{}\n21\n{}\n40\n0.5\n41\n0\n42\n{}\n",
                                   6 * std::cos(pi / 6), 6 * std::sin(pi / 6), 2 * pi)));
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_NEAR(holes[0].area(), 18 * pi * 1e-6, 1e-9 * 30);
  EXPECT_NEAR(holes[0].largest_extent(), 0.012, 1e-6);
}

// y runs downwards on an SVG page.
TEST_F(DrawnHoles, SvgShapes) {
  const auto holes = read(".svg", svg("<circle cx=\"20\" cy=\"10\" r=\"4\"/>\n"
                                      "<ellipse cx=\"40\" cy=\"10\" rx=\"6\" ry=\"3\"/>\n"
                                      "<rect x=\"60\" y=\"5\" width=\"8\" height=\"6\"/>\n"
                                      "<rect x=\"80\" y=\"5\" width=\"10\" height=\"6\" rx=\"2\"/>\n"
                                      "<polygon points=\"10,30 20,30 10,40\"/>\n"
                                      "<path d=\"M40 30h10v6H40z\"/>\n"
                                      "<path d=\"m 60 30 a 4 4 0 1 0 8 0 a4 4 0 10-8 0z\"/>"
                                      "<line x1=\"0\" y1=\"0\" x2=\"5\" y2=\"5\"/><text>x</text>"));
  ASSERT_EQ(holes.size(), 7u);
  EXPECT_NEAR(holes[0].x, 0.020, 1e-15);
  EXPECT_NEAR(holes[0].y, 0.040, 1e-15);
  EXPECT_DOUBLE_EQ(holes[0].largest_extent(), 0.008);
  EXPECT_NEAR(holes[1].area(), 18 * pi * 1e-6, 30e-9);
  EXPECT_NEAR(holes[2].area(), 48e-6, 1e-15);
  EXPECT_NEAR(holes[2].x, 0.064, 1e-12);
  EXPECT_NEAR(holes[2].y, 0.042, 1e-12);
  EXPECT_NEAR(holes[3].area(), (60 - (4 - pi) * 4) * 1e-6, 30e-9);
  EXPECT_NEAR(holes[4].area(), 50e-6, 1e-15);
  EXPECT_NEAR(holes[5].area(), 60e-6, 1e-15);
  EXPECT_NEAR(holes[6].area(), 16 * pi * 1e-6, 1e-12) << "two arcs are a circle";
}

// Transforms stand in each other; matrix(1 0 0 -1 0 50) turns the page upright. A circle stretched is an ellipse.
TEST_F(DrawnHoles, SvgTransforms) {
  const auto holes =
      read(".svg", svg("<g transform=\"matrix(1 0 0 -1 0 50)\"><g transform=\"translate(20,10) scale(2)\">"
                       "<circle r=\"2\"/></g>\n<g transform=\"rotate(90 60 20)\"><rect x=\"50\" y=\"18\" width=\"8\" "
                       "height=\"4\"/></g>"
                       "<g transform=\"translate(80 20) scale(2 1)\"><circle r=\"3\"/></g></g>"));
  ASSERT_EQ(holes.size(), 3u);
  EXPECT_NEAR(holes[0].x, 0.020, 1e-12);
  EXPECT_NEAR(holes[0].y, 0.010, 1e-12);
  EXPECT_NEAR(holes[0].largest_extent(), 0.008, 1e-12);
  // The rectangle about (54, 20), turned by a right angle about (60, 20): about (60, 14), 4 wide and 8 high.
  EXPECT_NEAR(holes[1].x, 0.060, 1e-9);
  EXPECT_NEAR(holes[1].y, 0.014, 1e-9);
  EXPECT_NEAR(holes[1].bounds().width(), 0.004, 1e-9);
  EXPECT_NEAR(holes[1].bounds().height(), 0.008, 1e-9);
  EXPECT_NEAR(holes[2].bounds().width(), 0.012, 1e-6);
  EXPECT_NEAR(holes[2].area(), 18 * pi * 1e-6, 30e-9);
}

// Area under one arch of the cubic P0 = 0, P1 = (0, 8), P2 = (12, 8), P3 = (12, 0): 3/20 of the Bernstein terms: 0.6 x
// 12 x 8 = 57.6 mm2; the quadratic with its control at (6, 12): two thirds of base times half its control's height.
TEST_F(DrawnHoles, SvgCurves) {
  const auto holes = read(".svg", svg("<path d=\"M20 20 C20 12 32 12 32 20 Z\"/><path d=\"M50 20 Q56 8 62 20 Z\"/>"
                                      "<path d=\"M70 20 Q73 14 76 20 T 82 20 L 82 30 L 70 30 Z\"/>"));
  ASSERT_EQ(holes.size(), 3u);
  EXPECT_NEAR(holes[0].area(), 0.6 * 12 * 8 * 1e-6, 30e-9);
  EXPECT_NEAR(holes[1].area(), 2.0 / 3.0 * 12 * 6 * 1e-6, 30e-9);
  EXPECT_NEAR(holes[2].area(), 120e-6, 30e-9) << "a hump up and the same hump down";
}

TEST_F(DrawnHoles, SvgSaysWhatItCannotRead) {
  EXPECT_THAT(complaint(".svg", "<svg"), HasSubstr("this is no XML"));
  EXPECT_THAT(complaint(".svg", "<html>\n</html>"), HasSubstr("no drawing"));
  EXPECT_THAT(complaint(".svg", svg("<path d=\"M 10 10 L 20 wide Z\"/>")),
              HasSubstr(":3: layout.file: the data of this path"));
  EXPECT_THAT(complaint(".svg", svg("\n\n<use href=\"#a\"/><circle cx=\"20\" cy=\"10\" r=\"4\"/>")),
              HasSubstr(":5: layout.file: elements \"use\" are not read"));
  EXPECT_THAT(complaint(".svg", svg("<g id=\"Holes\"><path d=\"M0 0L5 5L9 0\"/></g>")),
              HasSubstr("this line is not closed"));
  EXPECT_THAT(complaint(".svg", svg("<g transform=\"turn(3)\"><circle r=\"4\"/></g>")), HasSubstr("is no transform"));
  EXPECT_THAT(complaint(".svg", svg("<path d=\"M10 10 L30 30 L30 10 L10 30 Z\"/>")),
              HasSubstr("this outline is no hole"));
  EXPECT_THAT(complaint(".svg", svg("<circle cx=\"20\" cy=\"10\" r=\"4\"/>",
                                    "width=\"100mm\" height=\"80mm\" viewBox=\"0 0 100 50\"")),
              HasSubstr("stretch the page"));
}

TEST_F(DrawnHoles, WktOneOrMany) {
  const auto holes = read(".wkt",
                          "POLYGON ((0.01 0.01, 0.02 0.01, 0.02 0.02, 0.01 0.02, 0.01 0.01))\n"
                          "MULTIPOLYGON (((0.04 0.01, 0.05 0.01, 0.04 0.02)), ((0.06 0.01, 0.07 0.01, 0.06 0.03)))\n");
  ASSERT_EQ(holes.size(), 3u);
  EXPECT_NEAR(holes[0].area(), 1e-4, 1e-15);
  EXPECT_NEAR(holes[1].area(), 5e-5, 1e-15);
  EXPECT_NEAR(holes[2].area(), 1e-4, 1e-15);
  options_.file_unit = "mm";
  EXPECT_NEAR(read(".wkt", "GEOMETRYCOLLECTION (POLYGON ((10 10, 20 10, 20 20, 10 20)))").at(0).area(), 1e-4, 1e-15);
  EXPECT_THAT(complaint(".wkt", "POLYGON ((1 1, 2 1, 2 2))\nPOINT (3 3)\n"), HasSubstr(":2: layout.file: no POLYGON"));
  EXPECT_THAT(complaint(".wkt", "POLYGON ((1 1, 2 1, 2 2), (1.5 1.2, 1.6 1.2, 1.6 1.3))"), HasSubstr("inner ring"));
}

/// Whether a reader takes a text or refuses it in one line.
void expect_taken_or_refused(std::vector<DrawnShape> (*reader)(std::string_view, const DrawnSource&),
                             const std::string& text) {
  try {
    static_cast<void>(reader(text, {"drawing", 0.0}));
  } catch (const io::InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

// Every beginning of a good file, and good files with bytes changed at random, are taken or refused, and nothing else.
TEST_F(DrawnHoles, BrokenFilesAreRefusedOrTaken) {
  const std::string good_dxf = dxf(
      circle(20, 10, 4) +
      "0\nPOLYLINE\n8\n0\n66\n1\n70\n1\n0\nVERTEX\n8\n0\n10\n1\n20\n1\n42\n0.5\n0\nVERTEX\n10\n2\n20\n2\n0\nSEQEND\n"
      "0\nLWPOLYLINE\n90\n2\n70\n1\n10\n1\n20\n1\n42\n-3\n10\n2\n20\n5\n"
      "0\nELLIPSE\n10\n1\n20\n1\n11\n2\n21\n0\n40\n0.5\n");
  const std::string good_svg =
      svg("<g id=\"a\" transform=\"rotate(30) skewX(5)\"><path d=\"M1,2c3 4 5 6 7 8s1 2 3 4q1 1 2 2t3 3"
          "a1 2 3 0 1 4 5zm1 1h2v-3Z\"/><rect x=\"1\" width=\"2\" height=\"3\" rx=\".5\"/></g>");
  const std::string good_wkt = "GEOMETRYCOLLECTION(POLYGON((0 0,1 0,1 1)),MULTIPOLYGON(((2 2,3 2,3 3))))";
  std::mt19937_64 random(7);
  for (const auto& [reader, good] :
       {std::pair(&read_dxf, good_dxf), std::pair(&read_svg, good_svg), std::pair(&read_wkt, good_wkt)}) {
    for (std::size_t end = 0; end <= good.size(); ++end) expect_taken_or_refused(reader, good.substr(0, end));
    for (int k = 0; k < 3000; ++k) {
      std::string bad = good;
      for (int change = 0; change < 1 + k % 4; ++change) {
        const std::size_t at = random() % bad.size();
        if (k % 3 == 0)
          bad[at] = static_cast<char>(random());
        else if (k % 3 == 1)
          bad.erase(at, 1 + random() % 9);
        else
          bad.insert(at, bad.substr(random() % bad.size(), random() % 20));
        if (bad.empty()) break;
      }
      expect_taken_or_refused(reader, bad);
    }
  }
}

}  // namespace
}  // namespace perfora::geometry
