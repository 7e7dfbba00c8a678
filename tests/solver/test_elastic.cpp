// What is here: the linear elastic response against closed forms: triangular lattice, Voigt's bound, rotation of the
// frame, singular networks. What is not: agreement with the time-stepping solver (test_elastic_against_solver.cpp).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "solver/elastic/elastic.h"
#include "solver/elastic/first_yield.h"
#include "tests/solver/sample_packings.h"

namespace perfora::solver {
namespace {

constexpr double k_n = 2.195e7, k_t = 8.246e6;  // Table 1

void add_bond(BondNetwork& network, std::int32_t i, std::int32_t j, double length, double angle) {
  network.i.push_back(i);
  network.j.push_back(j);
  network.reference_length.push_back(length);
  network.direction_x.push_back(std::cos(angle));
  network.direction_y.push_back(std::sin(angle));
  network.strength.push_back(1.0);
  network.damage.push_back(0.0);
  network.state.push_back(BondState::intact);
}

/// Regular triangular lattice of n x n discs (n even) at distance `pitch`, nearest neighbours bonded.
BondNetwork triangular_lattice(std::int32_t n, double pitch) {
  BondNetwork network;
  constexpr double sixth = std::numbers::pi / 3.0;
  const auto disc = [n](std::int32_t row, std::int32_t column) { return (row % n) * n + (column + n) % n; };
  for (std::int32_t r = 0; r < n; ++r)
    for (std::int32_t c = 0; c < n; ++c) {
      const std::int32_t right = c + r % 2;  // odd rows are shifted by half a pitch to the right
      add_bond(network, disc(r, c), disc(r, c + 1), pitch, 0.0);
      add_bond(network, disc(r, c), disc(r + 1, right), pitch, sixth);
      add_bond(network, disc(r, c), disc(r + 1, right - 1), pitch, 2.0 * sixth);
    }
  return network;
}

BondNetwork random_network(const geometry::Packing& packing) {
  return make_bond_network(packing, test::no_holes(packing), MaterialOptions{}, NoiseOptions{}, 1, 0.5e-3);
}

/// Seen from a frame turned by -angle: every direction turns by angle.
BondNetwork turned(BondNetwork network, double angle) {
  for (std::size_t b = 0; b < network.i.size(); ++b) {
    const double x = network.direction_x[b], y = network.direction_y[b];
    network.direction_x[b] = std::cos(angle) * x - std::sin(angle) * y;
    network.direction_y[b] = std::sin(angle) * x + std::cos(angle) * y;
  }
  return network;
}

/// Stress of a strain, both as (xx, yy, xy) with engineering shear.
std::array<double, 3> times(const PlaneStiffness& c, const std::array<double, 3>& strain) {
  std::array<double, 3> stress{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) stress[a] += c[a][b] * strain[b];
  return stress;
}

/// Twice the work of a strain, a number that no frame changes.
double twice_work(const PlaneStiffness& c, const std::array<double, 3>& strain) {
  const auto stress = times(c, strain);
  return stress[0] * strain[0] + stress[1] * strain[1] + stress[2] * strain[2];
}

// Every disc is a centre of symmetry and each direction class is strained alike, so the lattice deforms affinely
// without rotations and Voigt's sum is exact: with three bonds of length a and area sqrt(3)/2 a^2 a disc, C11 =
// sqrt(3)/4 (3 k_n
// + k_t), C12 = sqrt(3)/4 (k_n - k_t), G = sqrt(3)/4 (k_n + k_t); isotropic, so nu2 = C12/C11 and E2 = C11 (1 - nu2^2).
// Tolerance: rounding of sums of a thousand terms.
TEST(ElasticResponse, TriangularLatticeInClosedForm) {
  constexpr std::int32_t n = 12;
  constexpr double pitch = 0.7e-3, rounding = 1e-12;
  const double width = n * pitch, height = n * pitch * std::sqrt(3.0) / 2.0;
  for (const double ratio : {0.0, 0.3757, 1.0}) {
    const ElasticResponse r = elastic_response(triangular_lattice(n, pitch), n * n, width, height, k_n, ratio * k_n);
    const double unit = std::sqrt(3.0) / 4.0 * k_n;
    const double c11 = unit * (3.0 + ratio), c12 = unit * (1.0 - ratio), nu = c12 / c11;
    EXPECT_EQ(r.status, ElasticStatus::converged);
    const PlaneStiffness expected = {{{c11, c12, 0.0}, {c12, c11, 0.0}, {0.0, 0.0, unit * (1.0 + ratio)}}};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) {
        EXPECT_NEAR(r.stiffness[a][b], expected[a][b], rounding * c11) << a << b;
        EXPECT_NEAR(r.affine_stiffness[a][b], expected[a][b], rounding * c11) << a << b;
      }
    for (const double young : {r.moduli.young_x, r.moduli.young_y, r.moduli.isotropic_young})
      EXPECT_NEAR(young, c11 * (1.0 - nu * nu), 10.0 * rounding * c11);
    EXPECT_NEAR(r.moduli.poisson_xy, nu, 10.0 * rounding);
    EXPECT_NEAR(r.moduli.poisson_yx, nu, 10.0 * rounding);
    EXPECT_NEAR(r.moduli.shear_modulus, unit * (1.0 + ratio), 10.0 * rounding * c11);
    EXPECT_NEAR(r.moduli.anisotropy, 0.0, 10.0 * rounding);
    for (const auto& u : r.displacement)
      for (const double value : u) EXPECT_NEAR(value, 0.0, 1e-9);
  }
}

// Plane strain of a solid with E = 30 GPa, nu = 0.2: K = lambda + G and G with Lame's constants (any textbook).
TEST(ElasticResponse, PlaneStrainReading) {
  constexpr double young = 30e9, nu = 0.2;
  const double lambda = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), g = young / (2.0 * (1.0 + nu));
  const PlaneModuli m =
      plane_moduli({{{lambda + 2.0 * g, lambda, 0.0}, {lambda, lambda + 2.0 * g, 0.0}, {0.0, 0.0, g}}});
  EXPECT_NEAR(m.plane_strain_young, young, 1e-12 * young);
  EXPECT_NEAR(m.plane_strain_poisson, nu, 1e-12);
  EXPECT_NEAR(m.shear_modulus, g, 1e-12 * young);
  EXPECT_NEAR(m.poisson_xy, nu / (1.0 - nu), 1e-12);
}

