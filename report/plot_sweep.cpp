// What is here: drawing of a sweep. What is not: its data (plot_sweep.h), axes (chart.h).
#include "report/plot_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "io/numbers.h"
#include "report/canvas.h"
#include "report/chart.h"
#include "report/measure_unit.h"
#include "report/measured_curves.h"
#include "report/verdict_line.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0;
constexpr double page_margin = 44.0;
constexpr double first_row = 168.0;
constexpr double panel_height = 300.0;
constexpr double row_gap = 110.0;        ///< below a panel: ticks, label, names of the next row's series
constexpr double character_width = 8.4;  ///< of tick texts, about
constexpr double curves_left = 124.0, curves_width = 470.0;
constexpr double measures_left = 706.0, measure_gap = 108.0;
/// Longer names would take more of the page than the panels: numbers stand for them, and a list below says which.
constexpr std::size_t longest_upright = 24;  ///< characters
constexpr double list_line = 24.0;
/// A logarithmic stress axis spans at most this ratio: below it there is dust.
constexpr double stress_decades = 1000.0;
constexpr double logarithmic_ratio = 20.0;

/// From blue over green to red: the order of the values.
Colour ramp(std::size_t place, std::size_t count) {
  static const std::vector<Colour> stops = {hex(0x2d4a9a), hex(0x1b9aaa), hex(0x5aa02c), hex(0xe69f00), hex(0xc8401c)};
  if (count < 2) return stops.front();
  const double at = static_cast<double>(place) / static_cast<double>(count - 1) * static_cast<double>(stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  return mix(stops[k], stops[k + 1], at - static_cast<double>(k));
}

Colour colour_of(const SweepGroup& group, const SweepPoint& point, bool curve) {
  const auto place = static_cast<std::size_t>(point.place);
  if (group.series.size() < 2) return ramp(place, group.places.size());
  const Colour own = palette::series()[static_cast<std::size_t>(point.series) % palette::series().size()];
  const double faint = static_cast<double>(place) / std::max<double>(1.0, static_cast<double>(group.places.size() - 1));
  return curve ? mix(own, palette::paper, 0.55 * (1.0 - faint)) : own;
}

/// Whether every place is a number (with a unit or not): only then a line from one to the next says something.
bool places_are_numbers(const SweepGroup& group) {
  return std::all_of(group.places.begin(), group.places.end(), [](const std::string& text) {
    std::string_view unit = text;
    return io::take_number(unit) && (unit.empty() || unit.front() == ' ') &&
           std::count(text.begin(), text.end(), ' ') <= 1;
  });
}

double measure_width(const SweepPicture& picture) {
  const double count = static_cast<double>(picture.measures.size());
  return (page_width - page_margin - measures_left - (count - 1.0) * measure_gap) / count;
}

/// One case with nothing beside it: the names of the curves say which, and each of its blocks has a thin curve.
bool is_alone(const SweepPicture& picture, const SweepGroup& group) {
  return group.points.size() == 1 && picture.base.empty();
}

/// How the values stand below the panels of measures.
enum class Naming {
  lying,
  upright,
  numbered,  ///< 1, 2, ... and a list below
};
std::size_t longest_place(const SweepGroup& group) {
  std::size_t longest = 0;
  for (const std::string& text : group.places) longest = std::max(longest, text.size());
  return longest;
}
Naming naming_of(const SweepPicture& picture, const SweepGroup& group) {
  if (is_alone(picture, group)) return Naming::lying;
  const std::size_t longest = longest_place(group);
  const double room = measure_width(picture) / static_cast<double>(group.places.size());
  if (character_width * static_cast<double>(longest) + 8.0 <= room) return Naming::lying;
  return longest > longest_upright ? Naming::numbered : Naming::upright;
}

Axis measure_axis(const SweepPicture& picture, const SweepGroup& group, std::size_t measure) {
  const MeasureUnit unit = measure_unit(picture.measures[measure]);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto* points : {&group.points, &picture.base})
    for (const SweepPoint& point : *points)
      for (const double value : point.values[measure].replicates) {
        if (!std::isfinite(value)) continue;
        low = std::min(low, unit.scale * value);
        high = std::max(high, unit.scale * value);
      }
  // Intervals are shown whole, unless so few replicates make them so wide that nothing else is seen.
  constexpr double widest = 2.5;
  double reach = high;
  for (const auto* points : {&group.points, &picture.base})
    for (const SweepPoint& point : *points)
      if (const SweepValue& value = point.values[measure]; std::isfinite(value.mean) && value.half_interval > 0.0)
        reach = std::max(reach, unit.scale * (value.mean + value.half_interval));
  if (high > 0.0) high = std::min(reach, widest * high);
  Axis axis;
  axis.label = unit.label;
  if (!(high >= low)) return axis;
  axis.logarithmic = low > 0.0 && high > logarithmic_ratio * low;
  if (axis.logarithmic) {
    axis.low = low / 1.5;
    axis.high = high * 1.5;
  } else {
    axis.low = std::min(0.0, 1.1 * low);
    axis.high = high > 0.0 ? 1.15 * high : 1.0;
  }
  return axis;
}

