// What is here: drawing of a search. What is not: its data (plot_study.h).
#include "report/search_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text.h"
#include "report/chart.h"

namespace perfora::report {
namespace {

/// From this ratio of largest to smallest score on the axis is logarithmic.
constexpr double logarithmic_ratio = 20.0;
constexpr std::size_t arms_in_key = 8;

bool counts(const results::StudyPoint& evaluation) {
  return evaluation.feasible && std::isfinite(evaluation.score);
}

std::vector<std::string> arms_of(const results::StudyRecord& picture) {
  std::vector<std::string> arms;
  for (const results::StudyPoint& evaluation : picture.points)
    if (std::find(arms.begin(), arms.end(), evaluation.arm) == arms.end()) arms.push_back(evaluation.arm);
  return arms;
}

Axis score_axis(const results::StudyRecord& picture) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const results::StudyPoint& evaluation : picture.points)
    if (counts(evaluation)) {
      if (evaluation.score > 0.0) least = std::min(least, evaluation.score);
      most = std::max(most, evaluation.score);
    }
  Axis axis;
  axis.label = picture.score_label;
  if (most <= 0.0) return axis;
  axis.logarithmic = most > logarithmic_ratio * least;
  axis.high = axis.logarithmic ? most * 2.2 : 1.12 * most;
  axis.low = axis.logarithmic ? least / 1.8 : 0.0;
  return axis;
}

void cross(Canvas& canvas, double x, double y, const Colour& colour) {
  canvas.line(x - 4.0, y - 4.0, x + 4.0, y + 4.0, colour, 1.6);
  canvas.line(x - 4.0, y + 4.0, x + 4.0, y - 4.0, colour, 1.6);
}

void draw_incumbent(Chart& chart, const results::StudyRecord& picture, double end) {
  const std::vector<double> incumbent = incumbent_scores(picture.points);
  std::vector<double> x, y;
  for (std::size_t k = 0; k < incumbent.size(); ++k) {
    if (!std::isfinite(incumbent[k])) continue;
    const double level = std::max(incumbent[k], chart.y_axis().low);
    if (!y.empty()) {
      x.push_back(picture.points[k].number);
      y.push_back(y.back());
    }
    x.push_back(picture.points[k].number);
    y.push_back(level);
  }
  if (!y.empty()) {
    x.push_back(end);
    y.push_back(y.back());
  }
  chart.polyline(x, y, palette::ink, 2.0);
}

/// Entries of the key flow into two rows above the panel.
class KeyRows {
 public:
  KeyRows(Canvas& canvas, const Box& box) : canvas_(canvas), box_(box), x_(box.x), y_(box.y - 42.0) {}

  /// Room for a mark `mark` wide and a text; draw(x, y) draws the mark with its middle at y. False: no room is left.
  template <class Draw>
  bool add(double mark, const std::string& text, const Draw& draw, double keep = 0.0) {
    const double width = mark + 8.0 + canvas_.text_width(text, style_) + 20.0;
    const bool last_row = y_ > box_.y - 30.0;
    if (x_ + width > box_.right() - (last_row ? keep : 0.0)) {
      if (last_row) return false;
      x_ = box_.x;
      y_ = box_.y - 16.0;
    }
    draw(x_, y_ - 5.0);
    canvas_.text(x_ + (mark > 0.0 ? mark + 8.0 : 0.0), y_, text, style_);
    x_ += width;
    return true;
  }

 private:
  Canvas& canvas_;
  Box box_;
  double x_, y_;
  TextStyle style_{.size = 15.0, .colour = palette::soft_ink};
};

