// What is here: the picture of a design before any run: its holes, its thinnest wall, the direction of loading. What is
// not: workshop drawings with every dimension (export/), packings (plot_packing.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/wall.h"
#include "io/text.h"
#include "report/block_picture.h"
#include "report/canvas.h"
#include "report/plot.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0, page_margin = 44.0, tallest = 900.0, top = 110.0;
constexpr double side_panel = 1090.0, fact_step = 37.0, arrow_room = 64.0;

using Fact = std::pair<std::string, std::string>;

std::vector<Fact> facts_of(const geometry::PerforationLayout& layout, const geometry::ThinnestWall& wall,
                           double mean_diameter) {
  std::vector<Fact> facts = {{"block", io::quantities({layout.width, layout.height}, io::Dimension::length, " x ")},
                             {"holes", io::count(layout.perforations.size())},
                             {"porosity", io::quantity(1.0 - layout.solid_area_fraction(), io::Dimension::ratio)}};
  if (wall.first >= 0) {
    facts.emplace_back("thinnest wall", io::quantity(wall.thickness, io::Dimension::length));
    facts.emplace_back("between holes", wall.first == wall.second
                                            ? fmt::format("{} and its image", wall.first + 1)
                                            : fmt::format("{} and {}", wall.first + 1, wall.second + 1));
    facts.emplace_back("discs across it", io::number(wall.thickness / mean_diameter));
  }
  return facts;
}

void draw_facts(Canvas& canvas, const std::vector<Fact>& facts, double left, double right, double y) {
  for (const auto& [name, value] : facts) {
    canvas.text(left, y, name, {.size = 18.0, .colour = palette::soft_ink});
    canvas.text(right, y, value, {.size = 18.0, .bold = true, .align = Align::right});
    canvas.line(left, y + 11.0, right, y + 11.0, palette::grid);
    y += fact_step;
  }
}

/// The shortest line through the wall, with both ends marked; with its periodic images it may stand at the other edge.
void draw_wall(Canvas& canvas, const Box& box, const geometry::PerforationLayout& layout,
               const geometry::ThinnestWall& wall) {
  if (wall.first < 0) return;
  const double scale = box.width / layout.width;
  cairo_t* context = canvas.context();
  cairo_save(context);
  cairo_rectangle(context, box.x, box.y, box.width, box.height);
  cairo_clip(context);
  for (int a = -1; a <= 1; ++a)
    for (int b = -1; b <= 1; ++b) {
      const double dx = a * layout.width, dy = b * layout.height;
      const double x0 = box.x + (wall.from.x + dx) * scale, y0 = box.bottom() - (wall.from.y + dy) * scale;
      const double x1 = box.x + (wall.to.x + dx) * scale, y1 = box.bottom() - (wall.to.y + dy) * scale;
      canvas.line(x0, y0, x1, y1, palette::vermilion, 5.0);
      canvas.disc(x0, y0, 5.0, palette::vermilion, palette::paper, 1.0);
      canvas.disc(x1, y1, 5.0, palette::vermilion, palette::paper, 1.0);
    }
  cairo_restore(context);
}

/// The number of each hole that has room for one, as drawings and messages count them; else of those beside the
/// thinnest wall alone.
void draw_hole_numbers(Canvas& canvas, const Box& box, const geometry::PerforationLayout& layout,
                       const geometry::ThinnestWall& wall) {
  constexpr double least = 11.0, most = 18.0, beside_wall = 16.0, of_hole = 0.75;
  const double scale = box.width / layout.width;
  for (std::size_t k = 0; k < layout.perforations.size(); ++k) {
    const geometry::Perforation& hole = layout.perforations[k];
    const int number = static_cast<int>(k);
    const double room = of_hole * hole.smallest_extent() * scale;
    const bool named = number == wall.first || number == wall.second;
    if (room < least && !named) continue;
    const double size = std::clamp(room, named ? beside_wall : least, most);
    const TextStyle style{
        .size = size, .colour = named ? palette::ink : palette::soft_ink, .align = Align::centre, .halo = room < size};
    const std::string text = std::to_string(k + 1);
    const double half = 0.5 * canvas.text_width(text, style) + 4.0;  // a hole over an edge has it inside
    const double x = std::clamp(hole.x * scale, half, box.width - half);
    const double y = std::clamp(hole.y * scale, 0.7 * size, box.height - 0.7 * size);
    canvas.text(box.x + x, box.bottom() - y + 0.36 * size, text, style);
  }
}

/// Arrows onto the upper and the lower edge: the block is compressed upright.
void draw_loading(Canvas& canvas, const Box& box) {
  for (int k = 1; k <= 3; ++k) {
    const double x = box.x + box.width * k / 4.0;
    for (const double down : {1.0, -1.0}) {
      const double tip = down > 0.0 ? box.y - 6.0 : box.bottom() + 6.0, tail = tip - down * 38.0;
      canvas.line(x, tail, x, tip, palette::ink, 2.5);
      canvas.line(x - 7.0, tip - down * 12.0, x, tip, palette::ink, 2.5);
      canvas.line(x + 7.0, tip - down * 12.0, x, tip, palette::ink, 2.5);
    }
  }
}

}  // namespace

void plot_layout(const geometry::PerforationLayout& layout, double mean_diameter, const std::filesystem::path& out,
                 const PlotOptions& options) {
  const geometry::ThinnestWall wall = geometry::thinnest_wall(layout);
  const std::vector<Fact> facts = facts_of(layout, wall, mean_diameter);
  // Wide blocks take the width of the page, with the facts below; others leave them the right.
  constexpr double wide_from = 1.5;
  const double shape = layout.width / layout.height;
  const bool wide = shape > wide_from;
  const double room = (wide ? page_width - page_margin : side_panel - 70.0) - page_margin;
  const double scale = std::min(room / layout.width, (tallest - 2.0 * arrow_room) / layout.height);
  const Box box{page_margin + (wide ? 0.5 * (room - scale * layout.width) : 0.0), top + arrow_room,
                scale * layout.width, scale * layout.height};
  const double facts_height = fact_step * static_cast<double>(facts.size());
  const double under = box.bottom() + arrow_room + 30.0;
  const double page_height = wide ? under + facts_height + 50.0 : std::max(under, top + facts_height) + 30.0;
  Canvas canvas(out, page_width, page_height);
  const TextStyle title_style{.size = 30.0, .bold = true};
  canvas.text(page_margin, 56.0, canvas.fit(options.title, page_width - 2.0 * page_margin, title_style), title_style);
  canvas.text(page_margin, 88.0,
              wall.first < 0 ? "the design before any run; no holes"
                             : "the design before any run; orange: its thinnest wall; arrows: loading",
              {.size = 17.0, .colour = palette::soft_ink});
  draw_layout(canvas, box, layout);
  draw_hole_numbers(canvas, box, layout, wall);
  draw_wall(canvas, box, layout, wall);
  draw_loading(canvas, box);
  draw_scale_bar(canvas, box.right(), box.bottom() + arrow_room, scale);
  if (wide)
    draw_facts(canvas, facts, page_margin, page_width - page_margin, under + 30.0);
  else
    draw_facts(canvas, facts, std::max(box.right() + 60.0, side_panel), page_width - page_margin, box.y + 24.0);
  canvas.write();
}

}  // namespace perfora::report
