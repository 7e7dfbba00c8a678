// What is here: sums over the pieces between samples.
#include "results/sampled_curve.h"

#include <algorithm>
#include <cmath>

namespace perfora::results {

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto upper = std::upper_bound(x.begin(), x.end(), at);
  if (upper == x.begin()) return y.front();
  if (upper == x.end()) return y.back();
  const auto k = static_cast<std::size_t>(upper - x.begin());
  const double fraction = (at - x[k - 1]) / (x[k] - x[k - 1]);
  return y[k - 1] + fraction * (y[k] - y[k - 1]);
}

CurvePiece cut(const std::vector<double>& x, const std::vector<double>& y, double from, double to) {
  CurvePiece p;
  p.x.push_back(from);
  p.y.push_back(interpolate(x, y, from));
  for (std::size_t k = 0; k < x.size(); ++k)
    if (x[k] > from && x[k] < to) {
      p.x.push_back(x[k]);
      p.y.push_back(y[k]);
    }
  p.x.push_back(to);
  p.y.push_back(interpolate(x, y, to));
  return p;
}

double integral(const CurvePiece& p) {
  double sum = 0.0;
  for (std::size_t k = 1; k < p.x.size(); ++k) sum += 0.5 * (p.y[k] + p.y[k - 1]) * (p.x[k] - p.x[k - 1]);
  return sum;
}

double absolute_integral(const CurvePiece& p) {
  double sum = 0.0;
  for (std::size_t k = 1; k < p.x.size(); ++k) {
    const double a = p.y[k - 1], b = p.y[k], h = p.x[k] - p.x[k - 1];
    if (a * b >= 0.0) {
      sum += 0.5 * (std::fabs(a) + std::fabs(b)) * h;
    } else {
      sum += 0.5 * h * (a * a + b * b) / (std::fabs(a) + std::fabs(b));
    }
  }
  return sum;
}

std::vector<double> smoothed(const std::vector<double>& x, const std::vector<double>& y, double width) {
  std::vector<double> out(y.size());
  std::size_t low = 0, high = 0;
  double sum = 0.0;
  for (std::size_t k = 0; k < y.size(); ++k) {
    while (high < y.size() && x[high] <= x[k] + 0.5 * width) sum += y[high++];
    while (x[low] < x[k] - 0.5 * width) sum -= y[low++];
    out[k] = sum / static_cast<double>(high - low);
  }
  return out;
}

// y = m + b (x - c) with b from the first moment about the centre c: for linear pieces the integral of (x - c) y is
// exact by Simpson's rule.
FittedLine fitted_line(const CurvePiece& p) {
  const double length = p.x.back() - p.x.front(), centre = 0.5 * (p.x.back() + p.x.front());
  const double mean = integral(p) / length;
  double moment = 0.0;
  for (std::size_t k = 1; k < p.x.size(); ++k) {
    const double a = p.x[k - 1] - centre, b = p.x[k] - centre, middle = 0.25 * (a + b) * (p.y[k - 1] + p.y[k]);
    moment += (b - a) / 6.0 * (a * p.y[k - 1] + 4.0 * middle + b * p.y[k]);
  }
  const double rise = 6.0 * moment / (length * length);  // half of slope x length, slope = 12 moment / length^3
  return {mean - rise, mean + rise};
}

}  // namespace perfora::results
