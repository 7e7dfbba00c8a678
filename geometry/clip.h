// What is here: a packing clipped by the perforations. What is not: the packing (make_packing.h), walls (wall.h).
#pragma once

#include "geometry/packing.h"
#include "geometry/perforation.h"

namespace perfora::geometry {

/// Which discs a perforation takes: those whose centre it contains, or all that it touches.
enum class ClipRule { centre, whole };

/// Removes the discs that a perforation takes away and sorts the rest along a Hilbert curve (neighbours in space become neighbours in memory).
Packing clip_packing(const Packing& packing, const PerforationLayout& layout, ClipRule rule);

}  // namespace perfora::geometry
