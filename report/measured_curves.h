// What is here: measured curves (of an experiment, a target) drawn thin beside those of runs, and their key. What is
// not: reading them (results/curve_file.h).
#pragma once

#include <vector>

#include "report/canvas.h"
#include "report/chart.h"
#include "results/curve.h"

namespace perfora::report {

/// What one SI unit is in a chart: 100 for strains in %, 1e-6 for stresses in MPa.
struct CurveScale {
  double strain = 100.0, stress = 1e-6;
};

/// Draws them in the chart; stresses below `least` (in units of the chart) stand there.
void draw_measured(Chart& chart, const std::vector<results::Curve>& curves, const CurveScale& scale, double least);
/// Their names, each with a piece of its line, from (x, y) to the right, as far as `right` allows. Returns where the
/// next text of that line may stand.
double draw_measured_key(Canvas& canvas, double x, double y, double right, const std::vector<results::Curve>& curves);
/// The colour of the k-th.
Colour measured_colour(std::size_t k);
inline constexpr double measured_thickness = 1.4;

}  // namespace perfora::report
