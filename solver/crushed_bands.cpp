// What is here: bonds left out at the ends of a block. What is not: bonds that a hole separates (bond_network.cpp).
#include "solver/crushed_bands.h"

#include <cmath>

namespace perfora::solver {

void remove_crushed_bonds(BondNetwork& network, const geometry::Packing& packing, const FieldFrame& frame,
                          const BoundaryOptions& boundary) {
  if (boundary.crushed_bottom == 0.0 && boundary.crushed_top == 0.0) return;
  const double height = frame.height > 0.0 ? frame.height : packing.height;
  std::size_t kept = 0;
  const auto in_every_column = [&](const auto& act) {
    act(network.i), act(network.j), act(network.reference_length), act(network.direction_x), act(network.direction_y);
    act(network.strength), act(network.damage), act(network.state);
  };
  for (std::size_t b = 0; b < network.i.size(); ++b) {
    const double from = packing.y[static_cast<std::size_t>(network.i[b])] - frame.origin_y;
    double middle = from + 0.5 * network.direction_y[b] * network.reference_length[b];
    middle -= height * std::floor(middle / height);  // a bond across the border of a periodic block
    if (middle < boundary.crushed_bottom || middle > height - boundary.crushed_top) continue;
    in_every_column([&](auto& column) { column[kept] = column[b]; });
    ++kept;
  }
  in_every_column([&](auto& column) { column.resize(kept); });
}

}  // namespace perfora::solver
