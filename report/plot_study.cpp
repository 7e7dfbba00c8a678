// What is here: the picture of a study. What is not: the parts it is put together from (curve_panel.h, block_picture.h,
// search_panel.h).
#include "report/plot_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text.h"
#include "report/block_picture.h"
#include "report/canvas.h"
#include "report/curve_mean.h"
#include "report/curve_panel.h"
#include "report/measured_curves.h"
#include "report/search_panel.h"
#include "report/verdict_line.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0;
constexpr double page_height = 1000.0;
constexpr double page_margin = 44.0;
constexpr double left_axis = 120.0;
constexpr double left_end = 850.0;
constexpr double right_start = 915.0;
constexpr Colour best_colour = palette::blue;
constexpr Colour start_colour = hex(0xc27800);
/// "best (5 replicates)" with a piece of its line.
double draw_curve_key(Canvas& canvas, double x, double y, const Colour& colour, const std::string& text) {
  canvas.line(x, y - 5.5, x + 30.0, y - 5.5, colour, 3.2);
  const TextStyle style{.size = 15.0};
  canvas.text(x + 38.0, y, text, style);
  return x + 38.0 + canvas.text_width(text, style) + 30.0;
}

std::string replicate_text(const char* what, std::size_t count, const std::optional<double>& plateau,
                           const std::optional<double>& deviation) {
  std::string text = fmt::format("{} ({} replicate{})", what, count, count == 1 ? "" : "s");
  if (plateau && deviation)
    text += ": " + io::quantities({*plateau, *deviation}, io::Dimension::stress, " \u00b1 ");
  else if (plateau)
    text += ": " + io::quantity(*plateau, io::Dimension::stress);
  return text;
}

void draw_curves(Canvas& canvas, const results::StudyRecord& picture, const Box& box) {
  double x = box.x;
  if (!picture.best.empty())
    x = draw_curve_key(
        canvas, x, box.y - 16.0, best_colour,
        replicate_text("best", picture.best.size(), picture.best_plateau, picture.best_plateau_deviation));
  if (!picture.start.empty())
    x = draw_curve_key(
        canvas, x, box.y - 16.0, start_colour,
        replicate_text("start", picture.start.size(), picture.start_plateau, picture.start_plateau_deviation));
  draw_measured_key(canvas, x, box.y - 16.0, box.right(), picture.measured);
  const results::Curve best_mean = smoothed_mean(picture.best);
  const results::Curve start_mean = smoothed_mean(picture.start);
  std::vector<Series> series;
  for (const results::Curve& curve : picture.start)
    series.push_back({curve.strain, curve.stress, start_colour, 1.0, 0.28});
  for (const results::Curve& curve : picture.best)
    series.push_back({curve.strain, curve.stress, best_colour, 1.0, 0.28});
  series.push_back({start_mean.strain, start_mean.stress, start_colour, 2.6, 1.0});
  series.push_back({best_mean.strain, best_mean.stress, best_colour, 3.0, 1.0});
  if (!picture.target_curve.strain.empty())
    series.push_back({picture.target_curve.strain, picture.target_curve.stress, palette::green, 2.0, 1.0});
  CurveMarks marks;
  marks.plateau_start = picture.window_start;
  marks.plateau_end = picture.window_end;
  marks.plateau_stress = picture.best_plateau;
  marks.target_stress = picture.target;
  marks.target_tolerance = picture.target_tolerance;
  marks.caps = picture.caps;
  marks.measured = picture.measured;
  draw_curve_panel(canvas, box, series, marks, 0.42);
}

