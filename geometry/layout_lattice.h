// What is here: holes on a lattice: in rows along the cell, with equal or graded diameters, and on a turned lattice.
// What is not: jitter, wrapping into the cell, checks of the options (layout.cpp).
#pragma once

#include <vector>

#include "geometry/layout.h"

namespace perfora::geometry {

/// Holes in rows one above the other at equal pitches, row 0 at the bottom; hole number row x columns + column. Every
/// odd row is moved to the right by `stagger` horizontal pitches (so x may lie beyond the cell), and row r has the
/// diameter `options.diameter` (1 + grading (r/(rows - 1) - 1/2)). Lengths in m; rows, columns >= 1.
std::vector<Perforation> place_in_rows(const LayoutOptions& options, double stagger, double grading);

/// Holes on the lattice of all integer points (k, m), the periods of the cell being its vectors (columns, -turn) and
/// (turn, rows): rows x columns + turn^2 holes, each once, centres within the cell. In a square cell with as many rows
/// as columns this is the square lattice turned anticlockwise by atan(turn/columns); in others that lattice is
/// stretched with the cell. A turn of 0 gives place_in_rows(options, 0, 0) to the last bit, in the same order.
std::vector<Perforation> place_turned(const LayoutOptions& options);

}  // namespace perfora::geometry