// An orthotropic sheet in closed form: S11 = 1/E_x, S12 = -nu_xy/E_x, so C = [E_x, nu_yx E_x; ., E_y]/(1 - nu_xy
// nu_yx).
TEST(ElasticResponse, OrthotropicModuli) {
  constexpr double young_x = 4e9, young_y = 1e9, nu_xy = 0.4, nu_yx = nu_xy * young_y / young_x, g = 0.7e9;
  constexpr double fraction = 1.0 / (1.0 - nu_xy * nu_yx);
  const PlaneModuli m = plane_moduli({{{fraction * young_x, fraction * nu_yx * young_x, 0.0},
                                       {fraction * nu_yx * young_x, fraction * young_y, 0.0},
                                       {0.0, 0.0, g}}});
  EXPECT_NEAR(m.young_x, young_x, 1e-12 * young_x);
  EXPECT_NEAR(m.young_y, young_y, 1e-12 * young_x);
  EXPECT_NEAR(m.poisson_xy, nu_xy, 1e-12);
  EXPECT_NEAR(m.poisson_yx, nu_yx, 1e-12);
  EXPECT_NEAR(m.shear_modulus, g, 1e-12 * young_x);
  EXPECT_GT(m.anisotropy, 0.1);
}

// Maxwell-Betti: C is symmetric (to the square root of the residual at worst; 1e-8 is far above it). Voigt's bound: no
// strain takes more work than its affine motion, so C_affine - C is positive: checked for many strains.
TEST(ElasticResponse, SymmetricAndBelowVoigt) {
  const geometry::Packing packing = test::jittered_packing(30, 0.5e-3, 3);
  const ElasticResponse r =
      elastic_response(random_network(packing), packing.size(), packing.width, packing.height, k_n, k_t);
  EXPECT_EQ(r.status, ElasticStatus::converged);
  EXPECT_LE(r.residual, 1e-10);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_NEAR(r.stiffness[a][b], r.stiffness[b][a], 1e-8 * r.stiffness[0][0]);
  test::Uniform u(5);
  for (int k = 0; k < 100; ++k) {
    const std::array<double, 3> strain = {u(-1.0, 1.0), u(-1.0, 1.0), u(-1.0, 1.0)};
    EXPECT_LT(twice_work(r.stiffness, strain), twice_work(r.affine_stiffness, strain));
    EXPECT_GT(twice_work(r.stiffness, strain), 0.0);
  }
}

