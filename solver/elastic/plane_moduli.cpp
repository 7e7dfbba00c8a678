// What is here: engineering constants of a plane stiffness (docs/user/theory.md, "Elastic response"). What is not: how
// the stiffness is found (elastic.cpp).
#include "solver/elastic/plane_moduli.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace perfora::solver {
namespace {

/// One stress component alone, of strain 1: its modulus and the two other strains it brings, in Voigt's order.
struct Uniaxial {
  double modulus = 0.0;
  std::array<double, 2> other{};
};

Uniaxial uniaxial(const PlaneStiffness& c, std::size_t k) {
  const std::size_t a = k == 0 ? 1 : 0, b = k == 2 ? 1 : 2;
  Eigen::Matrix2d others;
  others << c[a][a], c[a][b], c[b][a], c[b][b];
  const Eigen::Vector2d coupling(c[a][k], c[b][k]);
  // Least squares: a direction that carries nothing is left out.
  const Eigen::Vector2d strain = -others.completeOrthogonalDecomposition().solve(coupling);
  return {c[k][k] + strain(0) * c[k][a] + strain(1) * c[k][b], {strain(0), strain(1)}};
}

void read_isotropic(const PlaneStiffness& c, PlaneModuli& m) {
  const double bulk = 0.25 * (c[0][0] + c[1][1] + 2.0 * c[0][1]);
  const double shear = 0.125 * (c[0][0] + c[1][1] - 2.0 * c[0][1] + 4.0 * c[2][2]);
  const auto square = [](double x) { return x * x; };
  // Kelvin's notation: components with one shear index times sqrt(2), with two times 2; off-diagonal ones count twice.
  const auto norm = [&](double xx, double yy, double xy, double ss, double xs, double ys) {
    return std::sqrt(square(xx) + square(yy) + 2.0 * square(xy) + square(2.0 * ss) + 4.0 * (square(xs) + square(ys)));
  };
  m.isotropic_bulk = bulk;
  m.isotropic_shear = shear;
  m.isotropic_young = 4.0 * bulk * shear / (bulk + shear);
  m.isotropic_poisson = (bulk - shear) / (bulk + shear);
  m.anisotropy =
      norm(c[0][0] - bulk - shear, c[1][1] - bulk - shear, c[0][1] - bulk + shear, c[2][2] - shear, c[0][2], c[1][2]) /
      norm(c[0][0], c[1][1], c[0][1], c[2][2], c[0][2], c[1][2]);
  m.plane_strain_poisson = plane_strain_poisson_ratio(m.isotropic_poisson);
  m.plane_strain_young = plane_strain_young_modulus(m.isotropic_young, m.isotropic_poisson);
}

}  // namespace

double plane_strain_poisson_ratio(double two_dimensional) {
  return two_dimensional / (1.0 + two_dimensional);
}

double plane_strain_young_modulus(double two_dimensional, double two_dimensional_poisson) {
  const double nu = plane_strain_poisson_ratio(two_dimensional_poisson);
  return two_dimensional * (1.0 - nu * nu);
}

PlaneModuli plane_moduli(const PlaneStiffness& stiffness) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  PlaneModuli m;
  const Uniaxial x = uniaxial(stiffness, 0), y = uniaxial(stiffness, 1), shear = uniaxial(stiffness, 2);
  m.young_x = x.modulus;
  m.young_y = y.modulus;
  m.poisson_xy = stiffness[0][0] > 0.0 ? -x.other[0] : none;
  m.poisson_yx = stiffness[1][1] > 0.0 ? -y.other[0] : none;
  m.shear_modulus = shear.modulus;
  read_isotropic(stiffness, m);
  return m;
}

}  // namespace perfora::solver
