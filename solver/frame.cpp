// What is here: positions, angles, fragments and lost bonds of a simulation at one moment. What is not: files.
#include "solver/frame.h"

#include "solver/fragments.h"

namespace perfora::solver {

std::vector<std::int32_t> count_bonds_per_disc(const BondNetwork& network, std::size_t discs) {
  std::vector<std::int32_t> count(discs, 0);
  for (std::size_t b = 0; b < network.i.size(); ++b) {
    ++count[static_cast<std::size_t>(network.i[b])];
    ++count[static_cast<std::size_t>(network.j[b])];
  }
  return count;
}

results::Frame take_frame(const Simulation& simulation, const std::vector<std::int32_t>& original_bonds) {
  const BondNetwork& network = simulation.network();
  const DiscState& discs = simulation.discs();
  const auto n = static_cast<std::size_t>(discs.size());
  results::Frame frame;
  const CellMatrix block = simulation.block();
  frame.info = {"", simulation.strain(), simulation.time(), block.xx, block.xy, block.yy};
  frame.position.reserve(2 * n);
  for (std::int32_t d = 0; d < discs.size(); ++d) {
    const auto [x, y] = simulation.position(d);
    frame.position.push_back(x);
    frame.position.push_back(y);
  }
  for (std::size_t d = 0; d < n; ++d) frame.angle.push_back(discs.angle(d));
  std::vector<double> kept(n, 0.0);
  for (std::size_t b = 0; b < network.i.size(); ++b) {
    if (network.state[b] != BondState::intact) continue;
    frame.bond_pairs.push_back(network.i[b]);
    frame.bond_pairs.push_back(network.j[b]);
    frame.bond_damage.push_back(network.damage[b]);
    kept[static_cast<std::size_t>(network.i[b])] += 1.0 - network.damage[b];
    kept[static_cast<std::size_t>(network.j[b])] += 1.0 - network.damage[b];
  }
  frame.damage.assign(n, 0.0);
  for (std::size_t d = 0; d < n; ++d)
    if (original_bonds[d] > 0) frame.damage[d] = 1.0 - kept[d] / original_bonds[d];
  frame.fragment = find_fragments(network, discs.radius).label;
  return frame;
}

}  // namespace perfora::solver
