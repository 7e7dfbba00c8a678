// What is here: moduli read from a plane stiffness. What is not: the stiffness of a block (elastic.h).
#pragma once

#include <array>

namespace perfora::solver {

/// Plane stiffness in Voigt's order xx, yy, xy with the engineering shear gamma = 2 E_xy, Pa: stress = stiffness
/// strain.
using PlaneStiffness = std::array<std::array<double, 3>, 3>;

/// What engineers read from a plane stiffness. "x" and "y" name the direction of a uniaxial stress; the ratio
/// poisson_xy is the contraction in y for that stress in x. NaN where no stress is carried.
struct PlaneModuli {
  double young_x = 0.0, young_y = 0.0;        ///< Pa
  double poisson_xy = 0.0, poisson_yx = 0.0;  ///< two-dimensional
  double shear_modulus = 0.0;                 ///< Pa, shear stress over engineering shear, no other stress
  /// Distance from the nearest isotropic stiffness over the norm of the stiffness (Frobenius, Kelvin's notation; the
  /// same in every frame): 0 isotropic, below 1.
  double anisotropy = 0.0;
  double isotropic_young = 0.0, isotropic_poisson = 0.0;  ///< of the nearest isotropic stiffness, two-dimensional
  double isotropic_bulk = 0.0, isotropic_shear = 0.0;     ///< its K and G, Pa: C11 = K + G, C12 = K - G
  /// The same stiffness read as plane strain of a three-dimensional solid: nu = nu2/(1 + nu2), E = E2 (1 - nu^2).
  double plane_strain_young = 0.0, plane_strain_poisson = 0.0;
};

/// Plane-strain reading of two-dimensional constants: nu = nu2/(1 + nu2), E = E2 (1 - nu^2).
double plane_strain_poisson_ratio(double two_dimensional);
double plane_strain_young_modulus(double two_dimensional, double two_dimensional_poisson);

/// Moduli of a symmetric plane stiffness.
PlaneModuli plane_moduli(const PlaneStiffness& stiffness);

}  // namespace perfora::solver
