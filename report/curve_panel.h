// What is here: the stress-strain panel that pictures of runs and of studies share. What is not: pages.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/canvas.h"
#include "report/chart.h"
#include "results/curve.h"
#include "results/stress_cap.h"

namespace perfora::report {

/// One curve; strain engineering, stress Pa, equally long.
struct Series {
  std::span<const double> strain, stress;
  Colour colour = palette::blue;
  double thickness = 2.2;
  double opacity = 1.0;
};

/// What stands beside the curves; values that were not reached stay empty. Strain engineering, stress Pa.
struct CurveMarks {
  std::optional<double> peak_strain, peak_stress;
  std::optional<double> plateau_start, plateau_end, plateau_stress;
  std::optional<double> densification_strain;
  std::optional<double> target_stress, target_tolerance;
  std::vector<results::StressCap> caps;
  std::vector<results::Curve> measured;  ///< drawn thin; the page has their key (measured_curves.h)
};

/// Strain in % and stress in MPa in `box`, with a second, magnified panel of the plateau below when the plateau is
/// below a quarter of the peak. Returns the upper panel, for further marks.
Chart draw_curve_panel(Canvas& canvas, const Box& box, const std::vector<Series>& series, const CurveMarks& marks,
                       double upper_fraction = 0.6);

}  // namespace perfora::report
