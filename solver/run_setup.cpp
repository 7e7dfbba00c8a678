// What is here: bonds, masses, rate and time step of a request, and the estimate of a run made from it.
#include "solver/run_setup.h"

#include <algorithm>
#include <cmath>

#include "geometry/open_area.h"
#include "io/error.h"
#include "solver/crushed_bands.h"
#include "solver/kernels/kernels.h"

namespace perfora::solver {

namespace {

void refuse_missing_simd(SimdChoice simd) {
  const std::vector<SimdChoice> usable = usable_simd();
  if (simd != SimdChoice::automatic && std::find(usable.begin(), usable.end(), simd) == usable.end())
    throw io::InputError({"", 0, "dynamics.simd"}, "this machine has not got these instructions", "",
                         "use \"auto\", or \"portable\" for bits that every machine of one kind gives");
}

}  // namespace

LoadedBlock loaded_block(const geometry::PerforationLayout& layout) {
  LoadedBlock block{layout.width, layout.height, 0.0};
  for (const geometry::Perforation& hole : layout.perforations)
    block.largest_hole = std::max(block.largest_hole, hole.largest_extent());
  return block;
}

namespace {

/// Fraction of the cell in openings. Those of an imported packing are known from its discs alone: circles of one mean
/// diameter fit into openings, not into the gaps of a packing.
double porosity_of(const RunRequest& request) {
  if (!request.layout->perforations.empty() || request.clipped->key.source.empty())
    return 1.0 - request.layout->solid_area_fraction();
  return geometry::open_fraction(*request.clipped, request.mean_diameter);
}

}  // namespace

RunSetup set_up_run(const RunRequest& request) {
  const SolverOptions& options = request.options;
  refuse_missing_simd(options.dynamics.simd);
  RunSetup s;
  s.specimen =
      make_specimen(*request.clipped, *request.layout, options.boundary, options.material, request.mean_diameter);
  s.network = make_bond_network(s.specimen.packing, s.specimen.layout, options.material, options.noise,
                                request.noise_seed, request.mean_diameter, s.specimen.field);
  if (s.network.size() == 0)
    throw io::InputError({"", 0, "material.horizon"}, "no two discs are near enough to be bonded", "",
                         "raise the horizon or the solid fraction");
  s.masses = make_masses(s.specimen.packing, s.network, options.material, options.dynamics);
  s.loading = estimate_loading(s.network, s.masses, options, request.layout->width, request.layout->height,
                               porosity_of(request), request.mean_diameter);
  // The bound per disc is pessimistic by a factor of 1.4 for uniform_step; power iteration on the intact network gives
  // the step that counts, with step_factor as its margin. Rubble is held by contacts: their own limit, dashpots
  // included, stands beside it.
  s.critical_step = std::max(
      s.masses.critical_step,
      critical_step_by_power_iteration(s.network, s.masses, options.material, options.dynamics.cundall_damping));
  const double longest = std::min(
      options.dynamics.step_factor * s.critical_step,
      contact_critical_step(s.masses, s.specimen.packing.radius, options.material, options.dynamics.cundall_damping));
  s.plan = plan_loading(s.loading, options.loading, loaded_block(*request.layout), longest);
  // Last: masses, step and rate are those of the whole block, as they are of one whose end is crushed later.
  remove_crushed_bonds(s.network, s.specimen.packing, s.specimen.field, options.boundary);
  return s;
}

RunEstimate estimate_run(const RunRequest& request) {
  const RunSetup setup = set_up_run(request);
  RunEstimate e;
  e.discs = request.clipped->size();
  e.bonds = setup.network.size();
  e.steps = expected_steps(setup.plan, setup.loading, setup.loading.bulk_density / request.options.material.density);
  e.time_step = setup.plan.time_step;
  e.rate = request.options.loading.until / (static_cast<double>(e.steps) * e.time_step);
  return e;
}

}  // namespace perfora::solver
