// What is here: see first_yield.h.
#include "solver/first_yield.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace perfora::solver {

double yield_factor(double a, double b, int twice_alpha) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (!(b > 0.0)) return a > 0.0 ? 1.0 / a : none;
  const double alpha = 0.5 * twice_alpha;
  const auto phi = [&](double s) { return a * s + half_integer_power(b * s, twice_alpha) - 1.0; };
  // phi is convex and -1 at s = 0: one positive root, none only where alpha = 1 and a + b <= 0. From a point beyond it
  // Newton's method comes down to it.
  double s = 1.0 / b;
  if (a < 0.0) {
    constexpr int most_doublings = 200;  // beyond any strain
    int k = 0;
    for (; k < most_doublings && !(phi(s) > 0.0); ++k) s *= 2.0;
    if (k == most_doublings) return none;
  }
  constexpr int most_iterations = 100;  // quadratic convergence; the bound only guards against rounding
  for (int k = 0; k < most_iterations; ++k) {
    const double next = s - phi(s) / (a + alpha * half_integer_power(b * s, twice_alpha) / s);
    if (!(next < s)) break;
    s = next;
  }
  return s;
}

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
    const double a = -unit.delta_n * law.inverse_critical_normal / network.strength[id];  // E_yy = -s
    const double shear = std::fabs(unit.delta_t) * law.inverse_critical_shear / network.strength[id];
    const double s = yield_factor(a, shear, law.twice_alpha);
    if (s > largest_strain) continue;
    for (const std::int32_t disc : {network.i[id], network.j[id]}) {
      double& least = result.disc_strain[static_cast<std::size_t>(disc)];
      least = std::min(least, s);
    }
    if (s > (1.0 + near_first) * result.strain) continue;
    result.strain = std::min(result.strain, s);
    yielding.push_back(
        {b, s, a * s > half_integer_power(shear * s, law.twice_alpha) ? BreakMode::tension : BreakMode::shear});
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
