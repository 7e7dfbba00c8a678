// What is here: points without regard to what is known: uniform random ones and scrambled Sobol points. What is not:
// the sequence (model/quasi_random.h).
#pragma once

#include <memory>

#include "optimize/search/searcher.h"

namespace perfora::optimize {

/// "random" and "sobol": every task asks at once for maxeval different points of its arm that keep the constraints. The
/// points lie on the grid of on_grid(), so they are the same on every machine.
std::shared_ptr<const Searcher> make_sampling_searcher();

/// The first `count` points of an arm by "random" or "sobol"; a longer list begins with the shorter one. Not yet on the
/// grid.
Points sample_points(const std::string& algorithm, int count, int dimension, std::uint64_t seed);

}  // namespace perfora::optimize
