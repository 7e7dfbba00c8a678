// What is here: Sobol's sequence with Owen's scrambling: points that fill the unit cube evenly, also as normal numbers.
// What is not: what they sample.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace perfora::model {

/// The first `count` points of Sobol's sequence in [0, 1)^dimension (3667 at most), each coordinate scrambled digit by
/// digit (Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995) by bits that follow from `seed`. Direction
/// numbers: Joe and Kuo 2008, as Boost.Random has them. A longer list begins with the shorter one. The same bits on
/// every machine.
std::vector<std::vector<double>> sobol_points(int count, int dimension, std::uint64_t seed);
/// The same, one point a row.
Eigen::MatrixXd sobol_matrix(int count, int dimension, std::uint64_t seed);
/// The same as independent standard normal numbers.
Eigen::MatrixXd normal_matrix(int count, int dimension, std::uint64_t seed);

}  // namespace perfora::model
