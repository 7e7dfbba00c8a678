// What is here: the bond law and the contact law as parameter structs and pure inline functions from scalars to scalars
// (history in, history out). What is not: loops, discs, lists (kernels/). Only IEEE basic operations
// and sqrt, so that bits do not depend on a maths library. Sources: paper, Fig. 3 and Table 1; docs/user/theory.md for
// what the paper leaves open.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "solver/options.h"

namespace perfora::solver {

/// Parameters of a bond. Short symbols of the paper: k_n, k_t, delta_n^0, delta_t^0, alpha, zeta_max, D.
struct BondLaw {
  double normal_stiffness = 0.0;         ///< k_n, N/m
  double tangential_stiffness = 0.0;     ///< k_t, N/m
  double inverse_critical_normal = 0.0;  ///< 1/delta_n^0, 1/m
  double inverse_critical_shear = 0.0;   ///< 1/delta_t^0, 1/m
  int twice_alpha = 8;                   ///< 2 alpha: the yield exponent in steps of one half
  double rupture_delay = 1.1;            ///< zeta_max >= 1
  DamageForm damage_form = DamageForm::linear_damage;
  DamageInCompression damage_in_compression = DamageInCompression::none;
};

/// base^(twice_exponent/2) for base >= 0, by multiplications and one square root.
inline double half_integer_power(double base, int twice_exponent) {
  double result = (twice_exponent & 1) ? std::sqrt(base) : 1.0;
  double square = base;
  for (int rest = twice_exponent >> 1; rest > 0; rest >>= 1) {
    if (rest & 1) result *= square;
    square *= square;
  }
  return result;
}

/// Yield function phi(zeta) = delta_n/(zeta delta_n^0) + (|delta_t|/(zeta delta_t^0))^alpha - 1 (paper, Fig. 3), with
/// both thresholds times `strength`. delta_n is signed: compression raises the shear strength. `inverse_zeta` = 1/zeta;
/// displacements in m.
inline double bond_yield(const BondLaw& law, double delta_n, double delta_t, double strength, double inverse_zeta) {
  const double scale = inverse_zeta / strength;
  return delta_n * law.inverse_critical_normal * scale +
         half_integer_power(std::fabs(delta_t) * law.inverse_critical_shear * scale, law.twice_alpha) - 1.0;
}

/// zeta at which a bond of damage D < 1 yields: 1 when intact, zeta_max when broken.
inline double zeta_of_damage(const BondLaw& law, double damage) {
  const double span = law.rupture_delay - 1.0;
  if (law.damage_form == DamageForm::linear_damage) return 1.0 + damage * span;
  return law.rupture_delay / (law.rupture_delay - damage * span);
}

/// Inverse of zeta_of_damage on [1, zeta_max], zeta_max > 1.
inline double damage_of_zeta(const BondLaw& law, double zeta) {
  const double fraction = (zeta - 1.0) / (law.rupture_delay - 1.0);
  return law.damage_form == DamageForm::linear_damage ? fraction : law.rupture_delay * fraction / zeta;
}

/// Damage after the displacements reached (delta_n, delta_t): unchanged inside the yield surface, 1 beyond
/// phi(zeta_max) = 0, else from the root of phi(zeta) = 0. Never decreases. With s = 1/zeta, g(s) = a s + (b s)^alpha -
/// 1 is convex and positive at the start, so Newton descends monotonically.
inline double updated_damage(const BondLaw& law, double delta_n, double delta_t, double strength, double damage) {
  if (damage >= 1.0) return 1.0;
  if (bond_yield(law, delta_n, delta_t, strength, 1.0 / law.rupture_delay) > 0.0) return 1.0;
  double s = 1.0 / zeta_of_damage(law, damage);
  if (!(bond_yield(law, delta_n, delta_t, strength, s) > 0.0)) return damage;
  if (law.rupture_delay <= 1.0) return 1.0;
  const double a = delta_n * law.inverse_critical_normal / strength;
  const double b = std::fabs(delta_t) * law.inverse_critical_shear / strength;
  const double alpha = 0.5 * law.twice_alpha;
  constexpr int most_iterations = 60;  // quadratic convergence needs about five; the bound only guards against rounding
  for (int k = 0; k < most_iterations; ++k) {
    const double shear = half_integer_power(b * s, law.twice_alpha);
    const double next = s - (a * s + shear - 1.0) / (a + alpha * shear / s);
    if (!(next < s)) break;
    s = next;
  }
  const double zeta = std::clamp(1.0 / s, 1.0, law.rupture_delay);
  return std::max(damage, std::min(1.0, damage_of_zeta(law, zeta)));
}

/// Factor s > 0 by which the displacements (m) must be multiplied to reach the first yield phi(1) = 0 of an undamaged
/// bond: the root of a s + (b s)^alpha = 1 with a = delta_n/(strength delta_n^0), b = |delta_t|/(strength delta_t^0);
/// infinite for a bond that compression alone never breaks.
inline double yield_load_factor(const BondLaw& law, double delta_n, double delta_t, double strength) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double a = delta_n * law.inverse_critical_normal / strength;
  const double b = std::fabs(delta_t) * law.inverse_critical_shear / strength;
  if (!(b > 0.0)) return a > 0.0 ? 1.0 / a : none;
  const double alpha = 0.5 * law.twice_alpha;
  const auto phi = [&](double s) { return a * s + half_integer_power(b * s, law.twice_alpha) - 1.0; };
  // phi is convex and -1 at s = 0: one positive root, none only where alpha = 1 and a + b <= 0. From a point beyond it
  // Newton's method comes down to it.
  double s = a > b ? 1.0 / a : 1.0 / b;
  if (a < 0.0) {
    constexpr int most_doublings = 200;  // beyond any strain
    int k = 0;
    for (; k < most_doublings && !(phi(s) > 0.0); ++k) s *= 2.0;
    if (k == most_doublings) return none;
  }
  constexpr int most_iterations = 100;  // quadratic convergence; the bound only guards against rounding
  for (int k = 0; k < most_iterations; ++k) {
    const double next = s - phi(s) / (a + alpha * half_integer_power(b * s, law.twice_alpha) / s);
    if (!(next < s)) break;
    s = next;
  }
  return s;
}

