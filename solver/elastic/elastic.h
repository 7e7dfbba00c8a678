// What is here: the elastic response of a bonded block: its homogenised stiffness and how every disc moves under a unit
// strain, from one linear solution instead of a run. What is not: first yield (first_yield.h), breaking, contacts,
// time. The stiffness matrix shares no code with the force kernels, so that each checks the other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/bond_network.h"
#include "solver/elastic/plane_moduli.h"
#include "solver/options.h"

namespace perfora::solver {

/// Load cases: one unit of E_xx, of E_yy, of the engineering shear (E_xy = E_yx = 1/2).
enum class UnitStrain { xx = 0, yy = 1, xy = 2 };

/// How exactly the equilibrium is solved.
struct ElasticOptions {
  /// Norm of the forces left over the norm of the magnitudes that meet at the discs. Moduli err by its square, bonds by
  /// about a hundred times it (the slowest mode of a block of a hundred discs).
  double tolerance = 1e-10;
  int most_iterations = 2000;  ///< Table 1 takes 60
};

enum class ElasticStatus { converged, not_converged };

/// The answer of a block. Without bonds all stiffness is zero, and moduli are zero or NaN.
struct ElasticResponse {
  ElasticStatus status = ElasticStatus::converged;
  PlaneStiffness stiffness{};         ///< with every disc in equilibrium, symmetric to the tolerance
  PlaneStiffness affine_stiffness{};  ///< Voigt's bound: every disc moves with the strain, none turns
  PlaneModuli moduli;                 ///< of `stiffness`
  int iterations = 0;                 ///< of the three load cases together
  double residual = 0.0;              ///< largest of the three, see ElasticOptions::tolerance
  std::int64_t bonds = 0;             ///< intact ones, which alone count
  /// Per load case (UnitStrain) n x 3 numbers, row by row: u_x, u_y (m, beyond the affine displacement E x; mean zero)
  /// and the rotation phi (rad), per unit of strain. A disc that nothing holds keeps what the solver leaves it.
  std::array<std::vector<double>, 3> displacement;
};

/// Solves K u = -f(E) for the three unit strains of the periodic cell with the linearised law of docs/user/theory.md
/// ("Elastic response"): bonds of `network` between `discs` discs, all intact ones with their full stiffness (damage is
/// not looked at: it weakens tension only, which is not linear), cell `width` x `height` in m, stiffnesses in N/m.
/// Conjugate gradients with two levels: blocks of a disc and rigid groups of neighbours. Isolated discs, fragments and
/// free rotations do no harm. What does not converge is a status. Cost: about 60 products with the matrix; one to two
/// seconds and 0.5 GB for 36,600 discs with 390,000 bonds. One thread, the same bits each time.
ElasticResponse elastic_response(const BondNetwork& network, std::int32_t discs, double width, double height,
                                 double normal_stiffness, double tangential_stiffness,
                                 const ElasticOptions& options = {});
/// The same with k_n and k_t of a material.
ElasticResponse elastic_response(const BondNetwork& network, std::int32_t discs, double width, double height,
                                 const MaterialOptions& material, const ElasticOptions& options = {});

/// delta_n and delta_t of one bond per unit of strain, m.
struct BondAnswer {
  double delta_n = 0.0, delta_t = 0.0;
};
BondAnswer bond_answer(const BondNetwork& network, std::int64_t bond, const ElasticResponse& response,
                       UnitStrain strain);

}  // namespace perfora::solver
