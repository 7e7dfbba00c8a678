// What is here: the mean stress of every disc of a frame, from the normal forces of its bonds and contacts. What is
// not: the solver's own forces (they are not kept in frames), drawing.
#pragma once

#include <vector>

#include "results/run_file.h"

namespace perfora::report {

/// What the normal forces of a run follow from.
struct NormalSprings {
  double stiffness = 0.0;              ///< k_n of bonds and contacts, N/m; 0: not known
  bool damage_in_compression = false;  ///< damage weakens closed bonds, too
};
/// From the resolved configuration of the run; a stiffness of 0 where it has none that can be read.
NormalSprings normal_springs(const results::RunResult& run);

/// Mean stress of each disc, Pa, compression positive: half of the sum over its bonds and contacts of -f_n |r|/2, over
/// the disc's area (the trace of its stress tensor over two; shear forces, at right angles to r, add nothing to it).
/// Frames that hold their stresses give those. f_n as in docs/user/theory.md, "Bonds" and "Contacts", without the
/// viscous part. Zero without a stiffness. Cost: linear in discs and bonds.
std::vector<double> disc_pressure(const results::RunResult& run, const results::Frame& frame,
                                  const NormalSprings& springs);

}  // namespace perfora::report