/// Start and best design side by side at one scale, both standing on one line.
void draw_designs(Canvas& canvas, const results::StudyRecord& picture) {
  constexpr double right = page_width - page_margin, bottom = 560.0, height = 380.0, gap = 34.0;
  const auto width_of = [](const auto& layout) { return layout ? layout->width : 0.0; };
  const auto height_of = [](const auto& layout) { return layout ? layout->height : 0.0; };
  const double widths = width_of(picture.best_layout) + width_of(picture.start_layout);
  const double tallest = std::max(height_of(picture.best_layout), height_of(picture.start_layout));
  if (!(widths > 0.0)) return;
  const bool both = picture.best_layout && picture.start_layout;
  const double scale = std::min((right - right_start - (both ? gap : 0.0)) / widths, height / tallest);
  const auto draw = [&](const geometry::PerforationLayout& layout, double end, const std::string& name,
                        const Colour& colour) {
    const Box box{end - layout.width * scale, bottom - layout.height * scale, layout.width * scale,
                  layout.height * scale};
    draw_layout(canvas, box, layout);
    const TextStyle style{.size = 18.0, .colour = mix(colour, palette::ink, 0.3), .bold = true};
    canvas.text(box.x, box.y - 12.0, canvas.fit(name, box.width, style), style);
    return box;
  };
  double end = right;
  if (picture.best_layout) {
    const std::string name =
        picture.best_number > 0 ? fmt::format("best design (candidate {})", picture.best_number) : "best design";
    const Box box = draw(*picture.best_layout, end, name, best_colour);
    draw_scale_bar(canvas, box.right(), box.bottom() + 26.0, scale);
    end = box.x - gap;
  }
  if (picture.start_layout) draw(*picture.start_layout, end, "start", start_colour);
}

void draw_fact_table(Canvas& canvas, const results::StudyRecord& picture) {
  constexpr double row_height = 33.0;
  constexpr double top = 626.0;
  const double right = page_width - page_margin;
  const double start_column = right - 232.0;
  const TextStyle head{.size = 16.0, .colour = palette::soft_ink, .align = Align::right};
  const bool compare =
      std::any_of(picture.facts.begin(), picture.facts.end(), [](const auto& fact) { return !fact.start.empty(); });
  if (compare) canvas.text(start_column, top, "start", head);
  canvas.text(right, top, "best", head);
  canvas.line(right_start, top + 11.0, right, top + 11.0, palette::soft_ink);
  double y = top + row_height;
  for (const results::StudyRecord::Fact& fact : picture.facts) {
    if (y > page_height - 22.0) break;
    const TextStyle name{.size = 17.0, .colour = palette::soft_ink};
    const TextStyle plain{.size = 17.0, .align = Align::right};
    const TextStyle strong{.size = 17.0, .bold = true, .align = Align::right};
    canvas.text(right_start, y, canvas.fit(fact.name, start_column - 172.0 - right_start, name), name);
    canvas.text(start_column, y, canvas.fit(fact.start, 165.0, plain), plain);
    canvas.text(right, y, canvas.fit(fact.best, 220.0, strong), strong);
    canvas.line(right_start, y + 10.0, right, y + 10.0, palette::grid);
    y += row_height;
  }
}

}  // namespace

void plot_study(const results::StudyRecord& picture, const std::filesystem::path& out) {
  Canvas canvas(out, page_width, page_height);
  const TextStyle title{.size = 30.0, .bold = true};
  const TextStyle line{.size = 17.0, .colour = palette::soft_ink};
  canvas.text(page_margin, 56.0, canvas.fit(picture.title, page_width - 2.0 * page_margin, title), title);
  canvas.text(page_margin, 88.0, canvas.fit(picture.subtitle, page_width - 2.0 * page_margin, line), line);
  draw_verdict(canvas, page_margin, 117.0, page_width - 2.0 * page_margin, picture.outcome, picture.verdict);
  draw_search(canvas, picture, {left_axis, 198.0, left_end - left_axis, 202.0});
  draw_curves(canvas, picture, {left_axis, 524.0, left_end - left_axis, page_height - 524.0 - 74.0});
  draw_designs(canvas, picture);
  draw_fact_table(canvas, picture);
  canvas.write();
}

}  // namespace perfora::report
