// What is here: the picture of one packing. What is not: the parts it is put together from (block_picture.h, chart.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/text.h"
#include "report/block_picture.h"
#include "report/canvas.h"
#include "report/chart.h"
#include "report/plot.h"
#include "results/pack_file.h"
#include "results/summary_numbers.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0;
constexpr double page_height = 1000.0;
constexpr double side_panel = 1010.0;  ///< where the panels right of the block begin
constexpr double page_margin = 44.0;
constexpr int size_bins = 24;

using Fact = std::pair<std::string, std::string>;

std::vector<Fact> facts_of(const results::PackResult& pack) {
  const geometry::PackingQuality& quality = pack.periodic.quality;
  const auto number = [&](const char* key) { return results::summary_number(pack.summary, key); };
  std::vector<Fact> facts = {
      {"discs", io::count(pack.clipped.size()) + " of " + io::count(pack.periodic.size()) + " packed"},
      {"mean diameter", io::quantity(pack.clipped.mean_diameter(), io::Dimension::length)},
      {"solid fraction of the packing", io::quantity(quality.solid_fraction, io::Dimension::ratio)}};
  if (quality.jamming_fraction > 0.0)
    facts.emplace_back("jammed at", io::quantity(quality.jamming_fraction, io::Dimension::ratio));
  if (const auto porosity = number("porosity"))
    facts.emplace_back("porosity of the block", io::quantity(*porosity, io::Dimension::ratio));
  if (const auto bonds = number("bonds_per_disc")) facts.emplace_back("bonds per disc", io::number(*bonds));
  facts.emplace_back("holes", io::count(pack.layout.perforations.size()));
  if (const auto wall = number("thinnest_wall")) {
    std::string text = io::quantity(*wall, io::Dimension::length);
    if (const auto between = number("thinnest_wall_discretised"))
      text += " (" + io::quantity(*between, io::Dimension::length) + " between discs)";
    facts.emplace_back("thinnest wall", text);
  }
  facts.emplace_back("largest overlap", quality.max_overlap_ratio > 0.0
                                            ? io::number(quality.max_overlap_ratio) + " of the smaller diameter"
                                            : "none");
  if (quality.coordination_number > 0.0)
    facts.emplace_back("coordination number", io::number(quality.coordination_number));
  return facts;
}

void draw_facts(Canvas& canvas, const std::vector<Fact>& facts, double top) {
  double y = top;
  for (const Fact& fact : facts) {
    const TextStyle value_style{.size = 17.0, .bold = true, .align = Align::right};
    canvas.text(side_panel, y, fact.first, {.size = 17.0, .colour = palette::soft_ink});
    canvas.text(page_width - page_margin, y, fact.second, value_style);
    canvas.line(side_panel, y + 11.0, page_width - page_margin, y + 11.0, palette::grid);
    y += 37.0;
  }
}

/// Number of discs over diameter, bars in the colours of the discs.
void draw_sizes(Canvas& canvas, const geometry::Packing& packing, const Box& box) {
  const auto [low, high] = std::minmax_element(packing.radius.begin(), packing.radius.end());
  const double smallest = 2e3 * *low;
  const double span = std::max(2e3 * *high - smallest, 1e-3 * smallest);
  std::vector<double> count(size_bins, 0.0);
  for (double radius : packing.radius)
    count[static_cast<std::size_t>(
        std::clamp(static_cast<int>((2e3 * radius - smallest) / span * size_bins), 0, size_bins - 1))] += 1.0;
  for (double& value : count) value *= 100.0 / static_cast<double>(packing.radius.size());
  const double most = *std::max_element(count.begin(), count.end());
  Chart chart(canvas, box, {smallest - 0.02 * span, smallest + 1.02 * span, "diameter (mm)"},
              {0.0, 1.12 * most, "discs (%)"});
  chart.draw_axes();
  for (int bin = 0; bin < size_bins; ++bin) {
    const double left = chart.px(smallest + span * bin / size_bins);
    const double right = chart.px(smallest + span * (bin + 1) / size_bins);
    const double top = chart.py(count[static_cast<std::size_t>(bin)]);
    const Box bar{left + 1.0, top, right - left - 2.0, box.bottom() - top};
    canvas.fill(bar, size_colour((bin + 0.5) / size_bins));
    canvas.frame(bar, mix(size_colour((bin + 0.5) / size_bins), palette::ink, 0.35), 0.8);
  }
}

}  // namespace

void draw_packing(const results::PackResult& pack, const std::filesystem::path& out, const PlotOptions& options) {
  Canvas canvas(out, page_width, page_height);
  const std::string title = options.title.empty() ? results::title_of(pack.provenance, pack.path) : options.title;
  const TextStyle title_style{.size = 30.0, .bold = true};
  canvas.text(page_margin, 56.0, canvas.fit(title, page_width - 2.0 * page_margin, title_style), title_style);
  canvas.text(page_margin, 88.0,
              fmt::format("{}, periodic; packing {}, seed {}",
                          io::quantities({pack.clipped.width, pack.clipped.height}, io::Dimension::length, " x "),
                          pack.periodic.key.protocol, pack.periodic.key.seed),
              {.size = 17.0, .colour = palette::soft_ink});
  const BlockPicture picture = picture_of_packing(pack.clipped);
  Box box = fit_block(picture, {page_margin, 116.0, side_panel - page_margin - 110.0, page_height - 116.0 - 52.0}, 0.0);
  box.x = page_margin;
  draw_block(canvas, box, picture);
  draw_perforation_rims(canvas, box, pack.layout, palette::vermilion);
  draw_scale_bar(canvas, box.right(), box.bottom() + 26.0, box.width / picture.extent_x());
  const std::vector<Fact> facts = facts_of(pack);
  draw_facts(canvas, facts, 140.0);
  const double top = 140.0 + 37.0 * static_cast<double>(facts.size()) + 16.0;
  if (pack.clipped.size() > 0)
    draw_sizes(canvas, pack.clipped,
               {side_panel + 62.0, top, page_width - page_margin - side_panel - 62.0, page_height - top - 80.0});
  canvas.write();
}

void plot_packing(const std::filesystem::path& packing_file, const std::filesystem::path& out,
                  const PlotOptions& options) {
  draw_packing(results::read_pack(packing_file), out, options);
}

}  // namespace perfora::report
