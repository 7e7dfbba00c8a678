// What is here: plane elasticity of an endless sheet with a square array of circular holes, solved by complex
// potentials and least squares on the cell's edge: the continuum's answer to stand beside published numbers. What is
// not: discs.
#pragma once

#include <complex>
#include <vector>

namespace perfora::verification {

/// Stress in the plane, tension positive, in units of Young's modulus of the sheet.
struct PlaneStress {
  double xx = 0.0, yy = 0.0, xy = 0.0;
};

/// A cell of side 1 with a hole of radius `radius` in its middle, Young's modulus 1.
class HoleArray {
 public:
  /// `order`: highest power of the Laurent series; 41 gives 6 digits for radius 0.25 (checked by doubling).
  HoleArray(double radius, double poisson, int order = 41);

  double young() const { return young_; }                    ///< along the pitch
  double young_diagonal() const { return young_diagonal_; }  ///< at 45 degrees
  double poisson() const { return poisson_; }                ///< contraction for stress along the pitch
  double shear() const { return shear_; }        ///< shear stress over engineering shear, axes along the pitch
  double residual() const { return residual_; }  ///< largest least-squares residual of the three cases

  /// Local stress at (x, y) from the middle of the hole, under a mean stress of 1 along y and none else.
  PlaneStress under_stress_along_y(double x, double y) const;

 private:
  struct Solution {
    std::vector<std::complex<double>> phi, psi;  ///< of the powers in powers_
    PlaneStress mean;
  };
  Solution solve(double strain_xx, double strain_yy, double strain_xy);
  PlaneStress stress(const Solution& s, std::complex<double> z) const;
  /// Factor that keeps a column's largest entry near 1.
  double scale(int power) const;

  double radius_, material_poisson_;
  std::vector<int> powers_;
  Solution along_y_;
  double young_ = 0.0, young_diagonal_ = 0.0, poisson_ = 0.0, shear_ = 0.0, residual_ = 0.0;
};

}  // namespace perfora::verification