// Objectivity: turning the whole network, cell and all, turns the stiffness as a tensor of fourth order, so the work of
// the turned strain is the same. Tolerance: the square of the residual is far below it, what is left is rounding.
TEST(ElasticResponse, TurnsWithTheFrame) {
  const geometry::Packing packing = test::jittered_packing(20, 0.5e-3, 8);
  const BondNetwork network = random_network(packing);
  const auto answer = [&](const BondNetwork& of) {
    return elastic_response(of, packing.size(), packing.width, packing.height, k_n, k_t);
  };
  const ElasticResponse straight = answer(network);
  test::Uniform u(6);
  for (const double angle : {0.5 * std::numbers::pi, 0.3, 2.0}) {
    const ElasticResponse r = answer(turned(network, angle));
    const double c = std::cos(angle), s = std::sin(angle);
    for (int k = 0; k < 20; ++k) {
      const double xx = u(-1.0, 1.0), yy = u(-1.0, 1.0), xy = u(-1.0, 1.0);  // xy: the tensor's component
      const std::array<double, 3> of_turned = {c * c * xx + s * s * yy - 2.0 * c * s * xy,
                                               s * s * xx + c * c * yy + 2.0 * c * s * xy,
                                               2.0 * (c * s * (xx - yy) + (c * c - s * s) * xy)};
      EXPECT_NEAR(twice_work(r.stiffness, of_turned), twice_work(straight.stiffness, {xx, yy, 2.0 * xy}),
                  1e-8 * straight.stiffness[0][0]);
    }
    EXPECT_NEAR(r.moduli.anisotropy, straight.moduli.anisotropy, 1e-8);
    EXPECT_NEAR(r.moduli.isotropic_young, straight.moduli.isotropic_young, 1e-8 * straight.moduli.isotropic_young);
  }
}

// A cluster that spans no boundary yields to every strain: no stress. What hangs loose beside a spanning network (a
// disc without bonds, a disc on one bond, a pair, a triangle) carries nothing and changes nothing but the solution's
// last bits.
TEST(ElasticResponse, LooseDiscsAndFragmentsDoNoHarm) {
  const geometry::Packing cluster = test::cluster_packing(8, 0.5e-3, 2);
  const ElasticResponse alone =
      elastic_response(random_network(cluster), cluster.size(), cluster.width, cluster.height, k_n, k_t);
  EXPECT_EQ(alone.status, ElasticStatus::converged);
  EXPECT_NEAR(alone.stiffness[0][0] / alone.affine_stiffness[0][0], 0.0, 1e-9);

  const geometry::Packing packing = test::jittered_packing(20, 0.5e-3, 4);
  const std::int32_t n = packing.size();
  BondNetwork network = random_network(packing);
  const ElasticResponse whole = elastic_response(network, n, packing.width, packing.height, k_n, k_t);
  add_bond(network, 5, n + 1, 0.6e-3, 0.4);      // hangs on one bond; disc n has none
  add_bond(network, n + 2, n + 3, 0.6e-3, 1.0);  // a pair
  for (const auto& [i, j, angle] : {std::tuple{4, 5, 0.0}, std::tuple{5, 6, 2.0944}, std::tuple{4, 6, 1.0472}})
    add_bond(network, n + i, n + j, 0.5e-3, angle);
  const ElasticResponse loose = elastic_response(network, n + 7, packing.width, packing.height, k_n, k_t);
  EXPECT_EQ(loose.status, ElasticStatus::converged);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      EXPECT_NEAR(loose.stiffness[a][b], whole.stiffness[a][b], 1e-8 * whole.stiffness[0][0]);
  for (const auto& u : loose.displacement)
    for (const double value : u) EXPECT_TRUE(std::isfinite(value));
}

