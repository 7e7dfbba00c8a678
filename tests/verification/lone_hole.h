// What is here: one traction-free hole of any smooth shape in an infinite elastic sheet under a uniform stress, by
// Kolosov's and Muskhelishvili's potentials. What is not: arrays of holes (hole_array_solution.h).
#pragma once

#include <complex>
#include <vector>

namespace perfora::verification {

/// A rim, anticlockwise about the origin: points z, outward normals n as complex numbers, and lengths of rim that the
/// points stand for.
struct HoleRim {
  std::vector<std::complex<double>> z, normal;
  std::vector<double> length;
  double area = 0.0;
};

/// Half-axes a along x, b along y.
HoleRim ellipse_rim(double a, double b, int points);
/// A rectangle 2 half_length long between half-circles of `radius`.
HoleRim slot_rim(double half_length, double radius, int points);

/// Compliance that a hole adds, times E and the area of the sheet over that of the hole: strain along the stress, of a
/// stress along x and along y. A circle: 3 and 3; an ellipse: 1 + 2 b/a and 1 + 2 a/b (Kachanov, Tsukrov and Shafiro,
/// Appl. Mech. Rev. 47, 1994, S151).
/// Method: phi = Gamma z + sum a_k zeta^-k, psi = Gamma' z + sum b_k zeta^-k, where zeta maps the plane outside a
/// segment in the hole to the outside of the unit circle; coefficients by least squares of phi + z conj(phi') +
/// conj(psi) = 0 on the rim, where the displacement then is 4 phi/E (plane stress).
struct AddedCompliance {
  double along_x = 0.0, along_y = 0.0;
};
AddedCompliance added_compliance(const HoleRim& rim, double half_segment);

}  // namespace perfora::verification
