// What is here: a chart on a page: axes with round ticks, lines, bands. What is not: what is plotted.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/canvas.h"

namespace perfora::report {

/// Ends and ticks of an axis.
struct Axis {
  double low = 0.0, high = 1.0;
  std::string label;
  bool logarithmic = false;  ///< base 10; low must be positive
  /// Instead of round numbers: texts at 0, 1, 2, ... (a choice each).
  std::vector<std::string> choices = {};
  bool counts = false;  ///< of things that are counted: ticks at whole numbers alone
};

/// Round numbers (1, 2 or 5 times a power of ten) from low to high, about `wanted` of them, at least two where low <
/// high.
std::vector<double> nice_ticks(double low, double high, int wanted);
/// Powers of ten, and 2 and 5 times them where the axis spans fewer than two decades.
std::vector<double> decade_ticks(double low, double high);
/// All ticks with as many decimals as the finest step needs.
std::vector<std::string> tick_texts(const std::vector<double>& ticks);

/// Maps data to a box of the page and draws there, clipped to the box.
class Chart {
 public:
  Chart(Canvas& canvas, const Box& box, const Axis& x, const Axis& y);

  double px(double x) const;
  double py(double y) const;
  const Box& box() const { return box_; }
  const Axis& x_axis() const { return x_; }
  const Axis& y_axis() const { return y_; }

  /// Grid, frame, ticks, labels. `x_texts` = false leaves the numbers and the label of the x axis out (a chart stacked
  /// on another).
  void draw_axes(bool x_texts = true);
  /// Shades low..high of x over the whole height.
  void x_band(double low, double high, const Colour& colour, double opacity = 1.0);
  void y_band(double low, double high, const Colour& colour, double opacity = 1.0);
  void horizontal(double y, double x0, double x1, const Colour& colour, double thickness,
                  const std::vector<double>& dashes = {});
  void vertical(double x, const Colour& colour, double thickness, const std::vector<double>& dashes = {});
  /// A line through the points, equally long spans.
  void polyline(std::span<const double> x, std::span<const double> y, const Colour& colour, double thickness,
                double opacity = 1.0);

 private:
  void clip();
  void unclip();
  Canvas& canvas_;
  Box box_;
  Axis x_, y_;
};

}  // namespace perfora::report
