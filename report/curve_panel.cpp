// What is here: ranges, panels and annotations of stress-strain curves. What is not: axes (chart.h).
#include "report/curve_panel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/text.h"
#include "report/measured_curves.h"

namespace perfora::report {
namespace {

constexpr double mega = 1e-6;
constexpr double percent = 100.0;
/// Empty share above the highest point, for the annotations.
constexpr double headroom = 0.26;
/// A curve that ends this many times above what matters before (densification) is cut off there.
constexpr double cut_factor = 1.2;
constexpr double magnify_below = 0.25;
constexpr Colour target_text = hex(0x00704f);
constexpr Colour plateau_colour = hex(0x00527f);

struct Extent {
  double strain = 0.0;     ///< largest, percent
  double lowest = 0.0;     ///< MPa
  double highest = 0.0;    ///< of all rows, MPa
  double early = 0.0;      ///< up to the end of the plateau window, MPa
  double in_window = 0.0;  ///< within it, MPa
};

Extent measure(std::vector<Series> series, const CurveMarks& marks) {
  Extent extent;
  for (const results::Curve& curve : marks.measured) series.push_back({curve.strain, curve.stress});
  const double start = marks.plateau_start.value_or(1.0);
  const double end = marks.plateau_end.value_or(1.0);
  for (const Series& curve : series)
    for (std::size_t k = 0; k < curve.strain.size(); ++k) {
      const double stress = curve.stress[k] * mega;
      extent.strain = std::max(extent.strain, curve.strain[k] * percent);
      extent.lowest = std::min(extent.lowest, stress);
      extent.highest = std::max(extent.highest, stress);
      if (curve.strain[k] <= end) extent.early = std::max(extent.early, stress);
      if (curve.strain[k] >= start && curve.strain[k] <= end) extent.in_window = std::max(extent.in_window, stress);
    }
  extent.early = std::max(extent.early, marks.target_stress.value_or(0.0) * mega);
  return extent;
}

Axis stress_axis(double top, double lowest) {
  Axis axis;
  axis.high = top > 0.0 ? top * (1.0 + headroom) : 1.0;
  axis.low = lowest < -0.01 * axis.high ? std::max(1.1 * lowest, -0.3 * axis.high) : 0.0;
  axis.label = "stress (MPa)";
  return axis;
}

std::string stress_text(double pascal) {
  return io::quantity(pascal, io::Dimension::stress);
}
std::string in_percent(double strain) {
  return io::quantity(strain, io::Dimension::ratio);
}

void draw_grounds(Chart& chart, const CurveMarks& marks) {
  if (marks.plateau_start && marks.plateau_end)
    chart.x_band(*marks.plateau_start * percent, *marks.plateau_end * percent, palette::band, 0.75);
  if (marks.target_stress && marks.target_tolerance)
    chart.y_band((*marks.target_stress - *marks.target_tolerance) * mega,
                 (*marks.target_stress + *marks.target_tolerance) * mega, palette::green, 0.18);
}

void draw_lines(Chart& chart, const std::vector<Series>& series, const CurveMarks& marks) {
  for (const Series& curve : series) {
    std::vector<double> strain(curve.strain.begin(), curve.strain.end());
    std::vector<double> stress(curve.stress.begin(), curve.stress.end());
    for (double& value : strain) value *= percent;
    for (double& value : stress) value *= mega;
    chart.polyline(strain, stress, curve.colour, curve.thickness, curve.opacity);
  }
  draw_measured(chart, marks.measured, {percent, mega}, -std::numeric_limits<double>::infinity());
  if (marks.target_stress)
    chart.horizontal(*marks.target_stress * mega, chart.x_axis().low, chart.x_axis().high, palette::green, 2.0,
                     {9.0, 6.0});
  for (const results::StressCap& cap : marks.caps)
    if (cap.stress * mega <= chart.y_axis().high)
      chart.horizontal(cap.stress * mega, 0.0, std::min(cap.until * percent, chart.x_axis().high), palette::vermilion,
                       2.0, {4.0, 4.0});
  if (marks.plateau_stress && marks.plateau_start && marks.plateau_end)
    chart.horizontal(*marks.plateau_stress * mega, *marks.plateau_start * percent, *marks.plateau_end * percent,
                     plateau_colour, 3.0);
}

/// The text of the plateau, in two lines at the top of its band.
void annotate_window(Canvas& canvas, const Chart& chart, const CurveMarks& marks) {
  if (!marks.plateau_start || !marks.plateau_end) return;
  const double low = chart.px(*marks.plateau_start * percent);
  const double high = std::min(chart.px(*marks.plateau_end * percent), chart.box().right());
  if (low >= chart.box().right()) return;
  const double middle = (low + high) / 2.0;
  canvas.text(middle, chart.box().y + 24.0,
              "plateau " + io::quantities({*marks.plateau_start, *marks.plateau_end}, io::Dimension::ratio, " to "),
              {.size = 15.0, .colour = plateau_colour, .align = Align::centre, .halo = true});
  canvas.text(middle, chart.box().y + 48.0,
              marks.plateau_stress ? "mean " + stress_text(*marks.plateau_stress) : "not reached",
              {.size = 18.0, .colour = plateau_colour, .bold = true, .align = Align::centre, .halo = true});
}

void draw_densification(Canvas& canvas, const Chart& chart, const CurveMarks& marks, double top) {
  if (!marks.densification_strain) return;
  const double x = chart.px(*marks.densification_strain * percent);
  if (x <= chart.box().right()) canvas.line(x, top, x, chart.box().bottom(), palette::soft_ink, 1.6, {3.0, 4.0});
}

/// Line and text below the text of the plateau, which it may run into; text left of the line, because right of it the
/// curve rises.
void annotate_densification(Canvas& canvas, const Chart& chart, const CurveMarks& marks) {
  if (!marks.densification_strain) return;
  draw_densification(canvas, chart, marks, chart.box().y + 68.0);
  const double x = chart.px(*marks.densification_strain * percent) - 9.0;
  canvas.text(x, chart.box().y + 84.0, "densification",
              {.size = 15.0, .colour = palette::soft_ink, .align = Align::right, .halo = true});
  canvas.text(x, chart.box().y + 107.0, in_percent(*marks.densification_strain),
              {.size = 18.0, .colour = palette::soft_ink, .bold = true, .align = Align::right, .halo = true});
}

void annotate_peak(Canvas& canvas, const Chart& chart, const CurveMarks& marks) {
  if (!marks.peak_strain || !marks.peak_stress) return;
  const double x = chart.px(*marks.peak_strain * percent);
  const double y = chart.py(*marks.peak_stress * mega);
  canvas.disc(x, y, 6.0, palette::paper, palette::vermilion, 3.0);
  const double window = marks.plateau_start ? chart.px(*marks.plateau_start * percent) : chart.box().right();
  const TextStyle style{.size = 18.0, .colour = palette::vermilion, .bold = true, .halo = true};
  const TextStyle small{.size = 15.0, .colour = palette::vermilion, .halo = true};
  const std::string value = stress_text(*marks.peak_stress);
  const std::string where = "first peak at " + in_percent(*marks.peak_strain);
  const bool beside = x + 16.0 + canvas.text_width(where, small) < window;
  const double left = beside ? x + 14.0 : x + 2.0;
  canvas.text(left, beside ? y - 4.0 : y - 34.0, value, style);
  canvas.text(left, beside ? y + 16.0 : y - 14.0, where, small);
}

void annotate_target(Canvas& canvas, const Chart& chart, const CurveMarks& marks) {
  if (!marks.target_stress) return;
  const double y = chart.py(*marks.target_stress * mega);
  if (y < chart.box().y) return;
  const std::string text = "target " + stress_text(*marks.target_stress);
  const TextStyle style{.size = 16.0, .colour = target_text, .bold = true, .halo = true};
  const double window =
      marks.plateau_start ? std::min(chart.px(*marks.plateau_start * percent), chart.box().right()) : chart.box().x;
  const double width = canvas.text_width(text, style);
  // Before the window the curve has fallen; behind it, it rises through the line.
  const bool before = window - chart.box().x > width + 60.0;
  canvas.text(before ? window - width - 12.0 : chart.box().right() - width - 10.0, y - 9.0, text, style);
}

/// Above the beginning of each line, or above its end where the first peak has its caption; left out where the line
/// lies beyond the panel.
void annotate_caps(Canvas& canvas, const Chart& chart, const CurveMarks& marks) {
  for (const results::StressCap& cap : marks.caps) {
    if (cap.stress * mega > chart.y_axis().high) continue;
    constexpr double caption = 60.0;  // what the first peak's takes, above and below it
    const double y = chart.py(cap.stress * mega);
    const bool taken = marks.peak_stress && std::abs(y - chart.py(*marks.peak_stress * mega)) < caption;
    const double end = chart.px(std::min(cap.until * percent, chart.x_axis().high));
    canvas.text(
        taken ? end - 8.0 : chart.box().x + 8.0, y - 7.0, cap.text,
        {.size = 15.0, .colour = palette::vermilion, .align = taken ? Align::right : Align::left, .halo = true});
  }
}

/// Captions of the magnified panel, in the gap above it.
void annotate_magnified(Canvas& canvas, const Chart& chart, const CurveMarks& marks) {
  const double y = chart.box().y - 12.0;
  canvas.text(chart.box().x, y, "the plateau, magnified", {.size = 16.0, .colour = palette::soft_ink});
  if (!marks.target_stress) return;
  const TextStyle style{.size = 16.0, .colour = target_text, .bold = true, .align = Align::right};
  const std::string text = "target " + stress_text(*marks.target_stress);
  canvas.text(chart.box().right(), y, text, style);
  const double left = chart.box().right() - canvas.text_width(text, style) - 10.0;
  canvas.line(left - 44.0, y - 5.5, left, y - 5.5, palette::green, 2.0, {9.0, 6.0});
}

void annotate_cut(Canvas& canvas, const Chart& chart, const Extent& extent) {
  if (extent.highest <= chart.y_axis().high) return;
  // Left of the badge of the last snapshot.
  canvas.text(chart.box().right() - 24.0, chart.box().y - 12.0, "rises to " + stress_text(extent.highest / mega),
              {.size = 15.0, .colour = palette::soft_ink, .align = Align::right});
}

}  // namespace

Chart draw_curve_panel(Canvas& canvas, const Box& box, const std::vector<Series>& series, const CurveMarks& marks,
                       double upper_fraction) {
  const Extent extent = measure(series, marks);
  const double top = extent.early > 0.0 ? std::min(extent.highest, cut_factor * extent.early) : extent.highest;
  const double level = std::max({marks.plateau_stress.value_or(0.0) * mega, marks.target_stress.value_or(0.0) * mega});
  const bool magnified = marks.plateau_stress && level > 0.0 && level < magnify_below * extent.early;
  constexpr double gap = 44.0;
  const double upper_height = magnified ? upper_fraction * (box.height - gap) : box.height;
  const Axis strain{0.0, extent.strain > 0.0 ? extent.strain : 1.0, "engineering strain (%)"};

  Chart upper(canvas, {box.x, box.y, box.width, upper_height}, strain,
              stress_axis(std::max(top, level), extent.lowest));
  draw_grounds(upper, marks);
  upper.draw_axes(!magnified);
  draw_lines(upper, series, marks);
  annotate_window(canvas, upper, marks);
  annotate_densification(canvas, upper, marks);
  annotate_peak(canvas, upper, marks);
  annotate_cut(canvas, upper, extent);
  annotate_caps(canvas, upper, marks);
  if (!magnified) {
    annotate_target(canvas, upper, marks);
    return upper;
  }

  Axis small = stress_axis(std::max(extent.in_window, 1.2 * level), extent.lowest);
  small.high = std::min(small.high, 6.0 * level);
  small.low = std::max(small.low, -0.2 * small.high);
  small.label = "stress (MPa)";
  Chart lower(canvas, {box.x, box.y + upper_height + gap, box.width, box.height - upper_height - gap}, strain, small);
  draw_grounds(lower, marks);
  lower.draw_axes();
  draw_lines(lower, series, marks);
  draw_densification(canvas, lower, marks, lower.box().y);
  annotate_magnified(canvas, lower, marks);
  return upper;
}

}  // namespace perfora::report
