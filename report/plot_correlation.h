// What is here: the picture of sweeps compared case by case. Plain data in, picture out. What is not: the comparison
// (optimize/campaign/sweep_comparison.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace perfora::report {

/// One result of one case in both sweeps, SI; half intervals (95 %) are NaN where they are not known.
struct CorrelationPoint {
  std::string label;
  double x = 0.0, x_half = 0.0;  ///< in the sweep that is compared
  double y = 0.0, y_half = 0.0;  ///< in the reference
};

struct CorrelationPanel {
  std::string measure;
  std::string caption;  ///< the coefficient and its interval
  std::vector<CorrelationPoint> points;
};

struct CorrelationPicture {
  std::string title, subtitle, reference;
  struct Row {
    std::string sweep;
    std::vector<CorrelationPanel> panels;  ///< by measure
  };
  std::vector<Row> rows;
};

/// Draws it, 1600 pixels wide: a row a sweep, a panel a measure, a numbered point a case with its intervals and the
/// line on which both would agree; below, what the numbers stand for. Throws io::InputError for an extension other than
/// .png, .svg, .pdf.
void plot_correlation(const CorrelationPicture& picture, const std::filesystem::path& out);

}  // namespace perfora::report