void draw_key(Canvas& canvas, const results::StudyRecord& picture, const std::vector<std::string>& arms,
              const Box& box) {
  const auto has = [&](const auto& test) { return std::any_of(picture.points.begin(), picture.points.end(), test); };
  KeyRows rows(canvas, box);
  rows.add(22.0, "best so far", [&](double x, double y) { canvas.line(x, y, x + 22.0, y, palette::ink, 2.0); });
  if (has([](const results::StudyPoint& evaluation) { return !evaluation.feasible; }))
    rows.add(10.0, "outside constraints", [&](double x, double y) { cross(canvas, x + 5.0, y, palette::soft_ink); });
  if (has([](const results::StudyPoint& evaluation) {
        return evaluation.feasible && !std::isfinite(evaluation.score);
      }))
    rows.add(10.0, "failed", [&](double x, double y) { cross(canvas, x + 5.0, y, palette::vermilion); });
  if (arms.size() == 1 && arms[0].empty()) return;
  for (std::size_t a = 0; a < arms.size(); ++a) {
    const Colour& colour = palette::series()[a % palette::series().size()];
    constexpr double room_for_rest = 90.0;
    const bool fits =
        a < arms_in_key &&
        rows.add(
            11.0, arms[a], [&](double x, double y) { canvas.disc(x + 5.5, y, 5.5, colour, palette::paper, 0.8); },
            room_for_rest);
    if (fits) continue;
    rows.add(0.0, fmt::format("and {} more", arms.size() - a), [](double, double) {});
    break;
  }
}

void draw_best(Canvas& canvas, const Chart& chart, const results::StudyRecord& picture) {
  for (const results::StudyPoint& evaluation : picture.points) {
    if (evaluation.number != picture.best_number || !counts(evaluation)) continue;
    const double x = chart.px(evaluation.number);
    const double y = chart.py(std::max(evaluation.score, chart.y_axis().low));
    cairo_t* context = canvas.context();
    cairo_new_path(context);
    cairo_arc(context, x, y, 10.0, 0.0, 6.2832);
    set_colour(context, palette::vermilion);
    cairo_set_line_width(context, 2.6);
    cairo_stroke(context);
    const std::string text = fmt::format("best: candidate {}, {}", evaluation.number, io::number(evaluation.score));
    const TextStyle plain{.size = 16.0, .bold = true};
    const bool right = x + 18.0 + canvas.text_width(text, plain) < chart.box().right();
    canvas.text(right ? x + 16.0 : x - 16.0, std::min(y + 22.0, chart.box().bottom() - 8.0), text,
                {.size = 16.0,
                 .colour = palette::vermilion,
                 .bold = true,
                 .align = right ? Align::left : Align::right,
                 .halo = true});
  }
}

}  // namespace

std::vector<double> incumbent_scores(const std::vector<results::StudyPoint>& evaluations) {
  std::vector<double> incumbent;
  double least = std::numeric_limits<double>::quiet_NaN();
  for (const results::StudyPoint& evaluation : evaluations) {
    if (counts(evaluation) && !(evaluation.score >= least)) least = evaluation.score;
    incumbent.push_back(least);
  }
  return incumbent;
}

void draw_search(Canvas& canvas, const results::StudyRecord& picture, const Box& box) {
  int last = 1;
  for (const results::StudyPoint& evaluation : picture.points) last = std::max(last, evaluation.number);
  const std::vector<std::string> arms = arms_of(picture);
  Axis candidates{0.0, last + std::max(1.0, 0.03 * last), "candidate"};
  candidates.counts = true;
  Chart chart(canvas, box, candidates, score_axis(picture));
  chart.draw_axes();
  draw_incumbent(chart, picture, last);
  const double radius = last > 400 ? 2.6 : (last > 120 ? 3.6 : 5.0);
  for (const results::StudyPoint& evaluation : picture.points) {
    const auto arm = static_cast<std::size_t>(std::find(arms.begin(), arms.end(), evaluation.arm) - arms.begin());
    const Colour& colour = palette::series()[arm % palette::series().size()];
    if (counts(evaluation))
      canvas.disc(chart.px(evaluation.number), chart.py(std::max(evaluation.score, chart.y_axis().low)), radius, colour,
                  palette::paper, 0.8);
    else
      cross(canvas, chart.px(evaluation.number), box.y + 9.0,
            evaluation.feasible ? palette::vermilion : palette::soft_ink);
  }
  draw_best(canvas, chart, picture);
  draw_key(canvas, picture, arms, box);
}

}  // namespace perfora::report
