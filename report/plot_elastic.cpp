// What is here: the picture of one elastic response: where a block yields first. What is not: how it is found (solver).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "io/text.h"
#include "report/block_picture.h"
#include "report/canvas.h"
#include "report/chart.h"
#include "report/plot.h"
#include "results/elastic_file.h"
#include "results/summary_numbers.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0;
constexpr double page_height = 1000.0;
constexpr double side_panel = 1010.0;  ///< where the panels right of the block begin
constexpr double page_margin = 44.0;
constexpr double line_height = 33.0;
constexpr int nearness_bins = 25;

/// Even steps in lightness, pale to dark, in order also for colour-blind readers and on paper: matplotlib's "magma"
/// (S. van der Walt, N. Smith, 2015) without its black end.
constexpr std::array scale_colours = {hex(0xfbfdbf), hex(0xfec287), hex(0xfb8761), hex(0xe55064),
                                      hex(0xb5367a), hex(0x812581), hex(0x4f127b), hex(0x1c1044)};

Colour nearness_colour(double nearness) {
  const double place = std::clamp(nearness, 0.0, 1.0) * static_cast<double>(scale_colours.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), scale_colours.size() - 2);
  return mix(scale_colours[below], scale_colours[below + 1], place - static_cast<double>(below));
}

/// First yield strain of the block over that of each disc: 1 where it begins, 0 where nothing would ever yield.
std::vector<double> nearness_of(const results::ElasticResult& elastic) {
  if (elastic.disc_strain.empty()) return {};
  const double first = *std::min_element(elastic.disc_strain.begin(), elastic.disc_strain.end());
  std::vector<double> nearness;
  for (const double strain : elastic.disc_strain) nearness.push_back(std::isfinite(strain) ? first / strain : 0.0);
  return nearness;
}

BlockPicture picture_of(const results::ElasticResult& elastic, const std::vector<double>& nearness) {
  BlockPicture picture = picture_of_packing(elastic.clipped);
  picture.growth.assign(nearness.size(), bonded_growth);
  std::transform(nearness.begin(), nearness.end(), picture.colour.begin(), nearness_colour);
  return picture;
}

using Fact = std::pair<std::string, std::string>;

std::vector<Fact> yield_facts(const results::ElasticResult& elastic) {
  const auto number = [&](const char* key) { return results::summary_number(elastic.summary, key); };
  std::vector<Fact> facts;
  if (const auto strain = number("first_yield_strain"))
    facts.emplace_back("first yield at strain", io::quantity(*strain, io::Dimension::ratio));
  if (const auto stress = number("first_yield_stress"))
    facts.emplace_back("at stress", io::quantity(*stress, io::Dimension::stress));
  if (const auto stress = number("first_yield_lateral_stress"))
    facts.emplace_back("lateral", io::quantity(*stress, io::Dimension::stress));
  if (!elastic.first_bonds.x.empty())
    facts.emplace_back(
        "first bond (x, y)",
        fmt::format("{}, {}",
                    io::quantities({elastic.first_bonds.x[0], elastic.first_bonds.y[0]}, io::Dimension::length, ", "),
                    elastic.first_bonds.mode[0] == 0 ? "tension" : "shear"));
  return facts;
}

std::vector<Fact> modulus_facts(const results::ElasticResult& elastic) {
  const auto number = [&](const char* key) { return results::summary_number(elastic.summary, key); };
  std::vector<Fact> facts;
  const auto stress = [&](const char* label, const char* key) {
    if (const auto value = number(key)) facts.emplace_back(label, io::quantity(*value, io::Dimension::stress));
  };
  stress("Young's modulus along x", "young_x");
  stress("Young's modulus along y", "young_y");
  stress("modulus along y, width held", "oedometric_modulus");
  stress("shear modulus", "shear_modulus");
  const auto xy = number("poisson_xy"), yx = number("poisson_yx");
  if (xy && yx) facts.emplace_back("contraction xy, yx", io::quantities({*xy, *yx}, io::Dimension::none, ", "));
  if (const auto fraction = number("affine_share"))
    facts.emplace_back("of the affine (Voigt) bound", io::quantity(*fraction, io::Dimension::ratio));
  if (const auto fraction = number("anisotropy"))
    facts.emplace_back("anisotropy", io::quantity(*fraction, io::Dimension::ratio));
  const auto bonds = number("bonds");
  if (bonds) facts.emplace_back("discs, bonds", io::count(elastic.clipped.size()) + ", " + io::count(*bonds));
  return facts;
}

double draw_facts(Canvas& canvas, const std::string& title, const std::vector<Fact>& facts, double y) {
  canvas.text(side_panel, y, title, {.size = 19.0, .bold = true});
  y += line_height;
  for (const Fact& fact : facts) {
    canvas.text(side_panel, y, fact.first, {.size = 17.0, .colour = palette::soft_ink});
    canvas.text(page_width - page_margin, y, fact.second, {.size = 17.0, .bold = true, .align = Align::right});
    canvas.line(side_panel, y + 10.0, page_width - page_margin, y + 10.0, palette::grid);
    y += line_height;
  }
  return y;
}

