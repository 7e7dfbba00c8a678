// What is here: how much of a cell is open, seen from the discs alone: for packings whose openings nobody has told.
// What is not: the area of known openings (perforation.h).
#pragma once

#include "geometry/packing.h"

namespace perfora::geometry {

/// Fraction of the cell that empty circles of the radius `reach` (m) can cover without touching a disc: openings, not
/// the gaps between neighbouring discs, which are smaller. Counted on a grid of reach/4, so good to about a tenth of
/// reach times the length of the openings' edges. Cost O(discs (d/reach + 2)^2).
double open_fraction(const Packing& packing, double reach);

}  // namespace perfora::geometry
