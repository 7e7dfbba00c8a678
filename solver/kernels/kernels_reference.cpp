// What is here: the reference backend: sequential, double, each pair once, as plain as the formulas. The oracle of
// every other backend.
#include <algorithm>
#include <cmath>

#include "solver/index.h"
#include "solver/kernels/kernels.h"

namespace perfora::solver {
namespace {

struct Branch {
  double x, y;
};

/// r_j - r_i from fixed-point positions: the wrap of the subtraction is the minimum image.
Branch branch(const DiscState& discs, std::int32_t i, std::int32_t j, const CellMatrix& cell) {
  const double dx = reduced(discs.sx[at(j)] - discs.sx[at(i)]), dy = reduced(discs.sy[at(j)] - discs.sy[at(i)]);
  return {cell.xx * dx + cell.xy * dy, cell.yy * dy};
}

class ReferenceBackend final : public ForceBackend {
 public:
  ReferenceBackend(const BondLaw& bond, const ContactLaw& contact) : bond_(bond), contact_(contact) {}

  void load(const BondNetwork&, const DiscState&, const CellMatrix&) override {}
  void set_neighbours(const NeighbourList&, const DiscState&) override {}
  void export_contact_history(NeighbourList&) const override {}
  void set_threads(int) override {}

  StepSums forces(ForceStep& step) override {
    std::fill(step.discs.fx.begin(), step.discs.fx.end(), 0.0);
    std::fill(step.discs.fy.begin(), step.discs.fy.end(), 0.0);
    std::fill(step.discs.torque.begin(), step.discs.torque.end(), 0.0);
    StepSums sums;
    for (std::int64_t b = 0; b < step.network.size(); ++b)
      if (step.network.state[static_cast<std::size_t>(b)] == BondState::intact)
        bond(step, static_cast<std::int32_t>(b), sums);
    for (std::int32_t i = 0; i < step.discs.size(); ++i)
      for (std::int32_t k = step.neighbour_list.row_begin(i); k < step.neighbour_list.row_end(i); ++k) {
        NeighbourSlot& slot = step.neighbour_list.slots()[at(k)];
        if (slot.neighbour > i && slot.bonded == 0) contact(step, i, slot, sums);
      }
    return sums;
  }

  std::string simd() const override { return "none (reference)"; }

 private:
  /// Adds force f on j (and -f on i) with branch r.
  static void add_pair(DiscState& discs, std::int32_t i, std::int32_t j, const Branch& r, double fx, double fy,
                       StepSums& sums) {
    discs.fx[at(j)] += fx;
    discs.fy[at(j)] += fy;
    discs.fx[at(i)] -= fx;
    discs.fy[at(i)] -= fy;
    sums.virial.xx += fx * r.x;
    sums.virial.xy += fx * r.y;
    sums.virial.yx += fy * r.x;
    sums.virial.yy += fy * r.y;
  }

  void bond(ForceStep& step, std::int32_t id, StepSums& sums) {
    BondNetwork& net = step.network;
    DiscState& discs = step.discs;
    const std::int32_t i = net.i[at(id)], j = net.j[at(id)];
    const Branch r = branch(discs, i, j, step.cell);
    const BondKinematics k = kinematics_of(discs, i, j, step.cell, net.direction_x[at(id)], net.direction_y[at(id)],
                                           net.reference_length[at(id)]);
    const double sum_radii = discs.radius[at(i)] + discs.radius[at(j)];
    const double contact_distance = std::min(sum_radii, net.reference_length[at(id)]);
    const BondPoint now{k.delta_n, k.delta_t, std::max(0.0, contact_distance - k.length)};
    const double damage = updated_damage(bond_, k.delta_n, k.delta_t, net.strength[at(id)], net.damage[at(id)]);
    if (damage > net.damage[at(id)]) {
      const BondKinematics old = kinematics_before(discs, i, j, step.cell_before, net.direction_x[at(id)],
                                                   net.direction_y[at(id)], net.reference_length[at(id)]);
      const BondPoint before{old.delta_n, old.delta_t, std::max(0.0, contact_distance - old.length)};
      sums.damage += damageable_energy(bond_, before, now) * (damage - net.damage[at(id)]);
      net.damage[at(id)] = damage;
      if (damage >= 1.0) {
        sums.damage += compression_release(bond_, before, now, net.reference_length[at(id)] <= sum_radii);
        net.state[at(id)] = BondState::broken;
        step.broken.push_back(id);
        step.neighbour_list.release(i, j, contact_distance);
        step.neighbour_list.release(j, i, contact_distance);
        return;
      }
    }
    const BondForce f = bond_force(bond_, now, damage);
    add_pair(discs, i, j, r, -(f.normal * k.nx + f.shear * k.tx), -(f.normal * k.ny + f.shear * k.ty), sums);
    const double torque = 0.5 * f.shear * k.along;
    discs.torque[at(i)] += torque;
    discs.torque[at(j)] += torque;
  }

  void contact(ForceStep& step, std::int32_t i, NeighbourSlot& slot, StepSums& sums) {
    DiscState& discs = step.discs;
    const std::int32_t j = slot.neighbour;
    const Branch r = branch(discs, i, j, step.cell);
    const double length = std::sqrt(r.x * r.x + r.y * r.y);
    const double nx = r.x / length, ny = r.y / length;
    const VelocityGradient& l = step.gradient;
    const double ux = discs.vx[at(j)] - discs.vx[at(i)] + (l.xx * r.x + l.xy * r.y);
    const double uy = discs.vy[at(j)] - discs.vy[at(i)] + l.yy * r.y;
    const double v_n = ux * nx + uy * ny;
    const double sum_radii = discs.radius[at(i)] + discs.radius[at(j)];
    if (length > sum_radii) slot.contact_distance = sum_radii;
    const double overlap = slot.contact_distance - length;
    const double lever_i = length * discs.radius[at(i)] / sum_radii, lever_j = length * discs.radius[at(j)] / sum_radii;
    const double v_t = (uy * nx - ux * ny) - (lever_i * discs.omega[at(i)] + lever_j * discs.omega[at(j)]);
    if (overlap > 0.0) {
      const double effective_mass = discs.mass[at(i)] * discs.mass[at(j)] / (discs.mass[at(i)] + discs.mass[at(j)]);
      const ContactForce f = contact_force(contact_, overlap, v_n, v_t, effective_mass, step.dt, slot.history);
      // On j: f_n n - k_t xi t, with t = perp(n) = (-ny, nx).
      add_pair(discs, i, j, r, f.normal * nx + f.shear * ny, f.normal * ny - f.shear * nx, sums);
      discs.torque[at(i)] += lever_i * f.shear;
      discs.torque[at(j)] += lever_j * f.shear;
      sums.friction += f.friction;
      sums.viscous += f.viscous;
      sums.largest_overlap = std::max(sums.largest_overlap, overlap);
    } else if (slot.history.shear != 0.0 || slot.history.viscous_force != 0.0) {
      const ContactForce lost = contact_opening(contact_, v_n, v_t, step.dt, slot.history);
      sums.friction += lost.friction;
      sums.viscous += lost.viscous;
    }
    if (NeighbourSlot* mirror = step.neighbour_list.find(j, i)) {
      mirror->contact_distance = slot.contact_distance;
      mirror->history = slot.history;
    }
  }

  BondLaw bond_;
  ContactLaw contact_;
};

}  // namespace

std::unique_ptr<ForceBackend> make_reference_backend(const BondLaw& bond, const ContactLaw& contact) {
  return std::make_unique<ReferenceBackend>(bond, contact);
}

}  // namespace perfora::solver
