// What is here: places of holes on lattices. What is not: random placement (layout_random.cpp).
#include "geometry/layout_lattice.h"

#include <numeric>

namespace perfora::geometry {

namespace {

std::int64_t modulo(std::int64_t value, std::int64_t period) {
  const std::int64_t rest = value % period;
  return rest < 0 ? rest + period : rest;
}

/// One coordinate of the lattice points (k + 1/2, m + 1/2): the share (a (k + 1/2) + b (m + 1/2))/holes of the period,
/// in whole numbers (doubled, and divided by what a, b and the number of holes have in common) until the last line.
class TurnedAxis {
 public:
  TurnedAxis(double period, std::int64_t a, std::int64_t b, std::int64_t holes)
      : common_(std::gcd(a, b)),
        a_(a / common_),
        b_(b / common_),
        steps_(holes / common_),
        step_(period / static_cast<double>(steps_)) {}

  double at(std::int64_t k, std::int64_t m) const {
    const std::int64_t half_steps = modulo(a_ * (2 * k + 1) + b_ * (2 * m + 1), 2 * steps_);
    return 0.5 * static_cast<double>(half_steps) * step_;
  }

 private:
  std::int64_t common_, a_, b_, steps_;
  double step_;
};

}  // namespace

std::vector<Perforation> place_in_rows(const LayoutOptions& options, double stagger, double grading) {
  std::vector<Perforation> holes;
  const double pitch_x = options.width / options.columns, pitch_y = options.height / options.rows;
  for (int row = 0; row < options.rows; ++row) {
    const double height_fraction = options.rows > 1 ? static_cast<double>(row) / (options.rows - 1) : 0.5;
    const double diameter = options.diameter * (1.0 + grading * (height_fraction - 0.5));
    for (int column = 0; column < options.columns; ++column)
      holes.push_back(
          {(column + 0.5 + (row % 2 == 1 ? stagger : 0.0)) * pitch_x, (row + 0.5) * pitch_y, Circle{diameter}});
  }
  return holes;
}

std::vector<Perforation> place_turned(const LayoutOptions& options) {
  const std::int64_t rows = options.rows, columns = options.columns, turn = options.turn;
  const std::int64_t count = rows * columns + turn * turn;
  // (u, v) = M^-1 (k, m) with M = ((columns, turn), (-turn, rows)), whose determinant is the number of holes.
  const TurnedAxis x(options.width, rows, -turn, count), y(options.height, turn, columns, count);
  // The periods reach the lattice rows m that are multiples of gcd(turn, rows), and along m = 0 every count/gcd-th
  // point (Hermite's normal form of M): so these points stand for all, each once.
  const std::int64_t lines = std::gcd(turn, rows);
  std::vector<Perforation> holes;
  for (std::int64_t m = 0; m < lines; ++m)
    for (std::int64_t k = 0; k < count / lines; ++k)
      holes.push_back({x.at(k, m), y.at(k, m), Circle{options.diameter}});
  return holes;
}

}  // namespace perfora::geometry
