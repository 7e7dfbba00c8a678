// What is here: the discs that Cundall damping acts on, kept up to date as bonds break. What is not: forces.
#include "solver/damping.h"

namespace perfora::solver {

CundallDamping::CundallDamping(const DynamicsOptions& dynamics, const BondNetwork& network, std::size_t discs)
    : coefficients_(discs, dynamics.cundall_damping),
      rotation_ratio_(dynamics.cundall_scope == CundallScope::translation ? 0.0 : 1.0) {
  if (dynamics.cundall_scope != CundallScope::bonded) return;
  bonds_.assign(discs, 0);
  for (std::size_t b = 0; b < network.i.size(); ++b) {
    if (network.state[b] != BondState::intact) continue;
    ++bonds_[static_cast<std::size_t>(network.i[b])];
    ++bonds_[static_cast<std::size_t>(network.j[b])];
  }
  for (std::size_t d = 0; d < discs; ++d)
    if (bonds_[d] == 0) coefficients_[d] = 0.0;
}

void CundallDamping::bond_broke(std::int32_t i, std::int32_t j) {
  if (bonds_.empty()) return;
  free_when_alone(i);
  free_when_alone(j);
}

void CundallDamping::free_when_alone(std::int32_t disc) {
  const auto d = static_cast<std::size_t>(disc);
  if (--bonds_[d] == 0) coefficients_[d] = 0.0;
}

}  // namespace perfora::solver
