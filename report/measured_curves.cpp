// What is here: colours, lines and key of measured curves. What is not: the pages they stand on.
#include "report/measured_curves.h"

#include <algorithm>

namespace perfora::report {

Colour measured_colour(std::size_t k) {
  // None of them is a colour of runs or of marks in the same panels.
  static const std::vector<Colour> colours = {hex(0x24262b), hex(0xaa4499), hex(0x7a5c00), hex(0x5b6ee1)};
  return colours[k % colours.size()];
}

void draw_measured(Chart& chart, const std::vector<results::Curve>& curves, const CurveScale& scale, double least) {
  for (std::size_t k = 0; k < curves.size(); ++k) {
    std::vector<double> strain = curves[k].strain, stress = curves[k].stress;
    for (double& value : strain) value *= scale.strain;
    for (double& value : stress) value = std::max(value * scale.stress, least);
    chart.polyline(strain, stress, measured_colour(k), measured_thickness);
  }
}

double draw_measured_key(Canvas& canvas, double x, double y, double right, const std::vector<results::Curve>& curves) {
  constexpr double line = 30.0, gap = 8.0, between = 26.0, least_text = 60.0;
  const TextStyle style{.size = 15.0};
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const double text = x + line + gap;
    if (text + least_text > right) break;
    canvas.line(x, y - 5.5, x + line, y - 5.5, measured_colour(k), measured_thickness);
    const std::string name = canvas.fit(curves[k].name, right - text, style);
    canvas.text(text, y, name, style);
    x = text + canvas.text_width(name, style) + between;
  }
  return x;
}

}  // namespace perfora::report