/// Share of the normal stiffness that is left: damage always weakens tension; compression only with
/// damage_in_compression = full.
inline double normal_integrity(const BondLaw& law, double delta_n, double damage) {
  return (delta_n > 0.0 || law.damage_in_compression == DamageInCompression::full) ? 1.0 - damage : 1.0;
}

/// Where a bond stands: its displacements, and the overlap a contact in its place would have (m, 0 when apart).
struct BondPoint {
  double delta_n = 0.0, delta_t = 0.0;
  double overlap = 0.0;
};

struct BondForce {
  double normal = 0.0;  ///< f_n = k_n (1-D or 1) delta_n, N/m; tension positive
  double shear = 0.0;   ///< f_t = (1-D) k_t delta_t, N/m
};

/// Forces of a bond. With damage_in_compression = full the contact spring k_n grows in parallel by D, so that a closed
/// pair never loses its support.
inline BondForce bond_force(const BondLaw& law, const BondPoint& at, double damage) {
  double normal = law.normal_stiffness * normal_integrity(law, at.delta_n, damage) * at.delta_n;
  if (law.damage_in_compression == DamageInCompression::full) normal -= law.normal_stiffness * damage * at.overlap;
  return {normal, law.tangential_stiffness * (1.0 - damage) * at.delta_t};
}

/// Elastic energy U of a bond, J/m. Forces are its derivatives.
inline double bond_energy(const BondLaw& law, const BondPoint& at, double damage) {
  double energy = 0.5 * law.normal_stiffness * normal_integrity(law, at.delta_n, damage) * at.delta_n * at.delta_n +
                  0.5 * law.tangential_stiffness * (1.0 - damage) * at.delta_t * at.delta_t;
  if (law.damage_in_compression == DamageInCompression::full)
    energy += 0.5 * law.normal_stiffness * damage * at.overlap * at.overlap;
  return energy;
}

/// Energy that a change dD takes at fixed displacements, over dD: U0 = -dU/dD, J/m. Taken between two points it is the
/// bilinear form of the same quadratic energy, which is exactly what the trapezoid of the forces over that step leaves
/// over (docs/user/theory.md, "Ledger").
inline double damageable_energy(const BondLaw& law, const BondPoint& before, const BondPoint& after) {
  double normal = std::max(0.0, before.delta_n) * std::max(0.0, after.delta_n);
  if (law.damage_in_compression == DamageInCompression::full)
    normal += std::max(0.0, -before.delta_n) * std::max(0.0, -after.delta_n) - before.overlap * after.overlap;
  return 0.5 * (law.normal_stiffness * normal + law.tangential_stiffness * before.delta_t * after.delta_t);
}

/// What the compression spring of a bond loses when it breaks (damage_in_compression = none): nothing where a contact
/// of the same reference takes over (l0 <= R_i + R_j), else its energy less that of the contact. Bilinear as above;
/// J/m.
inline double compression_release(const BondLaw& law, const BondPoint& before, const BondPoint& after,
                                  bool contact_takes_over) {
  if (contact_takes_over || law.damage_in_compression == DamageInCompression::full) return 0.0;
  return 0.5 * law.normal_stiffness *
         (std::max(0.0, -before.delta_n) * std::max(0.0, -after.delta_n) - before.overlap * after.overlap);
}

