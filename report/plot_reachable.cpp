// What is here: the chart of a calibration: which ratios of strengths can be reached. What is not: the search
// (optimize/search/calibration.h).

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "io/text.h"
#include "report/canvas.h"
#include "report/chart.h"
#include "report/plot.h"
#include "results/calibration_record.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0;
constexpr double page_height = 900.0;
constexpr double legend_left = 1270.0;

struct Point {
  double shear_ratio, ratio;
  bool of_chart;
};
using Curves = std::map<double, std::vector<Point>>;  ///< by zeta_max, each by rising shear_ratio

Curves curves_of(const results::CalibrationRecord& record) {
  Curves curves;
  for (const auto& p : record.points) curves[p.rupture_delay].push_back({p.shear_ratio, p.strength_ratio, p.of_chart});
  for (auto& [delay, points] : curves)
    std::sort(points.begin(), points.end(),
              [](const Point& a, const Point& b) { return a.shear_ratio < b.shear_ratio; });
  return curves;
}

void draw_legend(Canvas& canvas, const Curves& curves, bool with_target) {
  double y = 170.0;
  canvas.text(legend_left, y, "zeta_max (rupture delay)", {.size = 18.0, .bold = true});
  std::size_t k = 0;
  for (const auto& [delay, points] : curves) {
    y += 36.0;
    const Colour colour = palette::series()[k++ % palette::series().size()];
    canvas.line(legend_left, y - 6.0, legend_left + 40.0, y - 6.0, colour, 3.0);
    canvas.text(legend_left + 54.0, y, io::number(delay), {.size = 17.0});
  }
  y += 44.0;
  canvas.disc(legend_left + 20.0, y - 6.0, 6.0, palette::paper, palette::ink, 1.6);
  canvas.text(legend_left + 54.0, y, "tested on the way", {.size = 17.0});
  if (!with_target) return;
  y += 36.0;
  canvas.line(legend_left, y - 6.0, legend_left + 40.0, y - 6.0, palette::ink, 2.0, {9.0, 6.0});
  canvas.text(legend_left + 54.0, y, "wanted, and what was found", {.size = 17.0});
}

}  // namespace

void plot_reachable(const results::CalibrationRecord& record, const std::filesystem::path& out,
                    const PlotOptions& options) {
  const Curves curves = curves_of(record);
  double low = 1e300, high = 0.0, bottom = 1e300, top = 0.0;
  for (const auto& [delay, points] : curves)
    for (const Point& p : points) {
      low = std::min(low, p.shear_ratio);
      high = std::max(high, p.shear_ratio);
      bottom = std::min(bottom, p.ratio);
      top = std::max(top, p.ratio);
    }
  if (record.wanted) {
    bottom = std::min(bottom, *record.wanted);
    top = std::max(top, *record.wanted);
  }
  if (!(high > 0.0)) low = 1.0, high = 10.0, bottom = 1.0, top = 10.0;
  Canvas canvas(out, page_width, page_height);
  canvas.text(44.0, 56.0, options.title.empty() ? "Ratios of strengths that can be reached" : options.title,
              {.size = 30.0, .bold = true});
  canvas.text(44.0, 88.0,
              "Uniaxial compressive over tensile strength of the solid material, against the shear threshold of its "
              "bonds over their tension threshold",
              {.size = 17.0, .colour = palette::soft_ink});
  constexpr double margin = 1.12;
  Chart chart(canvas, {120.0, 130.0, legend_left - 120.0 - 60.0, page_height - 130.0 - 90.0},
              {low / margin, high * margin, "delta_t0 / delta_n0", true},
              {bottom / margin, margin * top, "compressive / tensile strength", true});
  chart.draw_axes();
  std::size_t k = 0;
  for (const auto& [delay, points] : curves) {
    const Colour colour = palette::series()[k++ % palette::series().size()];
    std::vector<double> x, y;
    for (const Point& p : points) {
      x.push_back(p.shear_ratio);
      y.push_back(p.ratio);
    }
    chart.polyline(x, y, colour, 2.6);
    for (const Point& p : points)
      canvas.disc(chart.px(p.shear_ratio), chart.py(p.ratio), 6.0, p.of_chart ? colour : palette::paper, colour, 1.8);
  }
  if (record.wanted) {
    chart.horizontal(*record.wanted, chart.x_axis().low, chart.x_axis().high, palette::ink, 2.0, {9.0, 6.0});
    if (record.found) chart.vertical(*record.found, palette::ink, 2.0, {9.0, 6.0});
  }
  draw_legend(canvas, curves, record.wanted.has_value());
  canvas.write();
}

}  // namespace perfora::report
