// What is here: axes and lines of a chart. What is not: the page itself (canvas.h).
#include "report/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace perfora::report {
namespace {

constexpr double tick_text_size = 16.0;
constexpr double label_size = 18.0;

double fraction(const Axis& axis, double value) {
  if (axis.logarithmic)
    return (std::log10(std::max(value, axis.low * 1e-6)) - std::log10(axis.low)) /
           (std::log10(axis.high) - std::log10(axis.low));
  return (value - axis.low) / (axis.high - axis.low);
}

std::vector<double> ticks_of(const Axis& axis, int wanted) {
  if (!axis.choices.empty()) {
    std::vector<double> ticks;
    for (std::size_t k = 0; k < axis.choices.size(); ++k) ticks.push_back(static_cast<double>(k));
    return ticks;
  }
  std::vector<double> ticks =
      axis.logarithmic ? decade_ticks(axis.low, axis.high) : nice_ticks(axis.low, axis.high, wanted);
  if (axis.counts) std::erase_if(ticks, [](double tick) { return std::abs(tick - std::round(tick)) > 1e-6; });
  return ticks;
}

std::vector<std::string> texts_of(const Axis& axis, const std::vector<double>& ticks) {
  if (!axis.choices.empty()) return axis.choices;
  if (!axis.logarithmic) return tick_texts(ticks);
  std::vector<std::string> texts;
  for (double tick : ticks) texts.push_back(fmt::format("{:g}", tick));
  return texts;
}

}  // namespace

std::vector<double> nice_ticks(double low, double high, int wanted) {
  std::vector<double> ticks;
  if (!(high > low) || wanted < 1) return ticks;
  const double rough = (high - low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1.0 - 1e-9)) {
      step = factor * power;
      break;
    }
  const double slack = 1e-9 * step;
  for (double n = std::ceil((low - slack) / step); n * step <= high + slack; n += 1.0) ticks.push_back(n * step + 0.0);
  if (ticks.size() < 2 && wanted < 64) return nice_ticks(low, high, 2 * wanted);
  return ticks;
}

std::vector<double> decade_ticks(double low, double high) {
  assert(low > 0.0 && high > low);
  const bool few = std::log10(high / low) < 2.0;
  std::vector<double> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, power) <= high; ++power)
    for (double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * std::pow(10.0, power);
      if ((factor == 1.0 || few) && tick >= low * (1.0 - 1e-9) && tick <= high * (1.0 + 1e-9)) ticks.push_back(tick);
    }
  return ticks;
}

std::vector<std::string> tick_texts(const std::vector<double>& ticks) {
  double step = 1.0;
  if (ticks.size() > 1) step = std::abs(ticks[1] - ticks[0]);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  std::vector<std::string> texts;
  for (double tick : ticks) texts.push_back(fmt::format("{:.{}f}", tick, decimals));
  return texts;
}

Chart::Chart(Canvas& canvas, const Box& box, const Axis& x, const Axis& y) : canvas_(canvas), box_(box), x_(x), y_(y) {
  assert(x.high > x.low && y.high > y.low);
}

double Chart::px(double x) const {
  return box_.x + box_.width * fraction(x_, x);
}
double Chart::py(double y) const {
  return box_.bottom() - box_.height * fraction(y_, y);
}

void Chart::clip() {
  cairo_save(canvas_.context());
  cairo_rectangle(canvas_.context(), box_.x, box_.y, box_.width, box_.height);
  cairo_clip(canvas_.context());
}

void Chart::unclip() {
  cairo_restore(canvas_.context());
}

void Chart::draw_axes(bool x_texts) {
  const TextStyle tick_style{.size = tick_text_size, .colour = palette::soft_ink, .align = Align::right};
  const std::vector<double> y_ticks = ticks_of(y_, static_cast<int>(std::max(2.0, box_.height / 52.0)));
  const std::vector<std::string> y_texts = texts_of(y_, y_ticks);
  double widest = 0.0;
  for (std::size_t k = 0; k < y_ticks.size(); ++k) {
    const double y = py(y_ticks[k]);
    canvas_.line(box_.x, y, box_.right(), y, palette::grid);
    canvas_.text(box_.x - 9.0, y + 0.35 * tick_text_size, y_texts[k], tick_style);
    widest = std::max(widest, canvas_.text_width(y_texts[k], tick_style));
  }
  const std::vector<double> x_ticks = ticks_of(x_, static_cast<int>(std::max(2.0, box_.width / 90.0)));
  const std::vector<std::string> texts = texts_of(x_, x_ticks);
  const TextStyle below{.size = tick_text_size, .colour = palette::soft_ink, .align = Align::centre};
  double longest = 0.0;  // of choices, which stand upright where they would run into each other
  for (const std::string& text : x_.choices) longest = std::max(longest, canvas_.text_width(text, below));
  const bool upright = longest + 8.0 > box_.width / std::max<double>(1.0, static_cast<double>(x_.choices.size()));
  for (std::size_t k = 0; k < x_ticks.size(); ++k) {
    const double x = px(x_ticks[k]);
    canvas_.line(x, box_.y, x, box_.bottom(), palette::grid);
    canvas_.line(x, box_.bottom(), x, box_.bottom() + 5.0, palette::soft_ink);
    if (!x_texts) continue;
    if (upright)
      canvas_.text_upright(x, box_.bottom() + 12.0 + 0.5 * canvas_.text_width(texts[k], below), texts[k], below);
    else
      canvas_.text(x, box_.bottom() + 24.0, texts[k], below);
  }
  canvas_.line(box_.x, box_.bottom(), box_.right(), box_.bottom(), palette::soft_ink, 1.4);
  canvas_.line(box_.x, box_.y, box_.x, box_.bottom(), palette::soft_ink, 1.4);
  if (x_texts)
    canvas_.text(box_.x + box_.width / 2.0, box_.bottom() + (upright ? longest + 36.0 : 52.0), x_.label,
                 {.size = label_size, .align = Align::centre});
  canvas_.text_upright(box_.x - widest - 30.0, box_.y + box_.height / 2.0, y_.label, {.size = label_size});
}

void Chart::x_band(double low, double high, const Colour& colour, double opacity) {
  const double left = std::max(px(low), box_.x);
  const double right = std::min(px(high), box_.right());
  if (right > left) canvas_.fill({left, box_.y, right - left, box_.height}, colour, opacity);
}

void Chart::y_band(double low, double high, const Colour& colour, double opacity) {
  const double top = std::max(py(high), box_.y);
  const double bottom = std::min(py(low), box_.bottom());
  if (bottom > top) canvas_.fill({box_.x, top, box_.width, bottom - top}, colour, opacity);
}

void Chart::horizontal(double y, double x0, double x1, const Colour& colour, double thickness,
                       const std::vector<double>& dashes) {
  clip();
  canvas_.line(px(x0), py(y), px(x1), py(y), colour, thickness, dashes);
  unclip();
}

void Chart::vertical(double x, const Colour& colour, double thickness, const std::vector<double>& dashes) {
  clip();
  canvas_.line(px(x), box_.y, px(x), box_.bottom(), colour, thickness, dashes);
  unclip();
}

void Chart::polyline(std::span<const double> x, std::span<const double> y, const Colour& colour, double thickness,
                     double opacity) {
  assert(x.size() == y.size());
  clip();
  cairo_t* context = canvas_.context();
  cairo_new_path(context);
  for (std::size_t k = 0; k < x.size(); ++k) cairo_line_to(context, px(x[k]), py(y[k]));
  set_colour(context, colour, opacity);
  cairo_set_line_width(context, thickness);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_stroke(context);
  unclip();
}

}  // namespace perfora::report
