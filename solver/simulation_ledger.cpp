// What is here: the energies and the number of contacts of a simulation as it stands, added up in fixed chunks, so that
// their bits do not depend on the number of threads. What is not: the step (simulation.cpp).
#include <algorithm>
#include <cmath>

#include "solver/index.h"
#include "solver/simulation.h"

namespace perfora::solver {
namespace {

constexpr std::int64_t chunk_bonds = 4096;

/// Sum over 0..count of part(first, last) for chunks of `size`, in their order.
template <class Sum, class Part>
Sum sum_of_chunks(std::int64_t count, std::int64_t size, int threads, const Part& part) {
  const std::int64_t chunks = (count + size - 1) / size;
  std::vector<Sum> sums(static_cast<std::size_t>(chunks));
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::int64_t c = 0; c < chunks; ++c)
    sums[static_cast<std::size_t>(c)] = part(c * size, std::min(count, (c + 1) * size));
  Sum total{};
  for (const Sum& sum : sums) total = total + sum;
  return total;
}

/// What the last half kick to the full step does to kinetic energy and damping.
struct HalfKick {
  double kinetic = 0.0, cundall = 0.0;
  HalfKick operator+(const HalfKick& o) const { return {kinetic + o.kinetic, cundall + o.cundall}; }
};

}  // namespace

Ledger Simulation::ledger() const {
  backend_->export_contact_history(neighbour_list_);
  Ledger ledger = progress_.ledger;
  ledger.elastic_contacts += walls_.elastic_energy(discs_, now_);
  const double half = 0.5 * time_step_;
  const auto kick =
      sum_of_chunks<HalfKick>(discs_.size(), chunk_discs, threads_, [&](std::int64_t d, std::int64_t end) {
        HalfKick sum;
        for (auto k = static_cast<std::size_t>(d); k < static_cast<std::size_t>(end); ++k) {
          const double vx = discs_.vx[k], vy = discs_.vy[k], w = discs_.omega[k], c = damping_.of_force(k);
          const double fx = damped(discs_.fx[k], vx, c), fy = damped(discs_.fy[k], vy, c),
                       torque = damped(discs_.torque[k], w, damping_.rotation_ratio() * c);
          const double nvx = vx + half * fx * inverse_mass_[k], nvy = vy + half * fy * inverse_mass_[k],
                       nw = w + half * torque * inverse_inertia_[k];
          sum.cundall -= 0.5 * half *
                         ((fx - discs_.fx[k]) * (vx + nvx) + (fy - discs_.fy[k]) * (vy + nvy) +
                          (torque - discs_.torque[k]) * (w + nw));
          sum.kinetic += 0.5 * (discs_.mass[k] * (nvx * nvx + nvy * nvy) + discs_.inertia[k] * nw * nw);
        }
        return sum;
      });
  ledger.cundall += kick.cundall;
  ledger.kinetic += kick.kinetic;
  ledger.elastic_bonds +=
      sum_of_chunks<double>(network_.size(), chunk_bonds, threads_, [&](std::int64_t first, std::int64_t last) {
        double sum = 0.0;
        for (auto id = static_cast<std::size_t>(first); id < static_cast<std::size_t>(last); ++id) {
          if (network_.state[id] != BondState::intact) continue;
          const std::int32_t i = network_.i[id], j = network_.j[id];
          const BondKinematics k = kinematics_of(discs_, i, j, now_, network_.direction_x[id], network_.direction_y[id],
                                                 network_.reference_length[id]);
          const double contact_distance =
              std::min(discs_.radius[at(i)] + discs_.radius[at(j)], network_.reference_length[id]);
          sum += bond_energy(bond_law_, {k.delta_n, k.delta_t, std::max(0.0, contact_distance - k.length)},
                             network_.damage[id]);
        }
        return sum;
      });
  ledger.elastic_contacts +=
      sum_of_chunks<double>(discs_.size(), chunk_discs, threads_, [&](std::int64_t first, std::int64_t last) {
        double sum = 0.0;
        for (auto i = static_cast<std::int32_t>(first); i < last; ++i)
          for (std::int32_t k = neighbour_list_.row_begin(i); k < neighbour_list_.row_end(i); ++k) {
            const NeighbourSlot& slot = neighbour_list_.slots()[at(k)];
            if (slot.bonded != 0 || slot.neighbour < i) continue;
            const double overlap = std::max(0.0, slot.contact_distance - distance(i, slot.neighbour));
            sum += 0.5 * (contact_law_.normal_stiffness * overlap * overlap +
                          contact_law_.tangential_stiffness * slot.history.shear * slot.history.shear);
          }
        return sum;
      });
  return ledger;
}

std::int64_t Simulation::contacts() const {
  backend_->export_contact_history(neighbour_list_);
  return sum_of_chunks<std::int64_t>(discs_.size(), chunk_discs, threads_, [&](std::int64_t first, std::int64_t last) {
    std::int64_t count = 0;
    for (auto i = static_cast<std::int32_t>(first); i < last; ++i) {
      if (neighbour_list_.active(i) == 0) continue;
      for (std::int32_t k = neighbour_list_.row_begin(i); k < neighbour_list_.row_end(i); ++k) {
        const NeighbourSlot& slot = neighbour_list_.slots()[at(k)];
        if (slot.bonded == 0 && slot.neighbour > i && distance(i, slot.neighbour) < slot.contact_distance) ++count;
      }
    }
    return count;
  });
}

double Simulation::distance(std::int32_t i, std::int32_t j) const {
  const double dx = reduced(discs_.sx[at(j)] - discs_.sx[at(i)]), dy = reduced(discs_.sy[at(j)] - discs_.sy[at(i)]);
  const double x = now_.xx * dx + now_.xy * dy, y = now_.yy * dy;
  return std::sqrt(x * x + y * y);
}

}  // namespace perfora::solver
