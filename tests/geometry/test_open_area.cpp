// What is here: the open fraction of packings whose openings are known. What is not: the area of shapes
// (test_perforation.cpp).
#include "geometry/open_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace perfora::geometry {
namespace {

/// Equal discs of 1 mm touching on a square lattice, those whose centres lie in `holes` left out.
template <class Inside>
Packing lattice(int columns, int rows, const Inside& inside) {
  Packing packing;
  packing.width = columns * 1e-3;
  packing.height = rows * 1e-3;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double x = (i + 0.5) * 1e-3, y = (j + 0.5) * 1e-3;
      if (inside(x, y)) continue;
      packing.x.push_back(x);
      packing.y.push_back(y);
      packing.radius.push_back(0.5e-3);
    }
  return packing;
}

// The gaps of the lattice hold circles of radius (sqrt(2) - 1)/2 mm = 0.207 mm: no opening for circles of 1 mm.
TEST(OpenFraction, GapsBetweenDiscsAreNoOpenings) {
  EXPECT_EQ(open_fraction(lattice(30, 20, [](double, double) { return false; }), 1e-3), 0.0);
}

// A slot across the cell in which eight rows are missing is 8 mm wide, less what the round discs leave between the ends
// of two neighbours, which a circle of 1 mm cannot reach into by more than 1 - sqrt(1 - 1/4) of its radius and as much
// of theirs: below 0.2 mm on each side. It may lie across the periodic edge.
TEST(OpenFraction, ASlotHasItsArea) {
  for (const double shift : {0.0, 6e-3}) {
    const Packing packing = lattice(30, 20, [&](double, double y) {
      const double from = y - 6e-3 + shift;
      return from - 20e-3 * std::floor(from / 20e-3) < 8e-3;
    });
    EXPECT_NEAR(open_fraction(packing, 1e-3), 8.0 / 20.0, 2.0 * 0.25 / 20.0) << shift;
  }
}

// A round hole of 20 mm in 40 x 40 mm: pi 10^2/40^2. The discs whose centres lie outside reach in by up to half a
// millimetre all around, and the staircase of the lattice on average as much out of it.
TEST(OpenFraction, ACircleHasItsArea) {
  const Packing packing = lattice(40, 40, [](double x, double y) { return std::hypot(x - 20e-3, y - 20e-3) < 10e-3; });
  EXPECT_NEAR(open_fraction(packing, 1e-3), std::numbers::pi * 100.0 / 1600.0,
              2.0 * std::numbers::pi * 10.0 * 0.5 / 1600.0);
}

}  // namespace
}  // namespace perfora::geometry
