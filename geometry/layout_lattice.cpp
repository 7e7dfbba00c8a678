// What is here: places of holes on lattices. What is not: rows along the cell (layout_rows.cpp), random placement
// (layout_random.cpp).
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
class LatticeAxis {
 public:
  LatticeAxis(double period, std::int64_t a, std::int64_t b, std::int64_t holes)
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

std::vector<PlannedHole> plan_turned(const LayoutOptions& options) {
  const std::int64_t rows = options.rows, columns = options.columns, turn = options.turn;
  const std::int64_t count = rows * columns + turn * turn;
  // (u, v) = M^-1 (k, m) with M = ((columns, turn), (-turn, rows)), whose determinant is the number of holes.
  const LatticeAxis x(options.width, rows, -turn, count), y(options.height, turn, columns, count);
  // The periods reach the lattice rows m that are multiples of gcd(turn, rows), and along m = 0 every count/gcd-th
  // point (Hermite's normal form of M): so these points stand for all, each once.
  const std::int64_t lines = std::gcd(turn, rows);
  std::vector<PlannedHole> holes;
  for (std::int64_t m = 0; m < lines; ++m)
    for (std::int64_t k = 0; k < count / lines; ++k) holes.push_back(plain_hole(options, x.at(k, m), y.at(k, m)));
  return holes;
}

std::vector<PlannedHole> plan_oblique(const LayoutOptions& options) {
  const std::int64_t rows = options.rows, columns = options.columns;
  const double pitch = options.width / options.columns;
  const LatticeAxis y(options.height, options.climb, columns, rows * columns);
  std::vector<PlannedHole> holes;
  for (std::int64_t row = 0; row < rows; ++row)
    for (std::int64_t column = 0; column < columns; ++column) {
      holes.push_back(plain_hole(options, (static_cast<double>(column) + 0.5) * pitch, y.at(column, row)));
      if (options.herringbone && row % 2 == 1) holes.back().angle = -holes.back().angle;
    }
  return holes;
}

}  // namespace perfora::geometry
