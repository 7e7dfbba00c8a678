// What is here: curves as corners. What is not: files.
#include "geometry/drawn_outline.h"

#include <numbers>

#include "geometry/make_shape.h"

namespace perfora::geometry {
namespace {

constexpr double same_corner = 1e-9;  // m
constexpr int most_pieces = 5000;     // of one curve

double gap(Point a, Point b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

int pieces(double wanted) {
  return wanted >= 1.0 ? static_cast<int>(std::min(std::ceil(wanted), static_cast<double>(most_pieces))) : 1;
}

}  // namespace

void DrawnOutline::add(Point corner) {
  last_ = corner;
  if (corners_.size() <= most_corners) corners_.push_back(to_metres_(corner));
}

void DrawnOutline::ellipse(Point centre, Point first_axis, Point second_axis, double from, double to) {
  const double radius =
      to_metres_.stretch() * std::max(std::hypot(first_axis.x, first_axis.y), std::hypot(second_axis.x, second_axis.y));
  // Sagitta of a piece of angle a: radius (1 - cos(a/2)).
  const double turn = radius > curve_tolerance ? 2.0 * std::acos(1.0 - curve_tolerance / radius) : std::numbers::pi;
  const int count = pieces(std::abs(to - from) / turn);
  for (int k = 1; k <= count; ++k) {
    const double angle = from + (to - from) * k / count, c = std::cos(angle), s = std::sin(angle);
    add({centre.x + c * first_axis.x + s * second_axis.x, centre.y + c * first_axis.y + s * second_axis.y});
  }
}

void DrawnOutline::bulge_to(Point end, double bulge) {
  const Point start = last_;
  const double dx = end.x - start.x, dy = end.y - start.y;
  if (bulge == 0.0 || (dx == 0.0 && dy == 0.0)) return add(end);
  // The centre lies on the perpendicular through the middle of the chord.
  const double along = (1.0 - bulge * bulge) / (4.0 * bulge);
  const Point centre{0.5 * (start.x + end.x) - along * dy, 0.5 * (start.y + end.y) + along * dx};
  const double radius = std::hypot(start.x - centre.x, start.y - centre.y);
  const double from = std::atan2(start.y - centre.y, start.x - centre.x);
  ellipse(centre, {radius, 0.0}, {0.0, radius}, from, from + 4.0 * std::atan(bulge));
  if (!corners_.empty() && !too_long()) corners_.pop_back();
  add(end);  // exactly
}

void DrawnOutline::cubic_to(Point control, Point second_control, Point end) {
  const Point start = last_;
  // Deviation of n chords: at most sqrt(3)/18 ... bounded by 3/4 of the largest second difference over n^2.
  const double bend =
      to_metres_.stretch() *
      std::max(std::hypot(start.x - 2.0 * control.x + second_control.x, start.y - 2.0 * control.y + second_control.y),
               std::hypot(control.x - 2.0 * second_control.x + end.x, control.y - 2.0 * second_control.y + end.y));
  const int count = pieces(std::sqrt(0.75 * bend / curve_tolerance));
  for (int k = 1; k < count; ++k) {
    const double t = static_cast<double>(k) / count, u = 1.0 - t;
    const double w0 = u * u * u, w1 = 3.0 * u * u * t, w2 = 3.0 * u * t * t, w3 = t * t * t;
    add({w0 * start.x + w1 * control.x + w2 * second_control.x + w3 * end.x,
         w0 * start.y + w1 * control.y + w2 * second_control.y + w3 * end.y});
  }
  add(end);
}

void DrawnOutline::quadratic_to(Point control, Point end) {
  const Point start = last_;
  cubic_to({start.x + 2.0 / 3.0 * (control.x - start.x), start.y + 2.0 / 3.0 * (control.y - start.y)},
           {end.x + 2.0 / 3.0 * (control.x - end.x), end.y + 2.0 / 3.0 * (control.y - end.y)}, end);
}

bool DrawnOutline::returns() const {
  return corners_.size() > 2 && gap(corners_.front(), corners_.back()) < same_corner;
}

std::vector<Point> DrawnOutline::corners() const {
  std::vector<Point> kept;
  for (const Point& corner : corners_)
    if (kept.empty() || gap(kept.back(), corner) >= same_corner) kept.push_back(corner);
  while (kept.size() > 1 && gap(kept.front(), kept.back()) < same_corner) kept.pop_back();
  return kept;
}

RoundOutline round_outline(const std::vector<Point>& corners) {
  constexpr std::size_t fewest = 16;
  if (corners.size() < fewest) return {};
  const Point centre = middle_of(corners);
  double smallest = gap(centre, corners.front()), largest = smallest, longest_chord = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const double radius = gap(centre, corners[k]);
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
    longest_chord = std::max(longest_chord, gap(corners[k], corners[(k + 1) % corners.size()]));
  }
  const double radius = 0.5 * (smallest + largest);
  const double sagitta = longest_chord * longest_chord / (8.0 * radius);
  if (largest - smallest > 2.0 * curve_tolerance || sagitta > 2.0 * curve_tolerance) return {};
  return {2.0 * radius, centre};
}

}  // namespace perfora::geometry
