// What is here: points spread evenly over the periodic cell at random: blue noise and centroidal Voronoi cells.
// What is not: holes (layout_random.h keeps walls between them).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/shapes.h"

namespace perfora::geometry {

/// Largest smallest distance that `count` points of a periodic cell can have: that of the triangular lattice,
/// sqrt(2 width height/(sqrt(3) count)) m. The relative radius of a set of points is its smallest distance over this
/// (Lagae and Dutre 2008).
double largest_distance(double width, double height, int count);

/// Poisson-disc points: random sequential addition at the largest smallest distance at which it still places all of
/// `count` points, tried from relative radius 0.78 downwards in steps of 0.01 (relaxed dart throwing, McCool and Fiume
/// 1992). Depends on the arguments only.
std::vector<Point> blue_noise_points(double width, double height, int count, std::uint64_t seed);

/// Points at the centroids of their own Voronoi cells: Lloyd's method from blue_noise_points on the torus, until no
/// point moves farther than 1e-3 of largest_distance, 200 rounds at most. Depends on the arguments only.
std::vector<Point> voronoi_points(double width, double height, int count, std::uint64_t seed);

}  // namespace perfora::geometry
