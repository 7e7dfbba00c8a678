// What is here: holes on a turned lattice and on an oblique one. What is not: rows along the cell (layout_rows.h),
// jitter, wrapping into the cell, checks of the options (layout.cpp).
#pragma once

#include <vector>

#include "geometry/planned_hole.h"

namespace perfora::geometry {

/// Holes on the lattice of all integer points (k, m), the periods of the cell being its vectors (columns, -turn) and
/// (turn, rows): rows x columns + turn^2 holes, each once, centres within the cell. In a square cell with as many rows
/// as columns this is the square lattice turned anticlockwise by atan(turn/columns); in others that lattice is
/// stretched with the cell. A turn of 0 gives the square family to the last bit, in the same order. Lengths in m; rows,
/// columns >= 1.
std::vector<PlannedHole> plan_turned(const LayoutOptions& options);

/// Upright columns at equal distances, each climb/columns vertical pitches higher than the one to its left, so that the
/// lattice meets itself `climb` whole pitches higher after one width of the cell: hole row x columns + column lies at
/// ((column + 1/2) width/columns, (row + 1/2 + climb (column + 1/2)/columns) height/rows), brought into the cell. A
/// climb of 0 gives the square family to the last bit, in the same order.
std::vector<PlannedHole> plan_oblique(const LayoutOptions& options);

}  // namespace perfora::geometry
