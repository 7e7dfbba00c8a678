// What is here: the guard over the energies of a run that goes on. What is not: the residual of a finished one
// (results/measures.h).
#pragma once

#include <cstddef>

#include "results/history.h"

namespace perfora::solver {

/// Looks at each sample once.
class EnergyWatch {
 public:
  /// Largest difference of work and energies at the samples since the last call, over the largest work so far; 0 where
  /// there are none or the strain is too small to tell (results::residual_from_strain).
  double residual(const results::History& history);

 private:
  std::size_t seen_ = 0;
  double largest_work_ = 0.0;  ///< J per metre of depth
};

/// A run ends as failed when its residual is larger. Designs stay below 1e-4 at the rates they are run at, and below
/// 0.6 % at 1e4 1/s with whatever damping and step; 1.5 % were reached at 1e5 1/s and 15 % at 1e6 1/s, where the block
/// crosses several diameters while a wave crosses a disc.
inline constexpr double largest_residual = 0.1;

}  // namespace perfora::solver
