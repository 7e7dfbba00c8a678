// What is here: lists of holes of every shape from CSV, and what is wrong with them. What is not: the other families
// (test_layout.cpp), lists of circles alone (test_layout.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "geometry/layout.h"
#include "geometry/make_shape.h"
#include "geometry/wall.h"
#include "io/error.h"

namespace perfora::geometry {
namespace {

using testing::HasSubstr;

class ListOfShapes : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  LayoutOptions options(const std::string& text) {
    std::ofstream(path_) << text;
    LayoutOptions options;
    options.width = 0.05;
    options.height = 0.04;
    options.family = LayoutFamily::list;
    options.file = path_;
    return options;
  }
  std::string complaint(const std::string& text) {
    try {
      static_cast<void>(make_layout(options(text), 1));
    } catch (const io::InputError& error) {
      return error.what();
    }
    return {};
  }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() /
      (std::string("perfora_list_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
};

TEST_F(ListOfShapes, TakesShapesSizesAnglesAndOutlines) {
  const auto layout =
      make_layout(options("# openings\n"
                          "Shape, x, y, diameter, breadth, angle, corner_radius, wkt\n"
                          "slot, 0.010, 0.010, 8 mm, 0.002, 90 deg, , \n"
                          ", 0.030, 0.010, 0.004, , , ,\n"
                          "diamond, 0.030, 0.025, 0.009, 0.008, 0, 1 mm, \"\"\n"
                          ",,,,,,,\"POLYGON ((-0.002 0.030, 0.003 0.030, 0.003 0.036, -0.002 0.030))\"\n"),
                  1);
  ASSERT_EQ(layout.perforations.size(), 4u);
  EXPECT_EQ(layout.perforations[0],
            (Perforation{0.010, 0.010, make_shape(ShapeKind::slot, {8e-3, 2e-3, std::numbers::pi / 2.0, 0.0, {}})}));
  EXPECT_EQ(layout.perforations[1], (Perforation{0.030, 0.010, Circle{0.004}}));
  EXPECT_EQ(layout.perforations[2],
            (Perforation{0.030, 0.025, make_shape(ShapeKind::diamond, {9e-3, 8e-3, 0.0, 1e-3, {}})}));
  // A triangle across the left edge: its image stands at the right one.
  EXPECT_NEAR(layout.perforations[3].area(), 0.5 * 0.005 * 0.006, 1e-15);
  EXPECT_NEAR(layout.perforations[3].x, 0.0005, 1e-15);
  EXPECT_EQ(layout.cut_out(true, true).size(), 5u);
}

TEST_F(ListOfShapes, AnOutlineMayLieMostlyBeyondAnEdge) {
  const auto layout =
      make_layout(options("wkt\n\"POLYGON ((-0.004 0.010, 0.001 0.010, 0.001 0.015, -0.004 0.015))\"\n"), 1);
  EXPECT_NEAR(layout.perforations[0].x, 0.0485, 1e-15);
  EXPECT_THAT(complaint("wkt\n\"POLYGON ((-0.004 0.010, -0.001 0.010, -0.001 0.015))\"\n"),
              HasSubstr("lies outside the cell"));
}

// Of slots along the width the walls between their ends decide, also across the edge.
TEST_F(ListOfShapes, LongHolesMayNearlyFillTheCellAlongOneSide) {
  const auto layout = make_layout(options("x,y,diameter,breadth,shape\n"
                                          "0.045,0.010,0.047,0.002,slot\n0.020,0.030,0.047,0.002,slot\n"),
                                  1);
  const ThinnestWall wall = thinnest_wall(layout);
  EXPECT_NEAR(wall.thickness, 0.003, 1e-15);
  EXPECT_EQ(wall.first, wall.second);
  EXPECT_THAT(complaint("x,y,diameter,breadth,shape\n0.045,0.010,0.051,0.002,slot\n"),
              HasSubstr("larger than the cell"));
  EXPECT_THAT(complaint("x,y,diameter,breadth,shape,angle\n0.045,0.010,0.045,0.002,slot,90 deg\n"),
              HasSubstr("larger than the cell"));
}

TEST_F(ListOfShapes, ErrorsNameFileLineAndColumn) {
  const std::string head = "x,y,diameter,shape,breadth,angle,corner_radius,wkt\n";
  EXPECT_THAT(complaint(head + "0.01,0.01,0.008,slit,0.002,,,\n"), HasSubstr("there is no shape \"slit\""));
  EXPECT_THAT(complaint(head + "0.01,0.01,0.008,slit,0.002,,,\n"), HasSubstr(".csv:2"));
  EXPECT_THAT(complaint(head + "0.01,0.01,0.008,polygon,0.002,,,\n"), HasSubstr("column wkt"));
  EXPECT_THAT(complaint(head + "0.01,0.01,0.008,slot,,,,\n"), HasSubstr("column breadth is missing or empty"));
  EXPECT_THAT(complaint(head + "0.01,0.01,0.008,circle,0.002,,,\n"), HasSubstr("column breadth means nothing"));
  EXPECT_THAT(complaint(head + "0.01,0.01,0.008,,0.002,,,\n"), HasSubstr("column breadth means nothing"));
  EXPECT_THAT(complaint(head + "0.01,0.01,0.008,slot,0.002,20 mm,,\n"), HasSubstr("angle"));
  EXPECT_THAT(complaint(head + "0.01,0.01,0.008,diamond,0.002,,2 mm,\n"), HasSubstr("column corner_radius"));
  EXPECT_THAT(complaint(head + "0.01,0.01,-0.008,slot,0.002,,,\n"), HasSubstr("column diameter"));
  EXPECT_THAT(complaint(head + "0.06,0.01,0.008,slot,0.002,,,\n"), HasSubstr("lies outside the cell"));
  EXPECT_THAT(complaint(head + "0.01,,,,,,,\"POLYGON ((0 0, 0.01 0, 0 0.01))\"\n"),
              HasSubstr("column x means nothing"));
  EXPECT_THAT(complaint(head + ",,,,,,,\"POLYGON ((0 0, 0.01 0.01, 0.01 0, 0 0.01))\"\n"), HasSubstr("cross or touch"));
  EXPECT_THAT(complaint(head + ",,,,,,,POLYGON ((0 0, 0.01 0.01, 0.01 0))\n"), HasSubstr("stands in quotes"));
  EXPECT_THAT(complaint("x,y,shape\n0.01,0.01,slot\n"), HasSubstr("has no column diameter"));
  EXPECT_THAT(complaint("x,y,diameter,shape\n"), HasSubstr("holds no holes"));
}

}  // namespace
}  // namespace perfora::geometry
