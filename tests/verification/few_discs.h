// What is here: simulations of a few discs without bonds, with masses set by hand, for closed forms. What is not:
// packings (blocks.h).
#pragma once

#include <utility>
#include <vector>

#include "solver/simulation.h"

namespace perfora::verification {

struct Disc {
  double x = 0.0, y = 0.0, radius = 0.0;  ///< m
  double mass = 1.0;                      ///< kg/m
  double inertia = 0.0;                   ///< kg m; 0: mass radius^2/2
  double vx = 0.0, vy = 0.0, omega = 0.0;
};

/// Contacts without dissipation other than what a test switches on; no Cundall damping.
inline solver::SolverOptions contact_options(double friction, double viscous_rate) {
  solver::SolverOptions options;
  options.dynamics.cundall_damping = 0.0;
  options.dynamics.kernel = solver::KernelChoice::reference;
  options.material.friction_coefficient = friction;
  options.material.viscous_rate = viscous_rate;
  return options;
}

/// Unbonded discs in a periodic cell (velocities are those of the first half step).
inline solver::Simulation few_discs(const std::vector<Disc>& discs, solver::Cell cell,
                                    const solver::SolverOptions& options, double time_step) {
  geometry::Packing packing;
  packing.width = cell.start.xx;
  packing.height = cell.start.yy;
  solver::SimulationInput input;
  double mean = 0.0;
  for (const Disc& d : discs) {
    packing.x.push_back(d.x);
    packing.y.push_back(d.y);
    packing.radius.push_back(d.radius);
    input.masses.mass.push_back(d.mass);
    input.masses.inertia.push_back(d.inertia > 0.0 ? d.inertia : 0.5 * d.mass * d.radius * d.radius);
    mean += 2.0 * d.radius / static_cast<double>(discs.size());
  }
  input.clipped = &packing;
  input.options = options;
  input.cell = cell;
  input.time_step = time_step;
  input.mean_diameter = mean;
  solver::Simulation simulation(std::move(input));
  for (std::size_t k = 0; k < discs.size(); ++k) {
    simulation.discs().vx[k] = discs[k].vx;
    simulation.discs().vy[k] = discs[k].vy;
    simulation.discs().omega[k] = discs[k].omega;
  }
  return simulation;
}

inline solver::Cell fixed_cell(double width, double height) {
  solver::Cell cell;
  cell.start = {width, 0.0, height};
  return cell;
}

}  // namespace perfora::verification
