// What is here: a curve that is piecewise linear between its samples: values, integrals, fits, moving means. What is
// not: what the numbers mean (measures.h).
#pragma once

#include <vector>

namespace perfora::results {

/// A piece of a curve, x increasing; both equally long, at least two.
struct CurvePiece {
  std::vector<double> x, y;
};

/// Value at `at` by linear interpolation, the nearest end outside. x and y hold at least one value.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at);
/// The curve from `from` to `to`, its ends interpolated.
CurvePiece cut(const std::vector<double>& x, const std::vector<double>& y, double from, double to);
/// Integral over x, exact between the samples.
double integral(const CurvePiece& piece);
/// Integral of |y|, exact between the samples.
double absolute_integral(const CurvePiece& piece);
/// Mean of the samples within half of `width` on either side, at each sample.
std::vector<double> smoothed(const std::vector<double>& x, const std::vector<double>& y, double width);

/// The straight line that is nearest in the integral of squares over the piece: its values at both ends.
struct FittedLine {
  double at_start = 0.0, at_end = 0.0;
};
FittedLine fitted_line(const CurvePiece& piece);

}  // namespace perfora::results
