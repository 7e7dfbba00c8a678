// What is here: the linearised bond network of a periodic cell under a mean strain, solved by conjugate gradients: an
// oracle of its own, apart from the solver's. What is not: time, damage, contacts.
#pragma once

#include <vector>

#include "solver/bond_network.h"

namespace perfora::verification {

/// Symmetric tensor in the plane; tension positive, xy the tensor's own component (half the engineering shear).
struct Tensor {
  double xx = 0.0, yy = 0.0, xy = 0.0;
};

/// Relaxed state under a mean strain: displacements beyond the affine ones (m), turns, mean stress (Pa).
struct NetState {
  Tensor strain;
  std::vector<double> ux, uy, turn;
  Tensor stress;
  int iterations = 0;
  double residual = 0.0;  ///< of the forces over that of the affine state
};

class LinearNet {
 public:
  LinearNet(const solver::BondNetwork& network, int discs, const solver::MaterialOptions& material, double width,
            double height);

  /// Minimises the energy; residual 1e-8, which makes stress exact to 1e-12 or so (energy is of second order in it).
  NetState relax(const Tensor& strain) const;
  /// Mean stress before relaxation: Voigt's.
  Tensor affine_stress(const Tensor& strain) const;
  /// F_a r_b summed over bonds, half to each end: Love and Weber's stress of a disc times its area.
  std::vector<Tensor> disc_virials(const NetState& state) const;
  double area() const { return width_ * height_; }

 private:
  struct Bond {
    int i, j;
    double nx, ny, length;
  };
  struct BondForce {
    double normal, shear;
  };
  BondForce force(const Bond& b, const std::vector<double>& u, const Tensor& strain) const;
  void forces(const std::vector<double>& u, const Tensor& strain, std::vector<double>& f) const;
  std::vector<double> inverse_diagonal_blocks() const;

  std::vector<Bond> bonds_;
  int discs_;
  double normal_stiffness_, tangential_stiffness_, width_, height_;
  double scale_;  ///< length that makes turns and displacements alike, m
};

/// Stiffness of a square-symmetric sheet, Pa: mean stress over strain in three modes.
struct Stiffness {
  double c11 = 0.0, c12 = 0.0, c21 = 0.0, c22 = 0.0, c66 = 0.0;
  /// Young's modulus along x and y and on the diagonal, shear modulus, Poisson's ratio (x), from the compliance.
  double young_x() const { return c11 - c12 * c21 / c22; }
  double young_y() const { return c22 - c12 * c21 / c11; }
  double young_diagonal() const {
    const double determinant = c11 * c22 - c12 * c21, s11 = c22 / determinant, s22 = c11 / determinant,
                 s12 = -0.5 * (c12 + c21) / determinant;
    return 4.0 / (s11 + s22 + 2.0 * s12 + 1.0 / c66);
  }
  double poisson() const { return c12 / c22; }
};
Stiffness measure(const LinearNet& net);
Stiffness voigt(const LinearNet& net);

}  // namespace perfora::verification
