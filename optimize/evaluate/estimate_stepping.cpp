// What is here: the time step of a design, from a small shaken lattice of its discs instead of the whole packing.
#include "optimize/evaluate/estimate_stepping.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "geometry/packing.h"
#include "geometry/plane.h"
#include "solver/mass.h"
#include "solver/noise.h"
#include "solver/run.h"
#include "solver/run_setup.h"

namespace perfora::optimize {

namespace {

/// Discs across the patch: enough that no disc is bonded to two images of another at a horizon of 3.
constexpr int fewest_columns = 20;
/// Shaking of the lattice in spacings: about the disorder of a packing diluted from jamming.
constexpr double shaking = 0.2;

geometry::Packing make_patch(const PatchDiscs& discs, double horizon_radius) {
  const double spacing = std::sqrt(2.0 / (std::sqrt(3.0) * discs.density));
  const int columns = std::max(fewest_columns, static_cast<int>(std::ceil(2.2 * horizon_radius / spacing)));
  const int rows = 2 * static_cast<int>(std::ceil(columns / std::sqrt(3.0)));  // even, and about square
  const double row_height = 0.5 * std::sqrt(3.0) * spacing;
  geometry::Packing patch;
  patch.width = columns * spacing;
  patch.height = rows * row_height;
  std::mt19937 generator(1);  // its bits are the same everywhere; a distribution's are not
  const auto shake = [&] { return shaking * spacing * (2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x = (column + (row % 2 == 0 ? 0.25 : 0.75)) * spacing + shake(),
                   y = (row + 0.5) * row_height + shake();
      patch.x.push_back(geometry::wrapped(x, patch.width));
      patch.y.push_back(geometry::wrapped(y, patch.height));
      patch.radius.push_back(0.5 * discs.diameters[generator() % discs.diameters.size()]);
    }
  }
  return patch;
}

/// Standard deviation of the strength factor.
double strength_deviation(const solver::NoiseOptions& noise) {
  switch (noise.kind) {
    case solver::NoiseKind::none:
      return 0.0;
    case solver::NoiseKind::perlin:
      return noise.deviation > 0.0 ? noise.deviation : 0.5 * noise.amplitude * solver::perlin_deviation();
    case solver::NoiseKind::weibull: {
      const double mean = std::tgamma(1.0 + 1.0 / noise.weibull_modulus);
      return std::sqrt(std::max(0.0, std::tgamma(1.0 + 2.0 / noise.weibull_modulus) / (mean * mean) - 1.0));
    }
  }
  return 0.0;
}

/// What the mass of a mean disc is proportional to with uniform_step, solver/mass.h.
double mean_stiffness(const solver::MaterialOptions& material, double bonds_per_disc, double contacts_per_disc) {
  return 0.5 * bonds_per_disc * (material.normal_stiffness + material.tangential_stiffness) +
         solver::contact_mass_weight * contacts_per_disc * material.normal_stiffness;
}

solver::LoadingEstimate estimate_loading(const solver::SolverOptions& options,
                                         const geometry::PerforationLayout& layout, const PatchDiscs& discs,
                                         const geometry::Packing& patch, solver::BondNetwork network,
                                         double patch_bonds) {
  // Two strengths, one deviation apart from the mean: the statistics of the field without its lattice, which the patch
  // is too small for.
  const double deviation = strength_deviation(options.noise);
  for (std::size_t bond = 0; bond < network.strength.size(); ++bond)
    network.strength[bond] = 1.0 + (bond % 2 == 0 ? deviation : -deviation);
  const solver::MassProperties masses = solver::make_masses(patch, network, options.material, options.dynamics);
  const double solid = layout.solid_area_fraction();
  // The same springs and masses spread over the holes as well.
  const double width = patch.width * patch.height / (solid * layout.height);
  solver::LoadingEstimate loading =
      solver::estimate_loading(network, masses, options, width, layout.height, 1.0 - solid, discs.mean_diameter);
  const double stiffer = discs.bonds_per_disc / patch_bonds;
  loading.modulus *= stiffer;
  loading.wave_speed *= std::sqrt(stiffer);
  loading.rate *= std::sqrt(stiffer);
  return loading;
}

}  // namespace

SteppingEstimate estimate_stepping(const solver::SolverOptions& options, const geometry::PerforationLayout& layout,
                                   const PatchDiscs& discs) {
  const geometry::Packing patch = make_patch(discs, options.material.horizon * discs.mean_diameter);
  const geometry::PerforationLayout no_holes{patch.width, patch.height, {}};
  solver::RunRequest request;
  request.clipped = &patch;
  request.layout = &no_holes;
  request.options = options;
  request.options.noise.kind = solver::NoiseKind::none;
  request.options.boundary = {};  // the patch stands for the inside of the block
  request.mean_diameter = discs.mean_diameter;
  constexpr double slow = 1e-3;  // 1/s: so many steps a segment that their rounding does not show
  request.options.loading.rate = slow;
  const solver::RunEstimate run = solver::estimate_run(request);
  const double patch_bonds = 2.0 * static_cast<double>(run.bonds) / static_cast<double>(run.discs);

  const std::vector<double> contacts_each = solver::contacts_to_come(patch.radius);
  const double contacts =
      std::accumulate(contacts_each.begin(), contacts_each.end(), 0.0) / static_cast<double>(contacts_each.size());
  SteppingEstimate estimate;
  estimate.time_step = run.time_step;
  if (options.dynamics.mass == solver::MassScaling::uniform_step)  // total mass over total stiffness
    estimate.time_step *= std::sqrt(mean_stiffness(options.material, patch_bonds, contacts) /
                                    mean_stiffness(options.material, discs.bonds_per_disc, contacts));
  estimate.loading = estimate_loading(
      options, layout, discs, patch,
      solver::make_bond_network(patch, no_holes, options.material, request.options.noise, 1, discs.mean_diameter),
      patch_bonds);
  return estimate;
}

}  // namespace perfora::optimize
