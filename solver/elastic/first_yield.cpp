// What is here: the strain at which each bond yields, from the linear response, and the smallest of them.
#include "solver/elastic/first_yield.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace perfora::solver {
namespace {

/// At the yield surface the two terms of phi add up to 1, so the larger one is beyond one half.
bool yields_in_tension(const BondLaw& law, double delta_n, double strength) {
  return delta_n * law.inverse_critical_normal / strength > 0.5;
}

}  // namespace

FirstYield first_yield(const BondNetwork& network, const ElasticResponse& response, const BondLaw& law) {
  constexpr double none = std::numeric_limits<double>::infinity();
  constexpr double largest_strain = 1.0;  // nothing is left of the height; where a block carries nothing, only rounding
  FirstYield result;
  result.disc_strain.assign(response.displacement[0].size() / 3, none);
  std::vector<YieldingBond> yielding;
  result.strain = none;
  for (std::int32_t b = 0; b < network.size(); ++b) {
    const auto id = static_cast<std::size_t>(b);
    if (network.state[id] != BondState::intact) continue;
    const BondAnswer unit = bond_answer(network, b, response, UnitStrain::yy);
    const double s = yield_load_factor(law, -unit.delta_n, unit.delta_t, network.strength[id]);  // E_yy = -s
    if (s > largest_strain) continue;
    for (const std::int32_t disc : {network.i[id], network.j[id]}) {
      double& least = result.disc_strain[static_cast<std::size_t>(disc)];
      least = std::min(least, s);
    }
    if (s > (1.0 + near_first) * result.strain) continue;
    result.strain = std::min(result.strain, s);
    yielding.push_back({b, s,
                        yields_in_tension(law, -s * unit.delta_n, network.strength[id]) ? results::BreakMode::tension
                                                                                        : results::BreakMode::shear});
  }
  result.stress = response.stiffness[1][1] * result.strain;
  result.lateral_stress = response.stiffness[0][1] * result.strain;
  for (const YieldingBond& bond : yielding)
    if (bond.strain <= (1.0 + near_first) * result.strain) result.first_bonds.push_back(bond);
  std::stable_sort(result.first_bonds.begin(), result.first_bonds.end(),
                   [](const YieldingBond& a, const YieldingBond& b) { return a.strain < b.strain; });
  return result;
}

}  // namespace perfora::solver
