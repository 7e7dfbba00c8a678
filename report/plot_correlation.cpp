// What is here: drawing of compared sweeps. What is not: its data (plot_correlation.h), axes (chart.h).
#include "report/plot_correlation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/canvas.h"
#include "report/chart.h"
#include "report/label_places.h"
#include "report/measure_unit.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0, page_margin = 44.0;
constexpr double first_row = 160.0, row_gap = 136.0;
constexpr double panels_left = 124.0, panel_gap = 120.0, tallest_panel = 440.0;
constexpr double legend_line = 24.0;
constexpr double legend_column = 370.0;
constexpr double point_radius = 5.0;
constexpr double digit_height = 11.0;  // of the 14 units of their size
/// Numbers further from their point than this (centres) are joined to it by a line.
constexpr double far_label = 22.0;
/// Results that span more than this ratio stand on logarithmic axes.
constexpr double logarithmic_ratio = 8.0;

/// One range for both axes, so that the line of agreement is the diagonal.
Axis common_axis(const CorrelationPanel& panel) {
  const double scale = measure_unit(panel.measure).scale;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const CorrelationPoint& point : panel.points)
    for (const double value : {point.x, point.y})
      if (std::isfinite(value)) {
        low = std::min(low, scale * value);
        high = std::max(high, scale * value);
      }
  Axis axis;
  if (!(high >= low)) return axis;
  axis.logarithmic = low > 0.0 && high > logarithmic_ratio * low;
  if (axis.logarithmic) {
    axis.low = low / 1.4;
    axis.high = high * 1.4;
  } else {
    const double room = high > low ? 0.12 * (high - low) : 0.1 * std::abs(high) + 1e-12;
    axis.low = low >= 0.0 ? std::max(0.0, low - room) : low - room;
    axis.high = high + room;
  }
  return axis;
}

void draw_panel(Canvas& canvas, const CorrelationPicture& picture, const CorrelationPicture::Row& row,
                const CorrelationPanel& panel, const std::vector<std::string>& labels, const Box& box) {
  const MeasureUnit unit = measure_unit(panel.measure);
  Axis x = common_axis(panel), y = x;
  x.label = row.sweep;
  y.label = picture.reference;
  Chart chart(canvas, box, x, y);
  chart.draw_axes();
  canvas.line(chart.px(x.low), chart.py(x.low), chart.px(x.high), chart.py(x.high), palette::soft_ink, 1.4, {6.0, 5.0});
  const auto clamped_x = [&](double value) { return chart.px(std::clamp(unit.scale * value, x.low, x.high)); };
  const auto clamped_y = [&](double value) { return chart.py(std::clamp(unit.scale * value, y.low, y.high)); };
  for (const CorrelationPoint& point : panel.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
    const double at_x = clamped_x(point.x), at_y = clamped_y(point.y);
    const Colour bar = mix(palette::blue, palette::paper, 0.6);
    if (point.x_half > 0.0)
      canvas.line(clamped_x(point.x - point.x_half), at_y, clamped_x(point.x + point.x_half), at_y, bar, 1.6);
    if (point.y_half > 0.0)
      canvas.line(at_x, clamped_y(point.y - point.y_half), at_x, clamped_y(point.y + point.y_half), bar, 1.6);
  }
  LabelPlaces places(box);
  for (const CorrelationPoint& point : panel.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
    canvas.disc(clamped_x(point.x), clamped_y(point.y), point_radius, palette::blue, palette::paper, 1.0);
    places.keep_clear(clamped_x(point.x), clamped_y(point.y), point_radius);
  }
  std::vector<std::pair<std::string, Box>> numbers;
  const TextStyle style{.size = 14.0, .colour = palette::soft_ink, .halo = true};
  for (const CorrelationPoint& point : panel.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
    const auto index = std::find(labels.begin(), labels.end(), point.label) - labels.begin();
    const std::string number = std::to_string(index + 1);
    const double x0 = clamped_x(point.x), y0 = clamped_y(point.y);
    const Box place = places.place(x0, y0, point_radius, canvas.text_width(number, style), digit_height);
    const double to_x = place.x + 0.5 * place.width - x0, to_y = place.y + 0.5 * place.height - y0;
    if (const double far = std::hypot(to_x, to_y); far > far_label)
      canvas.line(x0 + to_x * point_radius / far, y0 + to_y * point_radius / far, x0 + to_x, y0 + to_y,
                  palette::soft_ink, 0.8);
    numbers.emplace_back(number, place);
  }
  for (const auto& [number, place] : numbers) canvas.text(place.x, place.bottom(), number, style);
  canvas.text(box.x, box.y - 34.0, canvas.fit(unit.label, box.width, {.bold = true}), {.bold = true});
  const TextStyle caption{.size = 16.0, .colour = palette::soft_ink};
  canvas.text(box.x, box.y - 12.0, canvas.fit(panel.caption, box.width, caption), caption);
}

/// Every case of the page once, in the order of the first panel.
std::vector<std::string> all_labels(const CorrelationPicture& picture) {
  std::vector<std::string> labels;
  for (const auto& row : picture.rows)
    for (const auto& panel : row.panels)
      for (const auto& point : panel.points)
        if (std::find(labels.begin(), labels.end(), point.label) == labels.end()) labels.push_back(point.label);
  return labels;
}

}  // namespace

void plot_correlation(const CorrelationPicture& picture, const std::filesystem::path& out) {
  std::size_t columns = 1;
  for (const auto& row : picture.rows) columns = std::max(columns, row.panels.size());
  const double count = static_cast<double>(columns);
  const double width = (page_width - page_margin - panels_left - (count - 1.0) * panel_gap) / count;
  const double panel_height = std::min(width, tallest_panel);
  const std::vector<std::string> labels = all_labels(picture);
  const auto legend_columns = static_cast<std::size_t>((page_width - 2.0 * page_margin) / legend_column);
  const std::size_t legend_rows = (labels.size() + legend_columns - 1) / legend_columns;
  const double panels_end = first_row + static_cast<double>(picture.rows.size()) * (panel_height + row_gap);
  Canvas canvas(out, page_width, panels_end + legend_line * static_cast<double>(legend_rows) + page_margin);
  const TextStyle title{.size = 30.0, .bold = true};
  const TextStyle line{.size = 17.0, .colour = palette::soft_ink};
  canvas.text(page_margin, 56.0, canvas.fit(picture.title, page_width - 2.0 * page_margin, title), title);
  canvas.text(page_margin, 88.0, canvas.fit(picture.subtitle, page_width - 2.0 * page_margin, line), line);
  double y = first_row;
  for (const auto& row : picture.rows) {
    for (std::size_t k = 0; k < row.panels.size(); ++k)
      draw_panel(canvas, picture, row, row.panels[k], labels,
                 {panels_left + static_cast<double>(k) * (width + panel_gap), y, width, panel_height});
    y += panel_height + row_gap;
  }
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const std::string text = fmt::format("{}  {}", k + 1, labels[k]);
    const TextStyle style{.size = 15.0};
    const std::size_t column = k / std::max<std::size_t>(1, legend_rows),
                      row = k % std::max<std::size_t>(1, legend_rows);
    canvas.text(page_margin + legend_column * static_cast<double>(column),
                panels_end + legend_line * static_cast<double>(row), canvas.fit(text, legend_column - 20.0, style),
                style);
  }
  canvas.write();
}

}  // namespace perfora::report
