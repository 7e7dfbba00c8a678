// What is here: the block of Table 1, bonded, for benchmarks. What is not: benchmarks.
#pragma once

#include "geometry/clip.h"
#include "geometry/layout.h"
#include "geometry/make_packing.h"
#include "solver/bond_network.h"
#include "solver/run_setup.h"
#include "solver/simulation.h"

namespace perfora::benchmarks {

/// The block of Table 1 with its 36 holes (some 36,600 discs), or a square of fewer or more of them. The packing is
/// quenched at its solid fraction, which is as good for timing as the designs' way over the jammed state.
struct Block {
  geometry::Packing packing;
  geometry::PerforationLayout layout;
  solver::SolverOptions options;
  solver::BondNetwork network;
  solver::MassProperties masses;
  double mean_diameter = 0.0;
};

inline Block table1_block(double horizon = 3.0, int holes_a_side = 6) {
  Block b;
  geometry::PackingOptions packing;
  packing.solid_fraction = 0.719;
  packing.protocol = geometry::PackingProtocol::quench;
  geometry::LayoutOptions layout;
  layout.rows = layout.columns = holes_a_side;
  layout.diameter = 20e-3;
  const double side = 0.025 * holes_a_side;
  b.mean_diameter = packing.mean_diameter;
  layout.width = layout.height = side;
  b.layout = geometry::make_layout(layout, 1);
  b.packing = geometry::clip_packing(geometry::make_packing(packing, side, side, 1, 2), b.layout, packing.clip);
  b.options.material.horizon = horizon;
  b.network = solver::make_bond_network(b.packing, b.layout, b.options.material, {}, 1, b.mean_diameter);
  b.masses = solver::make_masses(b.packing, b.network, b.options.material, b.options.dynamics);
  return b;
}

}  // namespace perfora::benchmarks
