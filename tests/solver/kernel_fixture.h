// What is here: one set of cases that every force backend runs, to be held against the reference or a closed form. What
// is not: the cases' expectations.
#pragma once

#include <memory>
#include <utility>

#include "solver/kernels/kernels.h"
#include "tests/solver/sample_packings.h"

namespace perfora::test {

/// Discs, bonds and near pairs at a chosen configuration, ready for one force evaluation.
struct KernelCase {
  solver::DiscState discs;
  solver::BondNetwork network;
  solver::NeighbourList neighbour_list;
  solver::CellMatrix cell, cell_before;
  solver::BondLaw bond;
  solver::ContactLaw contact;
  double dt = 1e-5;  ///< long, so that contacts slip
  std::vector<std::int32_t> broken;

  solver::StepSums evaluate(solver::ForceBackend& backend) {
    broken.clear();
    broken.reserve(static_cast<std::size_t>(network.size()));
    solver::ForceStep step{discs, network,     neighbour_list,
                           cell,  cell_before, solver::velocity_gradient(cell_before, cell, dt),
                           dt,    broken};
    return backend.forces(step);
  }
  /// Ends a drift at the positions and angles that were set: records follow, and the places of the last call become the
  /// drift's start.
  void move_done() {
    discs.sx_before = last_x.empty() ? discs.sx : last_x;
    discs.sy_before = last_y.empty() ? discs.sy : last_y;
    discs.half_angle_before = last_turn.empty() ? discs.half_angle : last_turn;
    last_x = discs.sx;
    last_y = discs.sy;
    last_turn = discs.half_angle;
    for (std::size_t d = 0; d < discs.sx.size(); ++d) discs.refresh_record(d);
  }
  std::vector<std::uint64_t> last_x, last_y, last_turn;
  void half_angle(const std::vector<double>& angle) {
    for (std::size_t d = 0; d < angle.size(); ++d) discs.set_angle(d, angle[d]);
  }
  void place(std::int32_t disc, double x, double y) {
    const double sy = y / cell.yy, sx = (x - cell.xy * sy) / cell.xx;
    discs.sx[static_cast<std::size_t>(disc)] = solver::fixed_point(sx - std::floor(sx));
    discs.sy[static_cast<std::size_t>(disc)] = solver::fixed_point(sy - std::floor(sy));
  }
};

inline solver::BondLaw paper_bond_law() {
  solver::MaterialOptions material;
  return solver::make_bond_law(material, material.reference_mean_diameter);
}

/// Two discs of radius 0.2 mm, bonded at distance `l0` along +x, in a 10 mm cell.
inline KernelCase two_discs(double l0, double radius = 0.2e-3) {
  KernelCase c;
  c.cell = c.cell_before = {0.01, 0.0, 0.01};
  c.bond = paper_bond_law();
  c.contact = solver::make_contact_law({});
  c.discs.resize(2);
  c.discs.radius = {radius, radius};
  c.discs.mass = {1e-3, 2e-3};
  c.discs.inertia = {1e-9, 2e-9};
  c.network = {{0}, {1}, {l0}, {1.0}, {0.0}, {1.0}, {0.0}, {solver::BondState::intact}};
  c.place(0, 0.005, 0.005);
  c.place(1, 0.005 + l0, 0.005);
  c.move_done();
  c.move_done();
  c.neighbour_list.configure(2, radius, 0.2e-3);
  c.neighbour_list.rebuild(c.discs, c.cell, c.network);
  return c;
}

/// A jittered packing with a network, random displacements of `share` of the critical stretch, random rotations,
/// velocities, some damage and some bonds already broken; a sheared, compressed cell.
inline KernelCase random_case(std::uint64_t seed, double fraction, solver::BondLaw bond, double cell_shear = 0.0) {
  const double pitch = 0.5e-3;
  const geometry::Packing packing = jittered_packing(14, pitch, seed);
  KernelCase c;
  solver::MaterialOptions material;
  c.bond = bond;
  c.contact = solver::make_contact_law(material);
  c.network = solver::make_bond_network(packing, no_holes(packing), material, {}, seed, pitch);
  c.cell_before = {packing.width, 0.0, packing.height};
  c.cell = {packing.width, cell_shear * packing.height, packing.height * (1.0 - 1e-5)};
  Uniform u(seed + 100);
  const std::size_t n = packing.x.size();
  c.discs.resize(n);
  c.discs.radius = packing.radius;
  std::swap(c.cell, c.cell_before);
  for (std::size_t d = 0; d < n; ++d) {
    c.place(static_cast<std::int32_t>(d), packing.x[d], packing.y[d]);
    c.discs.mass[d] = u(1e-3, 2e-3);
    c.discs.inertia[d] = u(1e-10, 2e-10);
    c.discs.vx[d] = u(-5.0, 5.0);
    c.discs.vy[d] = u(-5.0, 5.0);
    c.discs.omega[d] = u(-100.0, 100.0);
  }
  c.move_done();
  std::swap(c.cell, c.cell_before);
  const double move = fraction * 1.529e-6;
  for (std::size_t d = 0; d < n; ++d) {
    c.discs.sx[d] += static_cast<std::uint64_t>(static_cast<std::int64_t>(u(-move, move) / packing.width * 0x1p63) * 2);
    c.discs.sy[d] +=
        static_cast<std::uint64_t>(static_cast<std::int64_t>(u(-move, move) / packing.height * 0x1p63) * 2);
    c.discs.set_angle(d, u(-move, move) / pitch);
  }
  for (std::size_t b = 0; b < c.network.damage.size(); ++b) {
    c.network.strength[b] = u(0.5, 1.6);
    if (u() < 0.1) c.network.damage[b] = u(0.0, 0.95);
    if (u() < 0.05) c.network.state[b] = solver::BondState::broken;
    if (u() < 0.05) c.network.state[b] = solver::BondState::compacted;
    if (c.network.state[b] != solver::BondState::intact) c.network.damage[b] = 1.0;
  }
  c.move_done();
  c.neighbour_list.configure(static_cast<std::int32_t>(n), 0.48 * pitch, 0.2 * pitch);
  c.neighbour_list.rebuild(c.discs, c.cell, c.network);
  return c;
}

}  // namespace perfora::test
