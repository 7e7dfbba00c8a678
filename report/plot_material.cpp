// What is here: the picture of material tests: a column a test, its curves over its cracked sample, the numbers below.
// What is not: the parts it is put together from (block_picture.h, chart.h).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/text.h"
#include "report/block_picture.h"
#include "report/canvas.h"
#include "report/chart.h"
#include "report/plot.h"
#include "results/material_file.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0;
constexpr double page_height = 1000.0;
constexpr double page_margin = 44.0;
constexpr double chart_top = 150.0;
constexpr double chart_height = 260.0;
constexpr double sample_top = 490.0;
constexpr double sample_height = 318.0;
constexpr double facts_top = 868.0;
constexpr double tick_room = 74.0;  ///< left of a chart

/// Names of the tests in the order of the columns, with their headings.
constexpr std::array<std::pair<const char*, const char*>, 4> columns = {{{"tension", "Tension, sides free"},
                                                                         {"compression", "Compression, sides free"},
                                                                         {"shear", "Simple shear"},
                                                                         {"oedometric", "Oedometric compression"}}};

struct Number {
  const char* key;
  const char* label;
  io::Dimension dimension;
};

constexpr Number numbers[] = {
    {"young_modulus", "E (2D)", io::Dimension::stress},
    {"poisson_ratio", "nu (2D)", io::Dimension::none},
    {"young_modulus_plane_strain", "E, plane strain", io::Dimension::stress},
    {"poisson_ratio_plane_strain", "nu, plane strain", io::Dimension::none},
    {"shear_modulus", "G", io::Dimension::stress},
    {"oedometric_modulus", "C11", io::Dimension::stress},
    {"tensile_strength", "tensile strength", io::Dimension::stress},
    {"compressive_strength", "compr. strength", io::Dimension::stress},
    {"strength_ratio", "compressive / tensile", io::Dimension::none},
    {"shear_strength", "shear strength", io::Dimension::stress},
    {"oedometric_strength", "oedom. strength", io::Dimension::stress},
    {"fracture_energy", "fracture energy", io::Dimension::surface_energy},
};

void draw_curves(Canvas& canvas, const Box& box, const results::MaterialResult& result, const std::string& name) {
  double strain = 0.0, stress = 0.0;
  for (const results::MaterialTest& test : result.tests) {
    if (test.name != name) continue;
    for (const double value : test.curve.strain) strain = std::max(strain, 100.0 * value);
    for (const double value : test.curve.stress) stress = std::max(stress, 1e-6 * value);
  }
  constexpr double headroom = 1.12;
  Chart chart(canvas, box, {0.0, std::max(strain, 1e-6), name == "shear" ? "shear strain (%)" : "strain (%)"},
              {0.0, std::max(headroom * stress, 1e-9), "stress (MPa)"});
  chart.draw_axes();
  for (const results::MaterialTest& test : result.tests) {
    if (test.name != name) continue;
    std::vector<double> x = test.curve.strain, y = test.curve.stress;
    for (double& value : x) value *= 100.0;
    for (double& value : y) value *= 1e-6;
    const bool drawn_below = test.frame.has_value();
    chart.polyline(x, y, drawn_below ? palette::blue : palette::soft_ink, drawn_below ? 2.4 : 1.4,
                   drawn_below ? 1.0 : 0.6);
  }
}

void draw_sample(Canvas& canvas, const Box& room, const results::MaterialResult& result, const std::string& name) {
  for (const results::MaterialTest& test : result.tests) {
    if (test.name != name || !test.frame) continue;
    const BlockPicture picture = picture_of_frame(*test.frame, result.sample);
    const Box box = fit_block(picture, room, 0.0);
    draw_block(canvas, box, picture);
    if (name == columns[0].first)
      draw_scale_bar(canvas, box.right(), box.bottom() + 26.0, box.width / picture.extent_x());
  }
}

void draw_numbers(Canvas& canvas, const results::MaterialResult& result) {
  const auto material = result.summary.find("material");
  if (material == result.summary.end()) return;
  constexpr int columns_of_numbers = 4, rows = 3;
  const double width = (page_width - 2.0 * page_margin) / columns_of_numbers;
  int place = 0;
  for (const Number& entry : numbers) {
    const auto found = material->find(entry.key);
    if (found == material->end() || !found->at("mean").is_number()) continue;
    const int column = place / rows;
    const double x = page_margin + width * column, y = facts_top + 38.0 * (place % rows);
    ++place;
    const double mean = found->at("mean").get<double>();
    const auto& deviation = found->at("standard_deviation");
    const std::string text = deviation.is_number()
                                 ? io::quantities({mean, deviation.get<double>()}, entry.dimension, " ± ")
                                 : io::quantity(mean, entry.dimension);
    canvas.text(x, y, entry.label, {.size = 17.0, .colour = palette::soft_ink});
    canvas.text(x + width - 30.0, y, text, {.size = 17.0, .bold = true, .align = Align::right});
    canvas.line(x, y + 11.0, x + width - 30.0, y + 11.0, palette::grid);
  }
}

}  // namespace

void plot_material_tests(const std::filesystem::path& test_file, const std::filesystem::path& out,
                         const PlotOptions& options) {
  const results::MaterialResult result = results::read_material_tests(test_file);
  Canvas canvas(out, page_width, page_height);
  const std::string title = options.title.empty() ? results::title_of(result.provenance, result.path) : options.title;
  const TextStyle title_style{.size = 30.0, .bold = true};
  canvas.text(page_margin, 56.0, canvas.fit(title, page_width - 2.0 * page_margin, title_style), title_style);
  int replicates = 0;
  for (const results::MaterialTest& test : result.tests) replicates = std::max(replicates, test.replicate + 1);
  canvas.text(
      page_margin, 88.0,
      fmt::format("Solid samples of {}, {} discs of {} mean diameter; {}",
                  io::quantities({result.sample.width, result.sample.height}, io::Dimension::length, " x "),
                  io::count(result.sample.size()), io::quantity(result.sample.mean_diameter(), io::Dimension::length),
                  replicates == 1 ? std::string("one sample")
                                  : fmt::format("{} samples (mean ± standard deviation); blue and below: the "
                                                "first",
                                                replicates)),
      {.size = 17.0, .colour = palette::soft_ink});
  std::vector<std::pair<const char*, const char*>> shown;
  for (const auto& column : columns)
    if (std::any_of(result.tests.begin(), result.tests.end(),
                    [&](const results::MaterialTest& test) { return test.name == column.first; }))
      shown.push_back(column);
  const double width = (page_width - 2.0 * page_margin) / static_cast<double>(columns.size());
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const double left = page_margin + width * static_cast<double>(k);
    canvas.text(left + tick_room, chart_top - 18.0, shown[k].second, {.size = 19.0, .bold = true});
    draw_curves(canvas, {left + tick_room, chart_top, width - tick_room - 20.0, chart_height}, result, shown[k].first);
    draw_sample(canvas, {left + 20.0, sample_top, width - 40.0, sample_height}, result, shown[k].first);
  }
  draw_numbers(canvas, result);
  canvas.write();
}

}  // namespace perfora::report
