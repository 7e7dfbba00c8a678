// What is here: the ends of a block that are crushed before it is loaded. What is not: how a bond breaks (laws.h).
#pragma once

#include "geometry/packing.h"
#include "solver/bond_network.h"
#include "solver/options.h"

namespace perfora::solver {

/// Takes the bonds out of the network whose middle lies in the lowest boundary.crushed_bottom m of the block or in its
/// highest crushed_top: their discs meet as loose grains from the start, and nothing counts these bonds as broken. The
/// block stands in the packing where `frame` says. The other bonds keep their order.
void remove_crushed_bonds(BondNetwork& network, const geometry::Packing& packing, const FieldFrame& frame,
                          const BoundaryOptions& boundary);

}  // namespace perfora::solver
