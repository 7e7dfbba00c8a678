// What is here: a hole before its shape is made, sizes and angles at random, and the shape itself.
// What is not: where holes are (layout_rows.h, layout_lattice.h, layout_random.h), what a shape is (shapes.h).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/layout.h"

namespace perfora::geometry {

/// Lengths in m, angles in rad; the centre may lie outside the cell.
struct PlannedHole {
  double x = 0.0, y = 0.0;
  double length = 0.0,
         breadth = 0.0;  ///< along and across the shape's own axis; breadth 0: as a polygon's outline says
  double angle = 0.0;    ///< of the axis from the horizontal, anticlockwise
};

/// Breadth of a hole of this length by options.breadth or options.aspect; 0 for a polygon with neither.
double breadth_for(const LayoutOptions& options, double length);

/// A hole at (x, y) with the size and angle of the plain keys.
PlannedHole plain_hole(const LayoutOptions& options, double x, double y);

/// Makes sizes and angles random: of n holes the one of rank k = 0 ... n - 1 (a random permutation) is
/// 1 + size_spread ((2 k + 1)/n - 1) times as large, so that the mean size is kept and the porosity does not depend on
/// the seed where all are equal; every hole turns by angle_spread (2 u - 1). Nothing is drawn where a spread is zero.
void spread(std::vector<PlannedHole>& holes, const LayoutOptions& options, std::uint64_t seed);

/// What is wrong with the first hole whose size its shape cannot have. `outline`: corners of a polygon, empty for other
/// shapes.
std::optional<ShapeFault> first_fault(const std::vector<PlannedHole>& holes, const LayoutOptions& options,
                                      const std::vector<Point>& outline);

/// The holes in their shape, one of equal neighbours being made. Throws std::invalid_argument where first_fault() has
/// one.
std::vector<Perforation> shaped(const std::vector<PlannedHole>& holes, const LayoutOptions& options,
                                const std::vector<Point>& outline);

}  // namespace perfora::geometry