TEST(ElasticResponse, BrokenBondsDoNotCount) {
  const geometry::Packing packing = test::jittered_packing(16, 0.5e-3, 4);
  BondNetwork network = random_network(packing), fewer;
  for (std::size_t b = 0; b < network.i.size(); ++b)
    if (b % 7 == 0)
      network.state[b] = b % 2 ? BondState::broken : BondState::compacted;
    else
      add_bond(fewer, network.i[b], network.j[b], network.reference_length[b],
               std::atan2(network.direction_y[b], network.direction_x[b]));
  const auto answer = [&](const BondNetwork& of) {
    return elastic_response(of, packing.size(), packing.width, packing.height, MaterialOptions{});
  };
  EXPECT_EQ(answer(network).bonds, fewer.size());
  EXPECT_NEAR(answer(network).stiffness[1][1], answer(fewer).stiffness[1][1], 1e-9 * answer(fewer).stiffness[1][1]);
}

TEST(ElasticResponse, NoBondsAndTooFewIterations) {
  const ElasticResponse none = elastic_response(BondNetwork{}, 5, 1e-2, 1e-2, k_n, k_t);
  EXPECT_EQ(none.status, ElasticStatus::converged);
  EXPECT_EQ(none.stiffness[0][0], 0.0);
  EXPECT_TRUE(std::isnan(none.moduli.poisson_xy));
  EXPECT_EQ(none.displacement[0].size(), 15u);

  const geometry::Packing packing = test::jittered_packing(20, 0.5e-3, 4);
  ElasticOptions options;
  options.most_iterations = 2;
  const ElasticResponse r =
      elastic_response(random_network(packing), packing.size(), packing.width, packing.height, k_n, k_t, options);
  EXPECT_EQ(r.status, ElasticStatus::not_converged);
  EXPECT_EQ(r.iterations, 2);
  EXPECT_GT(r.residual, options.tolerance);
}

/// yield_load_factor for the terms a and b per unit of load and an exponent.
double yield_factor(double a, double b, int twice_alpha) {
  BondLaw law;
  law.inverse_critical_normal = law.inverse_critical_shear = 1.0;
  law.twice_alpha = twice_alpha;
  return yield_load_factor(law, a, b, 1.0);
}

