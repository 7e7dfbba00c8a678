// What is here: descriptors and curve components against layouts and curves whose numbers are known. What is not:
// models.
#include "optimize/model/descriptors.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <string>

#include "optimize/model/features.h"
#include "optimize/model/response_curves.h"

namespace perfora::model {
namespace {

std::map<std::string, double> described(const std::string& layout) {
  const optimize::DesignFile file =
      optimize::DesignFile::from_toml("[cell]\nwidth = 0.05\nheight = 0.05\n[layout]\n" + layout, "test");
  const Descriptors found = describe_design(file.design());
  std::map<std::string, double> named;
  for (std::size_t k = 0; k < found.values.size(); ++k) named[descriptor_list()[k].name] = found.values[k];
  named["family"] = found.family;
  return named;
}

// Four circles of 16 mm in 50 x 50 mm: area 4 x 64 pi, two a row, walls of 25 - 16 mm.
TEST(Descriptors, OfASquareLattice) {
  const auto found = described("family = \"square\"\ndiameter = 0.016\nrows = 2\ncolumns = 2\n");
  EXPECT_NEAR(found.at("porosity"), 4.0 * 64.0 * std::numbers::pi / 2500.0, 1e-9);
  EXPECT_NEAR(found.at("weakest_row"), 1.0 - 2.0 * 16.0 / 50.0, 1e-3);
  EXPECT_NEAR(found.at("mean_row"), 1.0 - 2.0 * 16.0 / 50.0, 1e-3);
  EXPECT_NEAR(found.at("row_spread"), 0.0, 1e-3);
  EXPECT_NEAR(found.at("rows"), std::log(2.0), 1e-12);
  EXPECT_NEAR(found.at("free_stroke"), 2.0 * 16.0 / 50.0, 1e-9);
  EXPECT_NEAR(found.at("aspect"), 0.0, 1e-9);
  EXPECT_NEAR(found.at("free_columns"), 1.0, 1e-12);
  EXPECT_NEAR(found.at("thinnest_wall"), 9.0 / 50.0, 1e-9);
  EXPECT_NEAR(found.at("holes"), std::log(5.0), 1e-12);
}

// Slots 16 x 4 mm, the rows from 12 to 16 mm long: they widen the weakest cut from 1 - 2 x 12/50 to 1 - 2 x 16/50.
TEST(Descriptors, OfGradedSlots) {
  const std::string keys =
      "family = \"rows\"\nshape = \"slot\"\ndiameter = 0.016\nbreadth = 0.004\nrows = 5\ncolumns = 2\nstagger = 0\n";
  const auto graded = described(keys + "row_diameter = [0.012, 0.016]\n");
  EXPECT_NEAR(graded.at("weakest_row"), 1.0 - 32.0 / 50.0, 2e-3);
  EXPECT_NEAR(graded.at("row_trend"), -8.0 / 50.0, 5e-3);
  EXPECT_NEAR(graded.at("aspect"), std::log(4.0 / 14.0), 1e-6);
  EXPECT_GT(graded.at("row_order"), 0.3);
  EXPECT_NEAR(graded.at("rows"), std::log(5.0), 1e-12);
  const auto upright = described(keys + "angle = \"90 deg\"\n"), turned = described(keys + "angle = \"45 deg\"\n");
  EXPECT_NEAR(upright.at("aspect"), std::log(4.0), 1e-6);
  EXPECT_NEAR(upright.at("tilt"), 0.0, 1e-6);
  EXPECT_GT(turned.at("tilt"), 0.4);
}

// Staggered rows leave no free column and cross every upright cut alike.
TEST(Descriptors, TellStaggeredFromSquare) {
  const std::string keys = "diameter = 0.014\nrows = 2\ncolumns = 2\n";
  const auto square = described("family = \"square\"\n" + keys),
             staggered = described("family = \"staggered\"\n" + keys);
  EXPECT_NE(square.at("family"), staggered.at("family"));
  EXPECT_LT(staggered.at("phase"), 0.8 * square.at("phase"));
  EXPECT_NEAR(staggered.at("porosity"), square.at("porosity"), 1e-12);
}

TEST(Features, KeepWhatVariesScaledToOne) {
  const std::vector<Traits> known{{0, {1.0, 5.0, 2.0}}, {1, {1.0, 7.0, 4.0}}, {0, {1.0, 6.0, 2.0}}};
  const Features features(known);
  ASSERT_EQ(features.count(), 2);
  const Inputs one = features.inputs_of(known[2], 3);
  EXPECT_EQ(one.points(0, 0), 0.5);
  EXPECT_EQ(one.points(0, 1), 0.0);
  EXPECT_EQ(one.family[0], 0);
  EXPECT_EQ(one.fidelity[0], 3);
}

results::History line(double start, double end) {
  results::History history;
  for (int k = 0; k <= 100; ++k) {
    history.strain_yy.push_back(0.004 * k);
    history.stress_yy.push_back(start + (end - start) * k / 100.0);
  }
  return history;
}

// Curves that are factors of one: a single component holds them, and gives each back.
TEST(CurveBasis, HoldsFactorsInOneComponent) {
  const std::vector<results::History> curves{line(1e5, 1e5), line(2e5, 2e5), line(4e5, 4e5)};
  const std::vector<const results::History*> all{&curves[0], &curves[1], &curves[2]};
  CurveBasis basis(0.4, all);
  EXPECT_NEAR(basis.floor(), CurveBasis::floor_share * 7e5 / 3.0, 1.0);
  EXPECT_EQ(basis.bins(), 20);
  Eigen::MatrixXd binned(3, basis.bins());
  for (int k = 0; k < 3; ++k) binned.row(k) = basis.binned(curves[static_cast<std::size_t>(k)]);
  basis.find_components(binned);
  EXPECT_EQ(basis.components(), 1);
  const Eigen::VectorXd back = basis.curve(basis.scores(basis.binned(curves[2])));
  EXPECT_NEAR(std::exp(back(7)) - basis.floor(), 4e5, 1e-3 * 4e5);
}

// The mean of a line over a bin is its middle, and a window over halves of bins weighs them by half.
TEST(CurveBasis, BinsAndWindows) {
  const results::History curve = line(0.0, 4e5);
  const results::History* all[] = {&curve};
  const CurveBasis basis(0.4, all);
  EXPECT_NEAR(std::exp(basis.binned(curve)(3)) - basis.floor(), 4e5 * 0.07 / 0.4, 1.0);
  const Eigen::VectorXd window = basis.window(0.05, 0.08);
  EXPECT_NEAR(window(2), 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(window(3), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(window.sum(), 1.0, 1e-12);
}

}  // namespace
}  // namespace perfora::model
