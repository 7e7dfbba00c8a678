// What is here: the check that work is the sum of its parts, all through a compression. What is not: the blocks that
// are compressed (sample_packings.h, bounded_block.h).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "solver/simulation.h"

namespace perfora::test {

/// Steps to 6 % strain; every 50 steps from 0.2 % on, external work and the sum of the ledger may differ by
/// `share` of the largest work so far.
inline void compress_with_closed_ledger(solver::Simulation& s, double fraction) {
  double work = 0.0;
  while (s.strain() < 0.06) {
    s.step();
    if (s.steps() % 50 != 0 || s.strain() < 0.002) continue;
    const solver::Ledger l = s.ledger();
    work = std::max(work, l.external_work);
    ASSERT_NEAR(l.external_work, l.sum(), fraction * work) << "strain " << s.strain();
  }
}

}  // namespace perfora::test
