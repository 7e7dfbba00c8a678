// What is here: limits that the keys of [layout] and their checks share. What is not: limits of one of them.
#pragma once

#include <cstdint>

namespace perfora::geometry {

/// More holes than this are a mistake of units or count: a block has at most thousands.
inline constexpr std::int64_t maximum_holes = 10000;
/// Most that the diameters of a graded layout may differ, over their mean: at 2 the smallest row would have none.
inline constexpr double largest_grading = 1.9;

}  // namespace perfora::geometry