void draw_point(Canvas& canvas, const Chart& chart, double place, const SweepValue& value, double scale,
                const Colour& colour) {
  if (!std::isfinite(value.mean)) return;
  const double x = chart.px(place);
  const auto y = [&](double level) {
    return std::clamp(chart.py(std::max(scale * level, chart.y_axis().low)), chart.box().y, chart.box().bottom());
  };
  for (const double one : value.replicates)
    if (std::isfinite(one)) canvas.disc(x - 7.0, y(one), 2.6, mix(colour, palette::paper, 0.35), colour, 0.6);
  if (value.half_interval > 0.0) {
    const double upper = y(value.mean + value.half_interval);
    canvas.line(x, y(value.mean - value.half_interval), x, upper, colour, 2.2);
    if (scale * (value.mean + value.half_interval) > chart.y_axis().high)  // it goes on beyond the axis
      for (const double aside : {-5.0, 5.0}) canvas.line(x + aside, upper + 8.0, x, upper, colour, 2.2);
  }
  canvas.disc(x, y(value.mean), 5.6, colour, palette::paper, 1.0);
}

void draw_measure(Canvas& canvas, const SweepPicture& picture, const SweepGroup& group, std::size_t measure,
                  const Box& box) {
  const double scale = measure_unit(picture.measures[measure]).scale;
  Axis x{-0.6, static_cast<double>(group.places.size()) - 0.4, group.label};
  x.choices = group.places;
  if (is_alone(picture, group)) x.choices = {""};
  if (naming_of(picture, group) == Naming::numbered)
    for (std::size_t p = 0; p < x.choices.size(); ++p) x.choices[p] = std::to_string(p + 1);
  Chart chart(canvas, box, x, measure_axis(picture, group, measure));
  for (const results::Wish& wish : picture.wishes)
    if (wish.measure->key == picture.measures[measure]) {
      const double low = std::max(scale * wish.low, chart.y_axis().low);
      const double high = std::min(scale * wish.high, chart.y_axis().high);
      if (low < high) chart.y_band(low, high, palette::green, 0.16);
    }
  for (const SweepPoint& base : picture.base) {
    const double mean = scale * base.values[measure].mean, half = scale * base.values[measure].half_interval;
    if (!std::isfinite(mean)) continue;
    if (half > 0.0)
      chart.y_band(std::max(mean - half, chart.y_axis().low), std::min(mean + half, chart.y_axis().high), palette::grid,
                   0.8);
    chart.horizontal(mean, x.low, x.high, palette::soft_ink, 1.6, {6.0, 5.0});
  }
  chart.draw_axes();
  const double shift = 0.5 / static_cast<double>(group.series.size());
  for (std::size_t s = 0; s < group.series.size(); ++s) {
    std::vector<double> places, means;
    const double aside = shift * (static_cast<double>(s) - 0.5 * static_cast<double>(group.series.size() - 1));
    for (const SweepPoint& point : group.points) {
      if (point.series != static_cast<int>(s)) continue;
      const double mean = scale * point.values[measure].mean;
      if (!std::isfinite(mean)) continue;
      places.push_back(point.place + aside);
      means.push_back(std::max(mean, chart.y_axis().low));
    }
    const Colour line = group.series.size() > 1 ? palette::series()[s % palette::series().size()] : palette::soft_ink;
    if (places_are_numbers(group)) chart.polyline(places, means, line, 1.4, 0.6);
  }
  for (const SweepPoint& point : group.points) {
    const double aside = shift * (point.series - 0.5 * static_cast<double>(group.series.size() - 1));
    draw_point(canvas, chart, point.place + aside, point.values[measure], scale, colour_of(group, point, false));
  }
}

