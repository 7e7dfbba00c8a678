// What is here: the solution for holes in a plate by Kolosov's potentials (Muskhelishvili, "Some basic problems of the
// mathematical theory of elasticity", 1953): 2 mu (u + i v) = kappa phi - z conj(phi') - conj(psi); sxx + syy = 4 Re
// phi'; syy - sxx + 2 i sxy = 2 (conj(z) phi'' + psi'); force on an arc ~ phi + z conj(phi') + conj(psi).
#include "tests/verification/hole_array_solution.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace perfora::verification {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Nodes and weights of Gauss and Legendre on [-1/2, 1/2], by Newton on the polynomial.
struct Quadrature {
  std::vector<double> node, weight;
};

Quadrature gauss_legendre(int n) {
  Quadrature q;
  for (int k = 0; k < n; ++k) {
    double x = std::cos(pi * (k + 0.75) / (n + 0.5)), slope = 1.0;
    for (int iteration = 0; iteration < 50; ++iteration) {
      double p0 = 1.0, p1 = x;
      for (int m = 2; m <= n; ++m) {
        const double p2 = ((2.0 * m - 1.0) * x * p1 - (m - 1.0) * p0) / m;
        p0 = p1;
        p1 = p2;
      }
      slope = n * (x * p1 - p0) / (x * x - 1.0);
      const double step = p1 / slope;
      x -= step;
      if (std::fabs(step) < 1e-15) break;
    }
    q.node.push_back(0.5 * x);
    q.weight.push_back(1.0 / ((1.0 - x * x) * slope * slope));
  }
  return q;
}

/// What one potential term phi = a z^n or psi = b z^n gives at a point.
struct Field {
  Complex displacement;  ///< 2 mu (u + i v)
  Complex arc;           ///< phi + z conj(phi') + conj(psi)
  PlaneStress stress;
};

Field field_of(bool is_phi, Complex coefficient, int n, Complex z, double kappa) {
  const Complex value = coefficient * std::pow(z, n), slope = coefficient * double(n) * std::pow(z, n - 1);
  Field f;
  if (is_phi) {
    const Complex second = coefficient * double(n) * double(n - 1) * std::pow(z, n - 2);
    f.displacement = kappa * value - z * std::conj(slope);
    f.arc = value + z * std::conj(slope);
    const double trace = 4.0 * slope.real();
    const Complex deviator = 2.0 * std::conj(z) * second;
    f.stress = {0.5 * (trace - deviator.real()), 0.5 * (trace + deviator.real()), 0.5 * deviator.imag()};
  } else {
    f.displacement = -std::conj(value);
    f.arc = std::conj(value);
    const Complex deviator = 2.0 * slope;
    f.stress = {-0.5 * deviator.real(), 0.5 * deviator.real(), 0.5 * deviator.imag()};
  }
  return f;
}

}  // namespace

double HoleArray::scale(int power) const {
  const double corner = std::sqrt(0.5);
  return std::pow(power >= 0 ? 1.0 / corner : 1.0 / radius_, power);
}

