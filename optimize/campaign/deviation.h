// What is here: a block that comes out of the workshop a little other than its design: sizes and places of its holes,
// its material, the direction of its pattern. What is not: which blocks are compared (tolerance.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "optimize/evaluate/design.h"

namespace perfora::optimize {

/// What may differ from a design; each by itself.
enum class Deviation { hole_size, hole_position, grade, tilt, shear };
const char* deviation_name(Deviation deviation);  ///< "hole size"

/// Why a deviation means nothing for a design, or cannot be made; empty: it can. A clause.
std::string why_not(Deviation deviation, const DesignFile& design);

/// The design with a deviation of at most `amount` (hole_size, hole_position: m, as laid; grade, shear: ratio; tilt:
/// rad), drawn by `seed` for holes and with the sign of `amount` for the rest. Only where why_not() is empty.
///   hole_size      every circle is up to `amount` wider or narrower, evenly, each by itself; of other shapes sizes are
///                  spread evenly by as much of the mean hole (layout.size_spread)
///   hole_position  every centre moves evenly within a disc of this radius
///   grade          times 1 + amount
///   tilt           the pattern turns in the block, as if the load came from aside
///   shear          every hole moves sideways by `amount` of its height above the middle
/// The least wall that the design asks for is not asked here.
Design deviated(const DesignFile& design, Deviation deviation, double amount, std::uint64_t seed);

}  // namespace perfora::optimize