void draw_curve(Chart& chart, results::Curve curve, const Colour& colour, double thickness) {
  for (double& value : curve.strain) value *= 100.0;
  for (double& value : curve.stress) value = std::max(1e-3 * value, 0.5 * chart.y_axis().low);
  chart.polyline(curve.strain, curve.stress, colour, thickness);
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void draw_curves(Canvas& canvas, const SweepPicture& picture, const SweepGroup& group, const Box& box) {
  double highest = 0.0, lowest = std::numeric_limits<double>::infinity(), lowest_median = lowest, end = 0.0;
  for (const auto* points : {&group.points, &picture.base})
    for (const SweepPoint& point : *points) {
      const results::Curve mean = smoothed_mean(point.curves);
      for (std::size_t k = 0; k < mean.strain.size(); ++k) {
        end = std::max(end, 100.0 * mean.strain[k]);
        highest = std::max(highest, 1e-3 * mean.stress[k]);
        if (mean.stress[k] > 0.0) lowest = std::min(lowest, 1e-3 * mean.stress[k]);
      }
      if (!mean.stress.empty()) lowest_median = std::min(lowest_median, 1e-3 * median_of(mean.stress));
    }
  if (is_alone(picture, group))
    for (const results::Curve& curve : group.points.front().curves) {
      for (const double strain : curve.strain) end = std::max(end, 100.0 * strain);
      for (const double stress : curve.stress) highest = std::max(highest, 1e-3 * stress);
    }
  for (const results::Curve& curve : picture.measured)
    for (std::size_t k = 0; k < curve.strain.size(); ++k) {
      end = std::max(end, 100.0 * curve.strain[k]);
      highest = std::max(highest, 1e-3 * curve.stress[k]);
      if (curve.stress[k] > 0.0) lowest = std::min(lowest, 1e-3 * curve.stress[k]);
    }
  if (!(highest > 0.0)) {
    canvas.text(box.x + 0.5 * box.width, box.y + 0.5 * box.height, "no curve yet",
                {.size = 17.0, .colour = palette::soft_ink, .align = Align::centre});
    return;
  }
  // How flat a curve is shows on a linear axis; where cases differ too much for one, each shows on a logarithmic one.
  const bool logarithmic = highest > logarithmic_ratio * lowest_median;
  const Axis stress = logarithmic
                          ? Axis{std::max(0.8 * lowest, highest / stress_decades), 1.5 * highest, "stress (kPa)", true}
                          : Axis{0.0, 1.05 * highest, "stress (kPa)"};
  Chart chart(canvas, box, {0.0, std::ceil(end), "engineering strain (%)"}, stress);
  chart.draw_axes();
  for (const SweepPoint& base : picture.base) draw_curve(chart, smoothed_mean(base.curves), palette::soft_ink, 1.4);
  for (const SweepPoint& point : group.points) {
    const Colour colour = colour_of(group, point, true);
    if (is_alone(picture, group) && point.curves.size() > 1)
      for (const results::Curve& curve : point.curves) draw_curve(chart, curve, mix(colour, palette::paper, 0.55), 0.9);
    draw_curve(chart, smoothed_mean(point.curves), colour, 2.2);
  }
  draw_measured(chart, picture.measured, {100.0, 1e-3}, 0.5 * stress.low);
}

/// Whether the colours stand for the places.
bool colours_are_places(const SweepGroup& group) {
  return group.series.size() < 2;
}

/// Names of the series above the measures; of places where the colours stand for them, above the curves.
void draw_names(Canvas& canvas, const SweepPicture& picture, const SweepGroup& group, double y) {
  const TextStyle style{.size = 15.0, .colour = palette::soft_ink};
  double x = curves_left;
  const auto add = [&](const std::string& text, const Colour& colour) {
    const double width = 26.0 + canvas.text_width(text, style) + 18.0;
    if (x + width > page_width - page_margin) return;
    canvas.line(x, y - 5.0, x + 20.0, y - 5.0, colour, 3.0);
    canvas.text(x + 26.0, y, text, style);
    x += width;
  };
  if (!colours_are_places(group))
    for (std::size_t s = 0; s < group.series.size(); ++s)
      add(group.series[s], palette::series()[s % palette::series().size()]);
  else if (is_alone(picture, group))
    add(group.places.front() + (group.points.front().curves.size() > 1 ? " (mean; thin: each block)" : ""), ramp(0, 1));
  else if (naming_of(picture, group) != Naming::numbered)
    for (std::size_t p = 0; p < group.places.size(); ++p) add(group.places[p], ramp(p, group.places.size()));
  if (!picture.base.empty()) add("the design itself", palette::soft_ink);
  if (!picture.wishes.empty()) add("wished", mix(palette::green, palette::paper, 0.6));
  draw_measured_key(canvas, x, y, page_width - page_margin, picture.measured);
}

/// The list that says what the numbers below the measures stand for.
void draw_list(Canvas& canvas, const SweepGroup& group, double y) {
  const TextStyle style{.size = 15.0};
  for (std::size_t p = 0; p < group.places.size(); ++p, y += list_line) {
    if (colours_are_places(group))
      canvas.line(curves_left, y - 5.0, curves_left + 20.0, y - 5.0, ramp(p, group.places.size()), 3.0);
    const std::string text = std::to_string(p + 1) + "   " + group.places[p];
    canvas.text(curves_left + 30.0, y, canvas.fit(text, page_width - page_margin - curves_left - 30.0, style), style);
  }
}

/// Room below the panels of a group: more where its texts stand upright or in a list.
double room_below(const SweepPicture& picture, const SweepGroup& group) {
  switch (naming_of(picture, group)) {
    case Naming::lying:
      break;
    case Naming::upright:
      return row_gap + character_width * static_cast<double>(longest_place(group));
    case Naming::numbered:
      return row_gap + list_line * static_cast<double>(group.places.size());
  }
  return row_gap;
}

}  // namespace

