// What is here: small blocks with platens, walls or free sides, readied for the solver's tests. What is not: the
// packings (sample_packings.h), runs with files.
#pragma once

#include "solver/specimen.h"
#include "tests/solver/sample_packings.h"

namespace perfora::test {

inline solver::SolverOptions with_edges(solver::TopBottom top_bottom, solver::Sides sides) {
  solver::SolverOptions options;
  options.boundary.top_bottom = top_bottom;
  options.boundary.sides = sides;
  return options;
}

/// Bonds that no test breaks.
inline void make_unbreakable(solver::MaterialOptions& material) {
  constexpr double out_of_reach = 1e4;
  material.critical_normal_displacement *= out_of_reach;
  material.critical_shear_displacement *= out_of_reach;
}

/// make_simulation with the edges that the options ask for; rate in 1/s compresses the height.
inline solver::Simulation make_bounded(const geometry::Packing& packing, const solver::SolverOptions& options,
                                       double mean_diameter, double rate, int threads = 1) {
  const solver::Specimen specimen =
      solver::make_specimen(packing, no_holes(packing), options.boundary, options.material, mean_diameter);
  solver::SimulationInput input;
  input.clipped = &specimen.packing;
  input.network = solver::make_bond_network(specimen.packing, specimen.layout, options.material, options.noise, 1,
                                            mean_diameter, specimen.field);
  input.masses = solver::make_masses(specimen.packing, input.network, options.material, options.dynamics);
  input.time_step = options.dynamics.step_factor * input.masses.critical_step;
  input.cell.start = specimen.cell;
  input.cell.control[2] = solver::CellControl::rate;
  input.cell.velocity.yy = -rate * specimen.cell.yy;
  input.block = specimen.block;
  input.walls = specimen.walls;
  input.options = options;
  input.mean_diameter = mean_diameter;
  input.threads = threads;
  return solver::Simulation(std::move(input));
}

}  // namespace perfora::test
