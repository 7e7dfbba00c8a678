// What is here: velocities, forces and stresses of discs at one moment, for frames that ask for them. What is not: the
// forces that move the discs (kernels/), places and damage (frame.cpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "solver/frame.h"
#include "solver/index.h"
#include "solver/kernels/kernels.h"

namespace perfora::solver {
namespace {

/// Sums of F_j,a r_b of every disc.
class DiscStresses {
 public:
  explicit DiscStresses(std::size_t discs) : sums_(discs) {}

  /// Force (fx, fy) on j, branch (rx, ry) from i to j.
  void add(std::int32_t i, std::int32_t j, double fx, double fy, double rx, double ry) {
    for (const std::int32_t disc : {i, j}) {
      auto& sum = sums_[at(disc)];
      sum[0] += 0.5 * fx * rx;
      sum[1] += 0.5 * fy * ry;
      sum[2] += 0.25 * (fx * ry + fy * rx);
    }
  }
  std::vector<double> over_areas(const std::vector<double>& radius) const {
    std::vector<double> stress;
    stress.reserve(3 * sums_.size());
    for (std::size_t d = 0; d < sums_.size(); ++d)
      for (const double sum : sums_[d]) stress.push_back(sum / (std::numbers::pi * radius[d] * radius[d]));
    return stress;
  }

 private:
  std::vector<std::array<double, 3>> sums_;
};

/// In the order of frame.bond_pairs: intact bonds by rising id.
void add_bonds(results::Frame& frame, const Simulation& simulation, const BondLaw& law, DiscStresses& stresses) {
  const BondNetwork& network = simulation.network();
  const DiscState& discs = simulation.discs();
  for (std::size_t b = 0; b < network.i.size(); ++b) {
    if (network.state[b] != BondState::intact) continue;
    const std::int32_t i = network.i[b], j = network.j[b];
    const double l0 = network.reference_length[b];
    const BondKinematics k =
        kinematics_of(discs, i, j, simulation.cell(), network.direction_x[b], network.direction_y[b], l0);
    const double contact_distance = std::min(discs.radius[at(i)] + discs.radius[at(j)], l0);
    const BondForce force =
        bond_force(law, {k.delta_n, k.delta_t, std::max(0.0, contact_distance - k.length)}, network.damage[b]);
    frame.bond_normal_force.push_back(force.normal);
    frame.bond_shear_force.push_back(force.shear);
    stresses.add(i, j, -(force.normal * k.nx + force.shear * k.tx), -(force.normal * k.ny + force.shear * k.ty),
                 k.length * k.nx, k.length * k.ny);
  }
}

void add_contacts(results::Frame& frame, const Simulation& simulation, const ContactLaw& law, DiscStresses& stresses) {
  const NeighbourList& near = simulation.neighbour_list();
  const DiscState& discs = simulation.discs();
  const CellMatrix& cell = simulation.cell();
  for (std::int32_t i = 0; i < discs.size(); ++i)
    for (std::int32_t k = near.row_begin(i); k < near.row_end(i); ++k) {
      const NeighbourSlot& slot = near.slots()[at(k)];
      const std::int32_t j = slot.neighbour;
      if (j <= i || slot.bonded != 0) continue;
      const double dx = reduced(discs.sx[at(j)] - discs.sx[at(i)]), dy = reduced(discs.sy[at(j)] - discs.sy[at(i)]);
      const double rx = cell.xx * dx + cell.xy * dy, ry = cell.yy * dy, length = std::hypot(rx, ry);
      const double sum_radii = discs.radius[at(i)] + discs.radius[at(j)];
      const double overlap = (length > sum_radii ? sum_radii : slot.contact_distance) - length;
      if (!(overlap > 0.0)) continue;
      const double normal = std::max(0.0, law.normal_stiffness * overlap + slot.history.viscous_force);
      const double shear = law.tangential_stiffness * slot.history.shear;
      const double nx = rx / length, ny = ry / length;
      frame.contact_pairs.insert(frame.contact_pairs.end(), {i, j});
      frame.contact_normal_force.push_back(normal);
      frame.contact_shear_force.push_back(shear);
      stresses.add(i, j, normal * nx + shear * ny, normal * ny - shear * nx, rx, ry);
    }
}

}  // namespace

void add_forces(results::Frame& frame, const Simulation& simulation, const SolverOptions& options,
                double mean_diameter) {
  if (options.output.frame_data == FrameData::few) return;
  const DiscState& discs = simulation.discs();
  frame.velocity.reserve(2 * discs.vx.size());
  for (std::size_t d = 0; d < discs.vx.size(); ++d)
    frame.velocity.insert(frame.velocity.end(), {discs.vx[d], discs.vy[d]});
  frame.spin = discs.omega;
  DiscStresses stresses(discs.radius.size());
  add_bonds(frame, simulation, make_bond_law(options.material, mean_diameter), stresses);
  add_contacts(frame, simulation, make_contact_law(options.material), stresses);
  frame.stress = stresses.over_areas(discs.radius);
}

}  // namespace perfora::solver
