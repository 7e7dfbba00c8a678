// What is here: holes in rows one above the other: equal rows, graded ones, and rows that each have their own size,
// angle, height, shift and number of holes. What is not: other lattices (layout_lattice.h), jitter, wrapping into the
// cell, checks of the options (layout.cpp).
#pragma once

#include <vector>

#include "geometry/layout.h"
#include "geometry/planned_hole.h"

namespace perfora::geometry {

/// Value of row `row` (0 at the bottom) of `rows` in a profile given by `values`: the first belongs to the bottom row,
/// the last to the top row, the others lie at equal distances between them, and values in between are linear. One value
/// holds for all rows, as many as rows are each row's own; a single row has the middle of the profile. So a profile
/// keeps its form when the number of rows changes. `values` is not empty.
double row_profile(const std::vector<double>& values, int row, int rows);

/// Holes in row `row` of these options.
int columns_in_row(const LayoutOptions& options, int row);

/// Ribs of these options: one above every options.rib_every rows.
int rib_count(const LayoutOptions& options);

/// Holes of the families square, staggered, graded and rows, row by row from the bottom, left to right. Row r of equal
/// rows has its centre at (r + 1/2) height/rows; every odd row is moved to the right by the stagger (so x may lie
/// beyond the cell); a graded row has the diameter (1 + grading (r/(rows - 1) - 1/2)) options.diameter. With ribs the
/// rows share what the ribs leave of the height. `seed` feeds shift_spread.
std::vector<PlannedHole> plan_rows(const LayoutOptions& options, std::uint64_t seed);

}  // namespace perfora::geometry
