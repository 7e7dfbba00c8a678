// What is here: Bond and contact laws against closed forms (paper, Fig. 3; docs/user/theory.md, "Bonds"). Numbers
// expected are worked out by hand from the formulas in the comments.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/laws.h"
#include "tests/solver/sample_packings.h"

namespace perfora::solver {
namespace {

BondLaw table1_law() {
  BondLaw law;
  law.normal_stiffness = 2.195e7;
  law.tangential_stiffness = 8.246e6;
  law.inverse_critical_normal = 1.0 / 1.529e-6;
  law.inverse_critical_shear = 1.0 / 7.7996e-6;
  law.twice_alpha = 8;
  law.rupture_delay = 1.1;
  return law;
}

TEST(BondLaw, HalfIntegerPowers) {
  for (int twice = 2; twice <= 32; ++twice)
    for (const double base : {0.0, 0.3, 1.0, 1.7})
      EXPECT_NEAR(half_integer_power(base, twice), std::pow(base, 0.5 * twice),
                  1e-14 * std::pow(base, 0.5 * twice) + 1e-300);
}

// Pure tension: phi(zeta) = delta_n/(zeta delta_n0) - 1, so zeta = delta_n/delta_n0 and D = (zeta - 1)/(zeta_max - 1).
TEST(BondLaw, PureTensionDamageIsLinearInStretch) {
  const BondLaw law = table1_law();
  for (const double strength : {0.5, 1.0, 1.7})
    for (const double zeta : {1.01, 1.05, 1.0999}) {
      const double stretch = zeta * 1.529e-6 * strength;
      EXPECT_NEAR(updated_damage(law, stretch, 0.0, strength, 0.0), (zeta - 1.0) / 0.1, 1e-10);
    }
  EXPECT_EQ(updated_damage(law, 0.999 * 1.529e-6, 0.0, 1.0, 0.0), 0.0);
  EXPECT_EQ(updated_damage(law, 1.1001 * 1.529e-6, 0.0, 1.0, 0.0), 1.0);
}

// Pure shear: phi = (delta_t/(zeta delta_t0))^4 - 1, the same zeta for any alpha.
TEST(BondLaw, PureShearDamage) {
  for (const int twice_alpha : {2, 5, 8, 9}) {
    BondLaw law = table1_law();
    law.twice_alpha = twice_alpha;
    EXPECT_NEAR(updated_damage(law, 0.0, 1.04 * 7.7996e-6, 1.0, 0.0), 0.4, 1e-9);
    EXPECT_NEAR(updated_damage(law, 0.0, -1.04 * 7.7996e-6, 1.0, 0.0), 0.4, 1e-9);
    EXPECT_EQ(updated_damage(law, 0.0, -1.1001 * 7.7996e-6, 1.0, 0.0), 1.0);
  }
}

// Compression-shear and mixed: with alpha = 1 the root is linear, zeta = delta_n/delta_n0 + |delta_t|/delta_t0;
// with alpha = 2, s = 1/zeta solves (b s)^2 + a s - 1 = 0: s = (-a + sqrt(a^2 + 4 b^2))/(2 b^2).
TEST(BondLaw, MixedModesAgainstTheQuadraticFormula) {
  BondLaw law = table1_law();
  test::Uniform u(3);
  for (int k = 0; k < 2000; ++k) {
    const double angle = u(-1.5, 1.5), size = u(1.0, 1.3);
    double a = size * std::sin(angle), b = size * std::cos(angle) * u(0.8, 1.6);
    for (const int alpha : {1, 2}) {
      law.twice_alpha = 2 * alpha;
      const double zeta = alpha == 1 ? a + b : 2.0 * b * b / (-a + std::sqrt(a * a + 4.0 * b * b));
      if (zeta > 1.0 + 1e-9 && zeta < 1.1 - 1e-9) {
        EXPECT_NEAR(updated_damage(law, a * 1.529e-6, b * 7.7996e-6, 1.0, 0.0), (zeta - 1.0) / 0.1, 1e-8)
            << a << " " << b << " " << alpha;
      }
      if (zeta < 1.0 - 1e-9) {
        EXPECT_EQ(updated_damage(law, a * 1.529e-6, b * 7.7996e-6, 1.0, 0.0), 0.0);
      }
      if (zeta > 1.1 + 1e-9) {
        EXPECT_EQ(updated_damage(law, a * 1.529e-6, b * 7.7996e-6, 1.0, 0.0), 1.0);
      }
    }
  }
}

// alpha = 4: the damage found must put the point on the yield surface, phi(zeta(D)) = 0. Newton's quadratic convergence
// leaves rounding only.
TEST(BondLaw, RootSitsOnTheYieldSurface) {
  for (const DamageForm form : {DamageForm::linear_damage, DamageForm::linear_force}) {
    BondLaw law = table1_law();
    law.damage_form = form;
    law.rupture_delay = 2.0;
    test::Uniform u(5);
    int damaged = 0;
    for (int k = 0; k < 5000; ++k) {
      const double n = u(-4.0, 2.0) * 1.529e-6, t = u(-2.5, 2.5) * 7.7996e-6, strength = u(0.3, 1.9);
      const double d = updated_damage(law, n, t, strength, 0.0);
      if (d <= 0.0 || d >= 1.0) continue;
      ++damaged;
      EXPECT_NEAR(bond_yield(law, n, t, strength, 1.0 / zeta_of_damage(law, d)), 0.0, 1e-9);
      EXPECT_EQ(updated_damage(law, n, t, strength, std::min(1.0, d + 1e-6)),
                std::min(1.0, d + 1e-6));  // never decreases
    }
    EXPECT_GT(damaged, 500);
  }
}

// Forms of damage: linear_damage D = (zeta-1)/(zeta_max-1); linear_force D = zeta_max (zeta-1)/((zeta_max-1) zeta), for
// which the force in pure tension f = k (1-D) zeta delta0 = k delta0 (zeta_max - zeta)/(zeta_max - 1) falls linearly
// from k delta0 to 0.
TEST(BondLaw, LinearForceFallsLinearly) {
  BondLaw law = table1_law();
  law.rupture_delay = 1.5;
  law.damage_form = DamageForm::linear_force;
  const double f0 = 2.195e7 * 1.529e-6;
  for (const double zeta : {1.0001, 1.1, 1.3, 1.49}) {
    const double stretch = zeta * 1.529e-6;
    const double d = updated_damage(law, stretch, 0.0, 1.0, 0.0);
    EXPECT_NEAR(bond_force(law, {stretch, 0.0, 0.0}, d).normal, f0 * (1.5 - zeta) / 0.5, 1e-8 * f0);
    EXPECT_NEAR(zeta_of_damage(law, damage_of_zeta(law, zeta)), zeta, 1e-14);
  }
}

TEST(BondLaw, NoDelayBreaksAtOnce) {
  BondLaw law = table1_law();
  law.rupture_delay = 1.0;
  EXPECT_EQ(updated_damage(law, 1.0000001 * 1.529e-6, 0.0, 1.0, 0.0), 1.0);
  EXPECT_EQ(updated_damage(law, 0.9999999 * 1.529e-6, 0.0, 1.0, 0.0), 0.0);
}

// Unloading keeps D and goes straight to the origin with slope k_n (1-D); reloading follows the same line until
// zeta(D).
TEST(BondLaw, UnloadingAndReloadingAreSecant) {
  const BondLaw law = table1_law();
  const double reached = 1.06 * 1.529e-6;
  const double d = updated_damage(law, reached, 0.0, 1.0, 0.0);
  for (const double fraction : {0.9, 0.5, 0.1, 0.0, 0.7, 0.999999}) {
    EXPECT_EQ(updated_damage(law, fraction * reached, 0.0, 1.0, d), d);
    EXPECT_NEAR(bond_force(law, {fraction * reached, 0.0, 0.0}, d).normal, 2.195e7 * (1.0 - d) * fraction * reached,
                1e-12);
  }
  EXPECT_GT(updated_damage(law, 1.0001 * reached, 0.0, 1.0, d), d);
  // Damage does not weaken compression by default; with `full` it does, and the contact spring grows instead.
  EXPECT_DOUBLE_EQ(bond_force(law, {-1e-6, 0.0, 0.0}, d).normal, -2.195e7 * 1e-6);
  BondLaw full = law;
  full.damage_in_compression = DamageInCompression::full;
  EXPECT_DOUBLE_EQ(bond_force(full, {-1e-6, 0.0, 0.0}, d).normal, -2.195e7 * (1.0 - d) * 1e-6);
  EXPECT_NEAR(bond_force(full, {-1e-6, 0.0, 1e-6}, d).normal, -2.195e7 * 1e-6, 1e-9);
}

// Force = -dU/d(displacement) by central differences, for every option; error of the difference h^2 f'''/6 = 0 for a
// quadratic, rounding ~ eps U/h.
TEST(BondLaw, ForceIsTheDerivativeOfTheEnergy) {
  test::Uniform u(11);
  for (const DamageInCompression mode : {DamageInCompression::none, DamageInCompression::full}) {
    BondLaw law = table1_law();
    law.damage_in_compression = mode;
    for (int k = 0; k < 500; ++k) {
      const double d = u(0.0, 1.0), n = u(-3e-6, 3e-6), t = u(-9e-6, 9e-6), h = 1e-10;
      if (std::fabs(n) < 2 * h) continue;
      const double touch_gap = u(-2e-6, 2e-6);  // overlap = touch - length = touch_gap - delta_n
      const auto energy = [&](double dn, double dt) {
        return bond_energy(law, {dn, dt, std::max(0.0, touch_gap - dn)}, d);
      };
      if (std::fabs(touch_gap - n) < 2 * h) continue;
      const BondForce f = bond_force(law, {n, t, std::max(0.0, touch_gap - n)}, d);
      EXPECT_NEAR((energy(n + h, t) - energy(n - h, t)) / (2 * h), f.normal, 1e-3);  // |f| up to 66 N/m
      EXPECT_NEAR((energy(n, t + h) - energy(n, t - h)) / (2 * h), f.shear, 1e-3);
    }
  }
}

// -dU/dD = U0 at fixed displacements, both options.
TEST(BondLaw, DamageTakesItsShareOfTheEnergy) {
  test::Uniform u(12);
  for (const DamageInCompression mode : {DamageInCompression::none, DamageInCompression::full}) {
    BondLaw law = table1_law();
    law.damage_in_compression = mode;
    for (int k = 0; k < 200; ++k) {
      const BondPoint p{u(-3e-6, 3e-6), u(-9e-6, 9e-6), u(0.0, 2e-6)};
      const double lost = bond_energy(law, p, 0.2) - bond_energy(law, p, 0.7);
      EXPECT_NEAR(lost, 0.5 * damageable_energy(law, p, p), 1e-12 * 1e-3);
    }
  }
}

// A break in compression and shear always releases energy: U before >= energy of the contact that follows, touching at
// min(R_i + R_j, l0) (docs/user/theory.md, "Contacts").
TEST(BondLaw, CompressionShearBreakReleasesEnergy) {
  const BondLaw law = table1_law();
  test::Uniform u(13);
  for (int k = 0; k < 5000; ++k) {
    const double l0 = u(0.4e-3, 1.5e-3), contact = u(0.4e-3, 1.0e-3), compression = u(0.0, 5e-6);
    const double length = l0 - compression, contact_distance = std::min(contact, l0);
    const double overlap = std::max(0.0, contact_distance - length);
    const BondPoint p{-compression, u(-1e-5, 1e-5), overlap};
    const double before = bond_energy(law, p, 0.3), after = 0.5 * law.normal_stiffness * overlap * overlap;
    EXPECT_GE(before - after, -1e-18);
    EXPECT_GE(damageable_energy(law, p, p) + compression_release(law, p, p, l0 <= contact), 0.0);
    EXPECT_NEAR(0.7 * damageable_energy(law, p, p) + compression_release(law, p, p, l0 <= contact), before - after,
                1e-15);
  }
}

// Rotating both discs by the same angle turns e with them; |r| held: delta_t = |r| sin(angle of r against e) (pure
// shear of the closed form).
TEST(BondKinematics, BothDiscsRotated) {
  const double l0 = 1e-3;
  for (const double theta : {0.0, 1e-3, -0.02, 0.4}) {
    const BondKinematics k = bond_kinematics(l0, 0.0, 1.0, 0.0, l0, std::cos(theta), std::sin(theta));
    EXPECT_NEAR(k.delta_t, -l0 * std::sin(theta), 1e-18);
    EXPECT_NEAR(k.delta_n, 0.0, 1e-18);
    EXPECT_NEAR(k.along, l0 * std::cos(theta), 1e-18);
  }
}

// Contact law: Coulomb limit, cut-off at zero force, spring reset, hand numbers.
TEST(ContactLaw, LimitsAndDissipation) {
  const ContactLaw law{2e7, 8e6, 0.4, 0.9};
  ContactHistory history;
  const double mass = 0.002, dt = 1e-6;
  ContactForce f = contact_force(law, 1e-6, 0.0, 0.0, mass, dt, history);
  EXPECT_DOUBLE_EQ(f.normal, 20.0);
  EXPECT_DOUBLE_EQ(f.shear, 0.0);
  // Fast separation: damping larger than the spring gives no attraction.
  f = contact_force(law, 1e-6, 10.0, 0.0, mass, dt, history);
  EXPECT_DOUBLE_EQ(f.normal, 0.0);
  history = {};
  // Sliding: v_t dt = 1e-5 m would give 80 N, the limit is 0.4 x 20 = 8 N at xi = 1e-6; slip 9e-6 under the mean force
  // 4 N: 3.6e-5 J.
  f = contact_force(law, 1e-6, 0.0, 10.0, mass, dt, history);
  EXPECT_DOUBLE_EQ(f.shear, 8.0);
  EXPECT_NEAR(history.shear, 1e-6, 1e-18);
  EXPECT_NEAR(f.friction, 4.0 * 9e-6, 1e-15);
  // Opening loses what the spring holds, k_t xi^2/2 = 4e-6 J, and half a step of its force: k_t xi v_t dt/2 = 4e-6 J.
  const ContactForce lost = contact_opening(law, 0.0, 1.0, dt, history);
  EXPECT_NEAR(lost.friction, 8e-6, 1e-18);
  EXPECT_EQ(history.shear, 0.0);
}

}  // namespace
}  // namespace perfora::solver
