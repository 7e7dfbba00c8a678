// What is here: potentials of one hole by collocation. What is not: what is compared with them (test_long_holes.cpp).
#include "tests/verification/lone_hole.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace perfora::verification {
namespace {

using Complex = std::complex<double>;
constexpr int terms = 40;
constexpr Complex i{0.0, 1.0};

struct Mapped {
  Complex zeta, slope;  ///< slope: d zeta/dz
};

/// zeta of z = half (zeta + 1/zeta)/2 ... the branch outside the unit circle; half 0: z itself.
Mapped mapped(Complex z, double half) {
  if (half == 0.0) return {z, 1.0};
  const Complex root = std::sqrt(z - half) * std::sqrt(z + half);
  return {(z + root) / half, (1.0 + z / root) / half};
}

/// Strain along the stress, times E, of the hole under a unit stress with the constants Gamma and Gamma'.
double strain(const HoleRim& rim, double half, double gamma, double gamma_prime, Complex direction) {
  const auto rows = static_cast<Eigen::Index>(rim.z.size());
  // Unknowns: real and imaginary parts of a_1 ... a_n, b_1 ... b_n, and of a constant.
  Eigen::MatrixXd matrix(2 * rows, 4 * terms + 2);
  Eigen::VectorXd right(2 * rows);
  const auto put = [&](Eigen::Index row, Eigen::Index column, Complex value) {
    matrix(2 * row, column) = value.real();
    matrix(2 * row + 1, column) = value.imag();
  };
  double size = 0.0;
  for (const Complex& z : rim.z) size = std::max(size, std::abs(mapped(z, half).zeta));
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Complex z = rim.z[static_cast<std::size_t>(row)];
    const Mapped m = mapped(z, half);
    for (int k = 1; k <= terms; ++k) {
      const Complex power = std::pow(m.zeta / size, -k), slope = -static_cast<double>(k) * power / m.zeta * m.slope;
      const Eigen::Index column = 4 * (k - 1);
      put(row, column, power + z * std::conj(slope));
      put(row, column + 1, i * power + z * std::conj(i * slope));
      put(row, column + 2, std::conj(power));
      put(row, column + 3, std::conj(i * power));
    }
    put(row, 4 * terms, 1.0);
    put(row, 4 * terms + 1, i);
    const Complex uniform = 2.0 * gamma * z + gamma_prime * std::conj(z);
    right(2 * row) = -uniform.real();
    right(2 * row + 1) = -uniform.imag();
  }
  const Eigen::VectorXd found = matrix.colPivHouseholderQr().solve(right);
  // Mean strain of the hole: the integral of the displacement's component times the normal's.
  double sum = 0.0;
  for (std::size_t at = 0; at < rim.z.size(); ++at) {
    const Mapped m = mapped(rim.z[at], half);
    Complex phi = gamma * rim.z[at];
    for (int k = 1; k <= terms; ++k)
      phi += (found(4 * (k - 1)) + i * found(4 * (k - 1) + 1)) * std::pow(m.zeta / size, -k);
    const auto along = [&](Complex v) { return v.real() * direction.real() + v.imag() * direction.imag(); };
    sum += 4.0 * along(phi) * along(rim.normal[at]) * rim.length[at];
  }
  return sum / rim.area;
}

}  // namespace

HoleRim ellipse_rim(double a, double b, int points) {
  HoleRim rim;
  const double step = 2.0 * std::numbers::pi / points;
  for (int k = 0; k < points; ++k) {
    const double t = (k + 0.5) * step, nx = b * std::cos(t), ny = a * std::sin(t), speed = std::hypot(nx, ny);
    rim.z.emplace_back(a * std::cos(t), b * std::sin(t));
    rim.normal.emplace_back(nx / speed, ny / speed);
    rim.length.push_back(speed * step);
  }
  rim.area = std::numbers::pi * a * b;
  return rim;
}

HoleRim slot_rim(double half_length, double radius, int points) {
  HoleRim rim;
  const double arc = std::numbers::pi * radius, perimeter = 2.0 * arc + 4.0 * half_length;
  const auto add = [&](double length, const auto& at) {
    const int count = static_cast<int>(std::ceil(points * length / perimeter));
    for (int k = 0; k < count; ++k) {
      const auto [z, normal] = at((k + 0.5) / count);
      rim.z.push_back(z);
      rim.normal.push_back(normal);
      rim.length.push_back(length / count);
    }
  };
  for (const double side : {1.0, -1.0}) {
    add(arc, [&](double t) {
      const Complex normal = side * std::polar(1.0, std::numbers::pi * (t - 0.5));
      return std::pair<Complex, Complex>{side * half_length + radius * normal, normal};
    });
    add(2.0 * half_length, [&](double t) {
      return std::pair<Complex, Complex>{side * Complex(half_length * (1.0 - 2.0 * t), radius), side * i};
    });
  }
  rim.area = arc * radius + 4.0 * half_length * radius;
  return rim;
}

AddedCompliance added_compliance(const HoleRim& rim, double half_segment) {
  return {strain(rim, half_segment, 0.25, -0.5, 1.0), strain(rim, half_segment, 0.25, 0.5, i)};
}

}  // namespace perfora::verification