HoleArray::Solution HoleArray::solve(double strain_xx, double strain_yy, double strain_xy) {
  const double shear_modulus = 0.5 / (1.0 + material_poisson_),
               kappa = (3.0 - material_poisson_) / (1.0 + material_poisson_);
  constexpr int edge_points = 60, rim_points = 120;  // twice the unknowns or so of order 41
  const Quadrature edge = gauss_legendre(edge_points);
  const int terms = static_cast<int>(powers_.size()), unknowns = 4 * terms + 2;
  const int rows = 8 * edge_points + 2 * rim_points;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, unknowns);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows);
  for (int column = 0; column < 4 * terms; ++column) {
    const int term = column / 4, power = powers_[static_cast<std::size_t>(term)];
    const bool is_phi = column % 4 < 2;
    const Complex unit = (column % 2 == 0 ? Complex(1.0, 0.0) : Complex(0.0, 1.0)) * scale(power);
    int row = 0;
    for (const double t : edge.node) {
      const Field right = field_of(is_phi, unit, power, {0.5, t}, kappa),
                  left = field_of(is_phi, unit, power, {-0.5, t}, kappa),
                  top = field_of(is_phi, unit, power, {t, 0.5}, kappa),
                  bottom = field_of(is_phi, unit, power, {t, -0.5}, kappa);
      const Complex across = right.displacement - left.displacement, up = top.displacement - bottom.displacement;
      for (const double value :
           {across.real(), across.imag(), up.real(), up.imag(), right.stress.xx - left.stress.xx,
            right.stress.xy - left.stress.xy, top.stress.yy - bottom.stress.yy, top.stress.xy - bottom.stress.xy})
        a(row++, column) = value;
    }
    for (int k = 0; k < rim_points; ++k) {
      const Complex arc = field_of(is_phi, unit, power, std::polar(radius_, 2.0 * pi * k / rim_points), kappa).arc;
      a(row++, column) = arc.real() / radius_;
      a(row++, column) = arc.imag() / radius_;
    }
  }
  for (int k = 0; k < edge_points; ++k) {
    const Eigen::Vector4d jump(strain_xx, strain_xy, strain_xy, strain_yy);
    b.segment<4>(8 * k) = 2.0 * shear_modulus * jump;
  }
  for (int k = 0; k < rim_points; ++k) {  // the arc's value on the rim is a constant, free
    a(8 * edge_points + 2 * k, 4 * terms) = 1.0;
    a(8 * edge_points + 2 * k + 1, 4 * terms + 1) = 1.0;
  }
  const Eigen::VectorXd x = a.completeOrthogonalDecomposition().solve(b);
  residual_ = std::max(residual_, (a * x - b).cwiseAbs().maxCoeff() / (2.0 * shear_modulus));
  Solution s;
  for (int term = 0; term < terms; ++term) {
    const double factor = scale(powers_[static_cast<std::size_t>(term)]);
    s.phi.push_back(factor * Complex(x[4 * term], x[4 * term + 1]));
    s.psi.push_back(factor * Complex(x[4 * term + 2], x[4 * term + 3]));
  }
  for (int k = 0; k < edge_points; ++k) {  // mean stress = mean traction on the edges
    const double t = edge.node[static_cast<std::size_t>(k)], w = edge.weight[static_cast<std::size_t>(k)];
    s.mean.xx += w * stress(s, {0.5, t}).xx;
    s.mean.yy += w * stress(s, {t, 0.5}).yy;
    s.mean.xy += w * stress(s, {0.5, t}).xy;
  }
  return s;
}

PlaneStress HoleArray::stress(const Solution& s, Complex z) const {
  PlaneStress sum;
  for (std::size_t term = 0; term < powers_.size(); ++term)
    for (const bool is_phi : {true, false}) {
      const PlaneStress f = field_of(is_phi, is_phi ? s.phi[term] : s.psi[term], powers_[term], z, 1.0).stress;
      sum.xx += f.xx;
      sum.yy += f.yy;
      sum.xy += f.xy;
    }
  return sum;
}

HoleArray::HoleArray(double radius, double poisson, int order) : radius_(radius), material_poisson_(poisson) {
  for (int n = -order; n <= order; n += 2) powers_.push_back(n);  // the field is odd under z -> -z
  const Solution x = solve(1.0, 0.0, 0.0), y = solve(0.0, 1.0, 0.0), xy = solve(0.0, 0.0, 0.5);
  const double c11 = 0.5 * (x.mean.xx + y.mean.yy), c12 = 0.5 * (x.mean.yy + y.mean.xx);
  poisson_ = c12 / c11;
  young_ = c11 - c12 * c12 / c11;
  shear_ = xy.mean.xy;
  const double s11 = 1.0 / young_, s12 = -poisson_ / young_;
  young_diagonal_ = 4.0 / (2.0 * s11 + 2.0 * s12 + 1.0 / shear_);
  // Mean stress 1 along y: strains s12, s11.
  for (std::size_t term = 0; term < powers_.size(); ++term) {
    along_y_.phi.push_back(s12 * x.phi[term] + s11 * y.phi[term]);
    along_y_.psi.push_back(s12 * x.psi[term] + s11 * y.psi[term]);
  }
}

PlaneStress HoleArray::under_stress_along_y(double x, double y) const {
  return stress(along_y_, {x, y});
}

}  // namespace perfora::verification
