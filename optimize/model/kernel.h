// What is here: how alike two designs are taken to be: Matern's kernel of order 5/2 over scaled inputs, with family and
// fidelity. What is not: what is learnt with it (gaussian_process.h, classifier.h).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace perfora::model {

/// Where something was observed or is asked: inputs, one row a design, with the family and the fidelity of each.
struct Inputs {
  Eigen::MatrixXd points;     ///< rows x dimension, each column of the order of 1
  std::vector<int> family;    ///< as many as rows
  std::vector<int> fidelity;  ///< as many as rows; 0: the one that answers are asked for

  int rows() const { return static_cast<int>(points.rows()); }
  int dimension() const { return static_cast<int>(points.cols()); }
  Inputs row(int k) const;
  void append(const Inputs& others);
};

/// k(a, b) = (1 + sqrt(5) r + 5 r^2/3) exp(-sqrt(5) r) (1 + bias where both are of one fidelity that is not 0),
/// r^2 = sum over inputs of ((a - b)/length)^2, plus 1/family_length^2 where the families differ. Rasmussen and
/// Williams, Gaussian Processes for Machine Learning (2006), eq. 4.17, with a length an input; the bias is that of a
/// cheaper fidelity about a constant, Kennedy and O'Hagan 2000 with a factor of 1.
struct Kernel {
  Eigen::VectorXd length;      ///< one an input
  double family_length = 1.0;  ///< small: families have nothing in common
  double bias = 0.1;           ///< variance of a fidelity's own deviation over that of the response

  /// a.rows() x b.rows()
  Eigen::MatrixXd operator()(const Inputs& a, const Inputs& b) const;
};

/// The parts of the kernel's matrix of one set of inputs with itself, for gradients.
struct KernelParts {
  Eigen::MatrixXd value;      ///< Matern's, without the bias
  Eigen::MatrixXd slope;      ///< its derivative by -r^2/2: (5/3)(1 + sqrt(5) r) exp(-sqrt(5) r)
  Eigen::MatrixXd different;  ///< 1 where families differ
  Eigen::MatrixXd same;       ///< 1 where both are of one fidelity that is not 0
};
KernelParts kernel_parts(const Kernel& kernel, const Inputs& inputs);

}  // namespace perfora::model
