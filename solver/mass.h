// What is here: masses, moments of inertia and the critical time step. What is not: the step itself.
#pragma once

#include <vector>

#include "geometry/packing.h"
#include "solver/bond_network.h"
#include "solver/cell.h"
#include "solver/options.h"

namespace perfora::solver {

struct MassProperties {
  std::vector<double> mass;     ///< kg/m
  std::vector<double> inertia;  ///< kg m
  double critical_step = 0.0;   ///< s, from the bound below, Cundall damping included
  double total = 0.0;           ///< kg/m
};

/// Masses and the bound dt_c = 2/(omega sqrt(1+c)), omega^2 <= 2 max_i (K_i/m_i + KR_i/I_i), K_i = sum (k_n+k_t)/2 over
/// bonds + n_i k_n for contacts to come, KR_i = sum k_t l^2/4 + n_i k_t R_i^2 (docs/user/theory.md, "Motion").
/// `physical`: rho pi R^2 and m R^2/2. `uniform_step`: m_i ~ K_i + 9 n_i k_n (contacts count tenfold) with the total
/// kept and I_i = m_i KR_i/K_i, so
/// that all discs have nearly the same critical step in bonds and in contacts; statics are exact.
MassProperties make_masses(const geometry::Packing& clipped, const BondNetwork& network,
                           const MaterialOptions& material, const DynamicsOptions& dynamics);

/// The true critical step of the intact network: 2/(omega_max sqrt(1+c)) with omega_max from `iterations` of power
/// iteration on M^-1 K (linearised, undeformed).
double critical_step_by_power_iteration(const BondNetwork& network, const MassProperties& masses,
                                        const MaterialOptions& material, double cundall_damping, int iterations = 60);

/// How many times the contacts to come count in the masses of uniform_step. Discs that holes took bonds from are the
/// lightest, and in contacts they limit the step: with 10 for 1 that limit is longer, and the critical step of the
/// bonds hardly shorter.
inline constexpr double contact_mass_weight = 10.0;

/// Discs of radius `neighbour` that fit around one of `radius` in contact with it: pi/asin(r/(R + r)).
double contacts_around(double radius, double neighbour);
/// n_i: contacts that a disc may get in the rubble: discs of the median size around it, at least six.
std::vector<double> contacts_to_come(const std::vector<double>& radius);

/// Longest stable step of a disc held by contacts alone: the root of K dt^2 + 2 C dt = 4 m of springs and dashpots
/// whose force lags by half a step, with K = n_i k_n and C = 2 beta sqrt(k_n) sum sqrt(m_eff) over its contacts, for
/// the neighbours from the median size up that make the sum largest; both times (1 + c) for Cundall damping. The least
/// over all discs.
double contact_critical_step(const MassProperties& masses, const std::vector<double>& radius,
                             const MaterialOptions& material, double cundall_damping);

/// Share of Voigt's C11 that a relaxed packing keeps (0.82 to 0.96 for H = 2 to 4, docs/developer/verification.md).
inline constexpr double network_ratio = 0.85;
/// Voigt's C11, Pa, of bonds with sum l^2/area = `bond_density` (-).
double voigt_modulus(const MaterialOptions& material, double bond_density);

/// What the automatic loading rate rests on.
struct LoadingEstimate {
  double modulus = 0.0;       ///< effective C11 of the block, Pa
  double bulk_density = 0.0;  ///< kg/m3
  double wave_speed = 0.0;    ///< m/s
  double peak_strain = 0.0;   ///< estimated strain of the first peak
  double rate = 0.0;          ///< 1/s for the wanted number of transits
};
LoadingEstimate estimate_loading(const BondNetwork& network, const MassProperties& masses, const SolverOptions& options,
                                 double width, double height, double porosity, double mean_diameter);

/// The means that the loading estimate needs, counted from a network or expected of one.
struct BlockMeans {
  double voigt_modulus = 0.0;     ///< C11 of the whole cell under affine strain, Pa
  double porosity = 0.0;          ///< fraction of the perforations
  double bulk_density = 0.0;      ///< kg/m3 of the whole cell
  double mean_bond_length = 0.0;  ///< m
  double mean_diameter = 0.0;     ///< <d>, m
  double height = 0.0;            ///< m
  double strength = 1.0;          ///< mean strength factor less its standard deviation
};
LoadingEstimate estimate_loading(const BlockMeans& block, const SolverOptions& options);

}  // namespace perfora::solver
