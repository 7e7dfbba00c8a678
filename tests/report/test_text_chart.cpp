// What is here: curves in block characters, held against columns counted by hand; the layout of a design and the
// pictures of a film as files. What is not: whole pictures (test_plot.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "io/error.h"
#include "io/files.h"
#include "report/movie.h"
#include "report/plot.h"
#include "report/text_chart.h"
#include "tests/results/synthetic_run.h"

namespace perfora::report {
namespace {

using ::testing::HasSubstr;

// A ramp from 0 to 7 kPa over four columns and two rows: means of pairs of samples 0.5, 2.5, 4.5, 6.5 kPa, of 6.5 kPa
// 1.2, 6.2, 11.1 and 16 sixteenths.
TEST(TextChart, DrawsARamp) {
  const std::vector<double> strain = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7},
                            stress = {0.0, 1e3, 2e3, 3e3, 4e3, 5e3, 6e3, 7e3};
  EXPECT_EQ(text_chart(strain, stress, {.columns = 4, .rows = 2}),
            "   6.5 kPa \u2502  \u2583\u2588\n"
            "           \u2502\u2581\u2586\u2588\u2588\n"
            "            0 % 70 % strain\n");
  EXPECT_EQ(text_chart(strain, stress, {.columns = 4, .rows = 2, .unicode = false}),
            "   6.5 kPa |   #\n"
            "           | ###\n"
            "            0 % 70 % strain\n");
}

TEST(TextChart, MarksWhatIsCutOff) {
  const std::vector<double> strain = {0.0, 0.1, 0.2, 0.3}, stress = {1e3, 1e3, 9e3, 1e3};
  const std::string text = text_chart(strain, stress, {.columns = 4, .rows = 1, .stress_at_top = 2e3});
  EXPECT_EQ(text.substr(0, text.find('\n')), "              +");
  EXPECT_THAT(text, HasSubstr("2 kPa \u2502\u2584\u2584\u2588\u2584\n"));
}

TEST(TextChart, IsEmptyWhereThereIsNothingToDraw) {
  EXPECT_EQ(text_chart({}, {}, {}), "");
  EXPECT_EQ(text_chart(std::vector<double>{0.1}, std::vector<double>{1.0}, {}), "");
  EXPECT_EQ(text_chart(std::vector<double>{0.0, 0.1}, std::vector<double>{-1.0, 0.0}, {}), "");
}

TEST(PlotLayout, TakesAnyShapeOfBlock) {
  const auto folder = results::testing::fresh_folder("layout");
  for (const auto& [width, height] : {std::pair(0.1, 0.1), {0.3, 0.05}, {0.05, 0.3}}) {
    geometry::PerforationLayout layout{width, height, {{0.02, 0.02, geometry::Circle{0.01}}}};
    for (const char* name : {"l.png", "l.svg", "l.pdf"}) {
      plot_layout(layout, 1e-3, folder / name, {.title = "layout", .target_stress = {}});
      EXPECT_GT(std::filesystem::file_size(folder / name), 2'000u) << name << ' ' << width;
    }
    layout.perforations.clear();
    plot_layout(layout, 1e-3, folder / "none.png", {.title = "layout", .target_stress = {}});
  }
}

TEST(Movie, DrawsAPictureAFrame) {
  const auto folder = results::testing::fresh_folder("movie");
  results::testing::SyntheticRun run = results::testing::make_run(0.05, 2, 2e-3, 0.2);
  results::testing::write_run(run, folder / "R.h5");
  EXPECT_EQ(draw_movie(results::read_run(folder / "R.h5"), "film", folder), run.frames.size());
  for (std::size_t k = 0; k < run.frames.size(); ++k)
    EXPECT_TRUE(io::read_beginning(folder / movie_frame_name(k), 8).starts_with("\x89PNG")) << k;
  run.frames.clear();
  results::testing::write_run(run, folder / "none.h5");
  EXPECT_THROW(draw_movie(results::read_run(folder / "none.h5"), "film", folder), io::InputError);
}

}  // namespace
}  // namespace perfora::report
