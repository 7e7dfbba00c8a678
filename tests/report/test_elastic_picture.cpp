// What is here: elastic responses read back, refused when broken, drawn with the right colour in the right place.
#include <cairo.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/error.h"
#include "report/plot.h"
#include "tests/results/synthetic_run.h"

namespace perfora::report {
namespace {

using results::testing::fresh_folder;
using ::testing::HasSubstr;

/// A row of four discs that yield at 1, 2 and 4 per mille; the last never.
results::ElasticResult row_of_discs() {
  results::ElasticResult elastic;
  elastic.clipped.width = elastic.clipped.height = elastic.layout.width = elastic.layout.height = 4e-3;
  elastic.clipped.x = {0.5e-3, 1.5e-3, 2.5e-3, 3.5e-3};
  elastic.clipped.y.assign(4, 2e-3);
  elastic.clipped.radius.assign(4, 0.45e-3);
  elastic.disc_strain = {1e-3, 2e-3, 4e-3, std::numeric_limits<double>::infinity()};
  elastic.stiffness.assign(9, 1e8);
  elastic.affine_stiffness.assign(9, 1e8);
  for (std::vector<double>& displacement : elastic.displacement) displacement.assign(12, 0.0);
  elastic.first_bonds = {{0.5e-3}, {3.5e-3}, {1e-3}, {0, 1}, {0}};
  elastic.summary = {{"first_yield_strain", 1e-3}, {"young_y", 1e8}, {"bonds", 3}};
  return elastic;
}

std::filesystem::path written(const std::string& name, const results::ElasticResult& elastic) {
  const auto path = fresh_folder(name) / "E.h5";
  results::write_elastic(path, elastic);
  return path;
}

std::string refusal(const std::filesystem::path& path) {
  try {
    static_cast<void>(results::read_elastic(path));
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ElasticFile, ComesBackAndIsChecked) {
  results::ElasticResult elastic = row_of_discs();
  const results::ElasticResult back = results::read_elastic(written("elastic", elastic));
  EXPECT_EQ(back.disc_strain, elastic.disc_strain);
  EXPECT_EQ(back.first_bonds.x, elastic.first_bonds.x);
  elastic.disc_strain.pop_back();
  EXPECT_THAT(refusal(written("short", elastic)), HasSubstr("/first_yield/disc_strain: has 3 numbers where 4 belong"));
  elastic.disc_strain.push_back(-1.0);
  EXPECT_THAT(refusal(written("negative", elastic)), HasSubstr("positive strains"));
  elastic.disc_strain.back() = std::nan("");
  EXPECT_THAT(refusal(written("nan", elastic)), HasSubstr("positive strains"));
}

// The block is a square of 4 mm from (44, 116) to the same right edge as in pictures of packings; brightness falls with
// nearness to yield: the disc that yields first is darkest, the one that never does is brightest.
TEST(ElasticPicture, DarkerDiscsYieldEarlier) {
  const auto path = written("picture", row_of_discs());
  plot_elastic(path, path.parent_path() / "E.png");
  cairo_surface_t* image = cairo_image_surface_create_from_png((path.parent_path() / "E.png").c_str());
  ASSERT_EQ(cairo_image_surface_get_width(image), 1600);
  constexpr double left = 44.0, top = 116.0, side = 832.0;
  std::vector<int> brightness;
  for (const double x : row_of_discs().clipped.x) {
    const auto column = static_cast<int>(left + side * x / 4e-3), row = static_cast<int>(top + 0.5 * side);
    const unsigned char* pixel =
        cairo_image_surface_get_data(image) + row * cairo_image_surface_get_stride(image) + 4 * column;
    brightness.push_back(pixel[0] + pixel[1] + pixel[2]);
  }
  cairo_surface_destroy(image);
  EXPECT_LT(brightness[0], brightness[1]);
  EXPECT_LT(brightness[1], brightness[2]);
  EXPECT_LT(brightness[2], brightness[3]);
}

}  // namespace
}  // namespace perfora::report