// Roots in closed form: tension alone, shear alone, alpha = 1 (a + b = 1/s), alpha = 2 (a quadratic); none where
// nothing grows. Then alpha = 4 for many (a, b): the root is on the yield surface and below it the bond is inside.
TEST(FirstYield, FactorOfOneBond) {
  constexpr double rounding = 1e-13;
  EXPECT_NEAR(yield_factor(250.0, 0.0, 8), 1.0 / 250.0, rounding);
  EXPECT_NEAR(yield_factor(0.0, 40.0, 8), 1.0 / 40.0, rounding);
  EXPECT_NEAR(yield_factor(250.0, 1e-15, 8), 1.0 / 250.0, rounding);  // shear that is only rounding
  EXPECT_NEAR(yield_factor(30.0, 10.0, 2), 1.0 / 40.0, rounding);
  EXPECT_NEAR(yield_factor(-6.0, 10.0, 2), 1.0 / 4.0, rounding);
  for (const double a : {-8.0, -0.1, 0.3, 20.0})
    EXPECT_NEAR(yield_factor(a, 3.0, 4), (-a + std::sqrt(a * a + 36.0)) / 18.0, rounding);
  EXPECT_EQ(yield_factor(-5.0, 0.0, 8), std::numeric_limits<double>::infinity());
  EXPECT_EQ(yield_factor(0.0, 0.0, 8), std::numeric_limits<double>::infinity());
  EXPECT_EQ(yield_factor(-10.0, 10.0, 2), std::numeric_limits<double>::infinity());
  test::Uniform u(9);
  BondLaw law;
  law.inverse_critical_normal = law.inverse_critical_shear = 1.0;
  for (int k = 0; k < 1000; ++k) {
    const double a = u(-1e4, 1e3), b = u(0.0, 1e3), strength = u(0.3, 2.0);
    const double s = yield_factor(a / strength, b / strength, law.twice_alpha);
    EXPECT_NEAR(bond_yield(law, a * s, b * s, strength, 1.0), 0.0, 1e-9);
    EXPECT_LT(bond_yield(law, a * s * (1.0 - 1e-6), b * s * (1.0 - 1e-6), strength, 1.0), 0.0);
  }
}

// The lattice again: under E_yy = -s a bond at 60 degrees gets delta_n = -3/4 l s and |delta_t| = sqrt(3)/4 l s, a
// level one nothing. With alpha = 2 the root is that of a quadratic; the weakest bond's factor on both thresholds
// scales it.
TEST(FirstYield, TriangularLattice) {
  constexpr std::int32_t n = 8;
  constexpr double pitch = 0.7e-3, weak = 0.8;
  BondNetwork network = triangular_lattice(n, pitch);
  network.strength[7] = weak;  // bonds come in threes: level, 60, 120 degrees
  const ElasticResponse r = elastic_response(network, n * n, n * pitch, n * pitch * std::sqrt(3.0) / 2.0, k_n, k_t);
  MaterialOptions material;
  material.yield_exponent = 2.0;
  material.threshold_scaling = ThresholdScaling::none;
  const FirstYield y = first_yield(network, r, make_bond_law(material, 0.5e-3));
  const double a = -0.75 * pitch / material.critical_normal_displacement,
               b = std::sqrt(3.0) / 4.0 * pitch / material.critical_shear_displacement;
  const double strain = (-a + std::sqrt(a * a + 4.0 * b * b)) / (2.0 * b * b);
  EXPECT_NEAR(y.strain, weak * strain, 1e-9 * strain);
  EXPECT_NEAR(y.stress, weak * strain * r.stiffness[1][1], 1e-9 * y.stress);
  EXPECT_NEAR(y.lateral_stress, weak * strain * r.stiffness[0][1], 1e-9 * y.stress);
  ASSERT_EQ(y.first_bonds.size(), 1u);
  EXPECT_EQ(y.first_bonds[0].bond, 7);
  EXPECT_EQ(y.first_bonds[0].mode, results::BreakMode::shear);
  for (std::int32_t d = 0; d < n * n; ++d) {
    const bool on_weak_bond = d == network.i[7] || d == network.j[7];
    EXPECT_NEAR(y.disc_strain[static_cast<std::size_t>(d)], (on_weak_bond ? weak : 1.0) * strain, 1e-9 * strain);
  }
}

// A cluster that spans no boundary is never strained.
TEST(FirstYield, NothingYieldsWhereNothingIsCarried) {
  const geometry::Packing cluster = test::cluster_packing(8, 0.5e-3, 2);
  const BondNetwork network = random_network(cluster);
  const ElasticResponse r = elastic_response(network, cluster.size(), cluster.width, cluster.height, k_n, k_t);
  const FirstYield y = first_yield(network, r, make_bond_law(MaterialOptions{}, 0.5e-3));
  EXPECT_EQ(y.strain, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(y.first_bonds.empty());
  for (const double strain : y.disc_strain) EXPECT_EQ(strain, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace perfora::solver