void plot_sweep(const SweepPicture& picture, const std::filesystem::path& out) {
  double height = first_row;
  for (const SweepGroup& group : picture.groups) height += panel_height + room_below(picture, group);
  Canvas canvas(out, page_width, height);
  const TextStyle title{.size = 30.0, .bold = true};
  const TextStyle line{.size = 17.0, .colour = palette::soft_ink};
  canvas.text(page_margin, 56.0, canvas.fit(picture.title, page_width - 2.0 * page_margin, title), title);
  canvas.text(page_margin, 88.0, canvas.fit(picture.subtitle, page_width - 2.0 * page_margin, line), line);
  draw_verdict(canvas, page_margin, 114.0, page_width - 2.0 * page_margin, picture.outcome, picture.verdict);
  const double width = measure_width(picture);
  double y = first_row;
  for (const SweepGroup& group : picture.groups) {
    draw_names(canvas, picture, group, y - 14.0);
    draw_curves(canvas, picture, group, {curves_left, y, curves_width, panel_height});
    for (std::size_t m = 0; m < picture.measures.size(); ++m)
      draw_measure(canvas, picture, group, m,
                   {measures_left + static_cast<double>(m) * (width + measure_gap), y, width, panel_height});
    if (naming_of(picture, group) == Naming::numbered) draw_list(canvas, group, y + panel_height + row_gap - 32.0);
    y += panel_height + room_below(picture, group);
  }
  canvas.write();
}

}  // namespace perfora::report
