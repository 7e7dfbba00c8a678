// What is here: see run_setup.h, and the estimate of a run made from it.
#include "solver/run_setup.h"

#include <algorithm>
#include <cmath>

#include "io/error.h"
#include "solver/kernels.h"

namespace perfora::solver {

namespace {

void refuse_missing_simd(SimdChoice simd) {
  const std::vector<SimdChoice> usable = usable_simd();
  if (simd != SimdChoice::automatic && std::find(usable.begin(), usable.end(), simd) == usable.end())
    throw io::InputError({"", 0, "dynamics.simd"}, "this machine has not got these instructions", "",
                         "use \"auto\", or \"portable\" for bits that every machine of one kind gives");
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
                               1.0 - request.layout->solid_area_fraction(), request.mean_diameter);
  s.rate = options.loading.rate > 0.0 ? options.loading.rate : s.loading.rate;
  // The step is shortened so that a whole number of steps makes a row: rows then sit at exact strains.
  const double interval = options.output.history_interval;
  // The bound per disc is pessimistic by a factor of 1.4 for uniform_step; power iteration on the intact network gives
  // the step that counts, with step_factor as its margin. Rubble is held by contacts: their own limit, dashpots
  // included, stands beside it.
  s.critical_step = std::max(
      s.masses.critical_step,
      critical_step_by_power_iteration(s.network, s.masses, options.material, options.dynamics.cundall_damping));
  const double longest = std::min(options.dynamics.step_factor * s.critical_step,
                                  contact_critical_step(s.masses, options.material, options.dynamics.cundall_damping));
  s.steps_per_row = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(interval / (s.rate * longest))));
  s.time_step = interval / (s.rate * static_cast<double>(s.steps_per_row));
  constexpr double rounding = 1e-9;
  s.rows = static_cast<std::int64_t>(std::ceil(options.loading.until / interval - rounding));
  return s;
}

RunEstimate estimate_run(const RunRequest& request) {
  const RunSetup setup = set_up_run(request);
  RunEstimate e;
  e.discs = request.clipped->size();
  e.bonds = setup.network.size();
  e.steps = setup.rows * setup.steps_per_row;
  e.time_step = setup.time_step;
  e.rate = setup.rate;
  return e;
}

}  // namespace perfora::solver
