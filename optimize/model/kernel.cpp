// What is here: the kernel as matrices. What is not: its lengths' choice (gaussian_fit.cpp).
#include "optimize/model/kernel.h"

#include <cmath>

namespace perfora::model {
namespace {

/// Squares of the scaled distances, families included.
Eigen::MatrixXd squares(const Kernel& kernel, const Inputs& a, const Inputs& b) {
  const Eigen::ArrayXd inverse = kernel.length.array().inverse();
  const double apart = 1.0 / (kernel.family_length * kernel.family_length);
  Eigen::MatrixXd square(a.rows(), b.rows());
  // Difference by difference: the form with products loses all digits of near points.
  for (int j = 0; j < b.rows(); ++j)
    for (int i = 0; i < a.rows(); ++i) {
      const double same = a.family[static_cast<std::size_t>(i)] == b.family[static_cast<std::size_t>(j)] ? 0.0 : apart;
      square(i, j) = ((a.points.row(i) - b.points.row(j)).transpose().array() * inverse).square().sum() + same;
    }
  return square;
}

double one_fidelity(const Inputs& a, int i, const Inputs& b, int j) {
  const int first = a.fidelity[static_cast<std::size_t>(i)], second = b.fidelity[static_cast<std::size_t>(j)];
  return first == second && first != 0 ? 1.0 : 0.0;
}

double matern(double square) {
  const double t = std::sqrt(5.0 * square);
  return (1.0 + t + t * t / 3.0) * std::exp(-t);
}

}  // namespace

Inputs Inputs::row(int k) const {
  return {points.row(k), {family[static_cast<std::size_t>(k)]}, {fidelity[static_cast<std::size_t>(k)]}};
}

void Inputs::append(const Inputs& others) {
  Eigen::MatrixXd longer(points.rows() + others.points.rows(), std::max(points.cols(), others.points.cols()));
  if (points.rows() > 0) longer.topRows(points.rows()) = points;
  longer.bottomRows(others.points.rows()) = others.points;
  points = std::move(longer);
  family.insert(family.end(), others.family.begin(), others.family.end());
  fidelity.insert(fidelity.end(), others.fidelity.begin(), others.fidelity.end());
}

Eigen::MatrixXd Kernel::operator()(const Inputs& a, const Inputs& b) const {
  Eigen::MatrixXd value = squares(*this, a, b).unaryExpr(&matern);
  for (int j = 0; j < b.rows(); ++j)
    for (int i = 0; i < a.rows(); ++i) value(i, j) *= 1.0 + bias * one_fidelity(a, i, b, j);
  return value;
}

KernelParts kernel_parts(const Kernel& kernel, const Inputs& inputs) {
  const int n = inputs.rows();
  const Eigen::MatrixXd square = squares(kernel, inputs, inputs);
  KernelParts parts{square.unaryExpr(&matern), square.unaryExpr([](double s) {
                      const double t = std::sqrt(5.0 * s);
                      return 5.0 / 3.0 * (1.0 + t) * std::exp(-t);
                    }),
                    Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      if (inputs.family[static_cast<std::size_t>(i)] != inputs.family[static_cast<std::size_t>(j)])
        parts.different(i, j) = 1.0;
      parts.same(i, j) = one_fidelity(inputs, i, inputs, j);
    }
  return parts;
}

}  // namespace perfora::model
