// What is here: the parameters of the laws from a design's material and its disc size. What is not: the laws (laws.h).
#include "solver/laws.h"

#include <cmath>

namespace perfora::solver {

double threshold_factor(const MaterialOptions& material, double mean_diameter) {
  const double ratio = mean_diameter / material.reference_mean_diameter;
  switch (material.threshold_scaling) {
    case ThresholdScaling::strength:
      return material.strength * ratio;
    case ThresholdScaling::toughness:
      return material.strength * std::sqrt(ratio);
    case ThresholdScaling::none:
      break;
  }
  return material.strength;
}

BondLaw make_bond_law(const MaterialOptions& material, double mean_diameter) {
  const double factor = threshold_factor(material, mean_diameter);
  BondLaw law;
  law.normal_stiffness = material.normal_stiffness;
  law.tangential_stiffness = material.tangential_stiffness;
  law.inverse_critical_normal = 1.0 / (material.critical_normal_displacement * factor);
  law.inverse_critical_shear = 1.0 / (material.critical_shear_displacement * factor);
  law.twice_alpha = static_cast<int>(std::lround(2.0 * material.yield_exponent));
  law.rupture_delay = material.rupture_delay;
  law.damage_form = material.damage_form;
  law.damage_in_compression = material.damage_in_compression;
  return law;
}

ContactLaw make_contact_law(const MaterialOptions& material) {
  return {material.normal_stiffness, material.tangential_stiffness, material.friction_coefficient,
          material.viscous_rate};
}

}  // namespace perfora::solver