/// A bond's displacements from its geometry (docs/user/theory.md, "Bonds"): branch r = x_j - x_i, reference direction
/// e0 and length l0, cosine and sine of theta = (theta_i + theta_j)/2.
struct BondKinematics {
  double length = 0.0;  ///< |r|
  double nx = 0.0, ny = 0.0;
  double tx = 0.0, ty = 0.0;  ///< t = Q(theta) perp(e0)
  double along = 0.0;         ///< e . r, the double of the lever of the shear force
  double delta_n = 0.0, delta_t = 0.0;
};

inline BondKinematics bond_kinematics(double rx, double ry, double e0x, double e0y, double l0, double cosine,
                                      double sine) {
  BondKinematics k;
  k.length = std::sqrt(rx * rx + ry * ry);
  k.nx = rx / k.length;
  k.ny = ry / k.length;
  const double ex = cosine * e0x - sine * e0y;
  const double ey = sine * e0x + cosine * e0y;
  k.tx = -ey;
  k.ty = ex;
  k.along = ex * rx + ey * ry;
  k.delta_n = k.length - l0;
  k.delta_t = k.tx * rx + k.ty * ry;
  return k;
}

/// Parameters of a contact between discs with no intact bond.
struct ContactLaw {
  double normal_stiffness = 0.0;      ///< k_n, N/m
  double tangential_stiffness = 0.0;  ///< k_t, N/m
  double friction_coefficient = 0.0;  ///< mu
  double viscous_rate = 0.0;          ///< beta: c = 2 beta sqrt(k_n m_eff)
};

/// History of a touching pair; all zero before the first touch.
struct ContactHistory {
  double shear = 0.0;          ///< tangential spring xi, m
  double viscous_force = 0.0;  ///< viscous part of the normal force at the last step, N/m (for the ledger's trapezoid)
};

struct ContactForce {
  double normal = 0.0;    ///< total normal force >= 0 (repulsive), N/m
  double shear = 0.0;     ///< k_t xi, N/m; acts on j along -t
  double friction = 0.0;  ///< dissipated by slip in this step, J/m
  double viscous = 0.0;   ///< dissipated by the viscous force in this step, J/m
};

/// c = 2 beta sqrt(k_n m_eff) of a contact, N s/m2.
inline double contact_damping(const ContactLaw& law, double effective_mass) {
  return 2.0 * law.viscous_rate * std::sqrt(law.normal_stiffness * effective_mass);
}

/// Contact force at `overlap` > 0 (m) with relative velocities v_n (separating positive) and v_t (m/s) held over the
/// step dt: f_n = max(0, k_n overlap - c v_n), Coulomb limit mu f_n on the tangential spring. Dissipation is the mean
/// of the forces at both ends of the step times the displacement in it, which is what the integrator's kicks take out.
inline ContactForce contact_force(const ContactLaw& law, double overlap, double v_n, double v_t, double effective_mass,
                                  double dt, ContactHistory& history) {
  const double elastic = law.normal_stiffness * overlap;
  const double damping = contact_damping(law, effective_mass);
  ContactForce force;
  force.normal = std::max(0.0, elastic - damping * v_n);
  const double viscous_force = force.normal - elastic;
  force.viscous = -0.5 * (history.viscous_force + viscous_force) * v_n * dt;
  history.viscous_force = viscous_force;

  const double before = law.tangential_stiffness * history.shear;
  const double trial = history.shear + v_t * dt;
  const double limit = law.friction_coefficient * force.normal;
  force.shear = std::clamp(law.tangential_stiffness * trial, -limit, limit);
  const double shear = law.tangential_stiffness > 0.0 ? force.shear / law.tangential_stiffness : 0.0;
  force.friction = 0.5 * (before + force.shear) * (trial - shear);
  history.shear = shear;
  return force;
}

/// What is lost when a contact opens: the rest of the tangential spring with the last half step of its work (friction),
/// and the last half step of the viscous work.
inline ContactForce contact_opening(const ContactLaw& law, double v_n, double v_t, double dt, ContactHistory& history) {
  ContactForce lost;
  lost.friction = 0.5 * law.tangential_stiffness * history.shear * (history.shear + v_t * dt);
  lost.viscous = -0.5 * history.viscous_force * v_n * dt;
  history = {};
  return lost;
}

/// Factor on the critical displacements: material.strength, and that of this disc size (docs/user/theory.md,
/// "Resolution").
double threshold_factor(const MaterialOptions& material, double mean_diameter);

/// The law of a design's material at grade 1 (grade.h) for this disc size.
BondLaw make_bond_law(const MaterialOptions& material, double mean_diameter);
ContactLaw make_contact_law(const MaterialOptions& material);

}  // namespace perfora::solver
