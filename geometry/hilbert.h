// What is here: the order of points along a Hilbert curve: neighbours in space become neighbours in memory.
// What is not: CGAL, which does it (hilbert.cpp).
#pragma once

#include <cstddef>
#include <vector>

namespace perfora::geometry {

/// Indices of the points in the order of a Hilbert curve; cost N log N.
std::vector<std::size_t> hilbert_order(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace perfora::geometry