/// Colour bar with the fraction of discs of each colour above it.
void draw_colour_bar(Canvas& canvas, const std::vector<double>& nearness, const Box& box) {
  constexpr double bar_height = 16.0;
  std::vector<double> count(nearness_bins, 0.0);
  for (const double value : nearness)
    count[static_cast<std::size_t>(std::clamp(static_cast<int>(value * nearness_bins), 0, nearness_bins - 1))] +=
        100.0 / static_cast<double>(nearness.size());
  const double most = *std::max_element(count.begin(), count.end());
  Chart chart(canvas, box, {0.0, 1.0, "first yield of the block / first yield of the disc (strains)"},
              {0.0, 1.12 * most, "discs (%)"});
  chart.draw_axes();
  for (int bin = 0; bin < nearness_bins; ++bin) {
    const double left = chart.px(static_cast<double>(bin) / nearness_bins),
                 right = chart.px(static_cast<double>(bin + 1) / nearness_bins);
    const double top = chart.py(count[static_cast<std::size_t>(bin)]);
    const Box column{left + 1.0, top, right - left - 2.0, box.bottom() - top};
    const Colour colour = nearness_colour((bin + 0.5) / nearness_bins);
    canvas.fill(column, colour);
    canvas.frame(column, mix(colour, palette::ink, 0.35), 0.8);
  }
  const Box bar{box.x, box.y - bar_height - 6.0, box.width, bar_height};
  for (double x = bar.x; x < bar.right(); x += 1.0)
    canvas.fill({x, bar.y, std::min(1.5, bar.right() - x), bar.height}, nearness_colour((x - bar.x + 0.5) / bar.width));
  canvas.frame(bar, palette::ink, 1.0);
}

/// Rings around the first bonds: thick for the first, thin for those that follow within two per cent.
void mark_first_bonds(Canvas& canvas, const Box& box, const results::ElasticResult& elastic) {
  const double scale = box.width / elastic.clipped.width;
  cairo_t* context = canvas.context();
  const auto ring = [&](std::size_t k, double radius, double thickness) {
    const double x = box.x + elastic.first_bonds.x[k] * scale, y = box.bottom() - elastic.first_bonds.y[k] * scale;
    for (const bool rim : {true, false}) {
      cairo_new_sub_path(context);
      cairo_arc(context, x, y, radius, 0.0, 2.0 * std::numbers::pi);
      set_colour(context, rim ? palette::paper : palette::blue);
      cairo_set_line_width(context, rim ? thickness + 2.5 : thickness);
      cairo_stroke(context);
    }
  };
  for (std::size_t k = elastic.first_bonds.x.size(); k-- > 1;) ring(k, 9.0, 1.8);
  if (!elastic.first_bonds.x.empty()) ring(0, 16.0, 3.5);
}

void draw_title(Canvas& canvas, const results::ElasticResult& elastic, const PlotOptions& options) {
  const std::string title = options.title.empty() ? results::title_of(elastic.provenance, elastic.path) : options.title;
  const TextStyle style{.size = 30.0, .bold = true};
  canvas.text(page_margin, 56.0, canvas.fit(title, page_width - 2.0 * page_margin, style), style);
  canvas.text(
      page_margin, 88.0,
      fmt::format("{}, periodic; elastic response to compression along y at fixed width",
                  io::quantities({elastic.clipped.width, elastic.clipped.height}, io::Dimension::length, " x ")),
      {.size = 17.0, .colour = palette::soft_ink});
}

}  // namespace

void draw_elastic(const results::ElasticResult& elastic, const std::filesystem::path& out, const PlotOptions& options) {
  Canvas canvas(out, page_width, page_height);
  draw_title(canvas, elastic, options);
  const std::vector<double> nearness = nearness_of(elastic);
  const BlockPicture picture = picture_of(elastic, nearness);
  Box box = fit_block(picture, {page_margin, 116.0, side_panel - page_margin - 110.0, page_height - 116.0 - 52.0}, 0.0);
  box.x = page_margin;
  draw_block(canvas, box, picture);
  draw_perforation_rims(canvas, box, elastic.layout, palette::concrete_edge);
  mark_first_bonds(canvas, box, elastic);
  canvas.text(box.x, box.bottom() + 28.0, "ring: the first bond to yield; small rings: those within 2 % of its strain",
              {.size = 15.0, .colour = palette::soft_ink});
  draw_scale_bar(canvas, box.right(), box.bottom() + 26.0, box.width / picture.extent_x());
  double y = draw_facts(canvas, "First yield", yield_facts(elastic), 136.0);
  y = draw_facts(canvas, "Block", modulus_facts(elastic), y + 14.0);
  if (!nearness.empty())
    draw_colour_bar(
        canvas, nearness,
        {side_panel + 62.0, y + 34.0, page_width - page_margin - side_panel - 62.0, page_height - (y + 34.0) - 80.0});
  canvas.write();
}

void plot_elastic(const std::filesystem::path& elastic_file, const std::filesystem::path& out,
                  const PlotOptions& options) {
  draw_elastic(results::read_elastic(elastic_file), out, options);
}

}  // namespace perfora::report
