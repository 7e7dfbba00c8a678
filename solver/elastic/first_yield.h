// What is here: where a block yields first under oedometric compression, from its elastic response. What is not: the
// answer itself (elastic.h), what follows the first yield (run.h).
#pragma once

#include <cstdint>
#include <vector>

#include "results/break_event.h"
#include "solver/elastic/elastic.h"
#include "solver/laws.h"

namespace perfora::solver {

/// A bond that yields early.
struct YieldingBond {
  std::int32_t bond = 0;  ///< its row in the network
  double strain = 0.0;    ///< engineering strain of the block, compression positive
  results::BreakMode mode = results::BreakMode::tension;
};

/// First yield as the height shrinks at fixed width, every bond linear until then. A bond that would yield only beyond
/// a strain of 1 never does.
struct FirstYield {
  double strain = 0.0;  ///< of the first bond; infinite where no bond yields
  double stress = 0.0;  ///< vertical stress there, Pa, compression positive; NaN or infinite where no bond yields
  double lateral_stress = 0.0;            ///< horizontal stress there, Pa
  std::vector<double> disc_strain;        ///< strain at which the first of a disc's bonds yields; infinite: none does
  std::vector<YieldingBond> first_bonds;  ///< the first bond and all within `near_first` of its strain, in that order
};

/// Share of the first yield strain within which further bonds are listed.
inline constexpr double near_first = 0.02;

/// `law` of the same material as the answer. O(bonds).
FirstYield first_yield(const BondNetwork& network, const ElasticResponse& response, const BondLaw& law);

}  // namespace perfora::solver
