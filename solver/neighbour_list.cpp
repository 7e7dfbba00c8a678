// What is here: building and keeping the list of near pairs.
#include "solver/neighbour_list.h"
#include "solver/index.h"

#include <algorithm>
#include <cmath>

namespace perfora::solver {
void NeighbourList::configure(std::int32_t discs, double largest_radius, double skin) {
  largest_radius_ = largest_radius;
  skin_ = skin;
  constexpr std::size_t usual_neighbours = 12;  // of a dense polydisperse packing within the skin
  slots_.reserve(at(discs) * usual_neighbours);
  old_slots_.reserve(at(discs) * usual_neighbours);
  start_.assign(at(discs) + 1, 0);
  old_start_.assign(at(discs) + 1, 0);
  active_.assign(at(discs), 0);
}

/// Bonds are sorted by (i, j): rows of i, made once.
void NeighbourList::find_bond_rows(const BondNetwork& network, std::int32_t discs) {
  if (first_bond_.size() == at(discs) + 1) return;
  first_bond_.assign(at(discs) + 1, 0);
  for (const std::int32_t i : network.i) ++first_bond_[at(i) + 1];
  for (std::size_t k = 1; k < first_bond_.size(); ++k) first_bond_[k] += first_bond_[k - 1];
}

bool NeighbourList::intact(const BondNetwork& network, std::int32_t i, std::int32_t j) const {
  const auto [low, high] = std::minmax(i, j);
  const auto begin = network.j.begin() + first_bond_[at(low)], end = network.j.begin() + first_bond_[at(low) + 1];
  const auto found = std::lower_bound(begin, end, high);
  return found != end && *found == high &&
         network.state[static_cast<std::size_t>(found - network.j.begin())] == BondState::intact;
}

void NeighbourList::list_row(std::int32_t i, const DiscState& discs, const CellMatrix& cell, const BondNetwork& network,
                             std::vector<NeighbourSlot>& slots) {
  const std::size_t first = slots.size();
  grid_.around(i, [&](std::int32_t j) {
    const double dx = reduced(discs.sx[at(j)] - discs.sx[at(i)]), dy = reduced(discs.sy[at(j)] - discs.sy[at(i)]);
    const double rx = cell.xx * dx + cell.xy * dy, ry = cell.yy * dy;
    const double contact = discs.radius[at(i)] + discs.radius[at(j)];
    const double limit = contact + skin_;
    if (rx * rx + ry * ry < limit * limit) slots.push_back({j, 0, contact, {}});
  });
  const auto begin = slots.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, slots.end(),
            [](const NeighbourSlot& a, const NeighbourSlot& b) { return a.neighbour < b.neighbour; });
  std::int32_t active = 0, old = old_start_[at(i)];
  const std::int32_t old_end = old_start_[at(i) + 1];
  for (auto slot = begin; slot != slots.end(); ++slot) {
    while (old < old_end && old_slots_[at(old)].neighbour < slot->neighbour) ++old;
    if (old < old_end && old_slots_[at(old)].neighbour == slot->neighbour) {
      *slot = old_slots_[at(old)];
    } else {
      slot->bonded = intact(network, i, slot->neighbour) ? 1 : 0;
    }
    active += slot->bonded ? 0 : 1;
  }
  active_[at(i)] = active;
  start_[at(i) + 1] = static_cast<std::int32_t>(slots.size() - first);
}

void NeighbourList::rebuild(const DiscState& discs, const CellMatrix& cell, const BondNetwork& network, int threads) {
  const std::int32_t n = discs.size(), chunks = (n + chunk_discs - 1) / chunk_discs;
  find_bond_rows(network, n);
  std::swap(slots_, old_slots_);
  std::swap(start_, old_start_);
  const double reach = 2.0 * largest_radius_ + skin_;
  // With shear the rows of bins are inclined: a bin must hold the offset, too.
  const double reach_y = reach / cell.yy, reach_x = (reach + std::fabs(cell.xy) * reach_y) / cell.xx;
  grid_.build(n, std::min(1.0, reach_x), std::min(1.0, reach_y), [&](std::int32_t k) {
    return std::pair{static_cast<double>(discs.sx[at(k)] >> 11) * 0x1p-53,
                     static_cast<double>(discs.sy[at(k)] >> 11) * 0x1p-53};
  });
  chunk_slots_.resize(at(chunks));
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::int32_t c = 0; c < chunks; ++c) {
    chunk_slots_[at(c)].clear();
    for (std::int32_t i = c * chunk_discs; i < std::min(n, (c + 1) * chunk_discs); ++i)
      list_row(i, discs, cell, network, chunk_slots_[at(c)]);
  }
  slots_.clear();
  for (const auto& part : chunk_slots_) slots_.insert(slots_.end(), part.begin(), part.end());
  start_[0] = 0;
  for (std::int32_t i = 0; i < n; ++i) start_[at(i) + 1] += start_[at(i)];
  reference_x_ = discs.sx;
  reference_y_ = discs.sy;
  reference_cell_ = cell;
  ++rebuilds_;
}

bool NeighbourList::outdated(double largest_displacement, const CellMatrix& cell) const {
  // A pair at reduced distance ds moved by (H - H0) ds = (H - H0) H0^-1 r0: its Frobenius norm times the largest listed
  // distance bounds the affine part.
  const CellMatrix& h = reference_cell_;
  const double exx = (cell.xx - h.xx) / h.xx, eyy = (cell.yy - h.yy) / h.yy;
  const double exy = ((cell.xy - h.xy) - exx * h.xy) / h.yy;
  const double affine = std::sqrt(exx * exx + exy * exy + eyy * eyy) * (2.0 * largest_radius_ + skin_);
  return 2.0 * largest_displacement + affine >= skin_;
}

double NeighbourList::largest_displacement(const DiscState& discs, const CellMatrix& cell) const {
  double largest = 0.0;
  for (std::size_t d = 0; d < reference_x_.size(); ++d) {
    const double ux = reduced(discs.sx[d] - reference_x_[d]), uy = reduced(discs.sy[d] - reference_y_[d]);
    const double mx = cell.xx * ux + cell.xy * uy, my = cell.yy * uy;
    largest = std::max(largest, mx * mx + my * my);
  }
  return std::sqrt(largest);
}

NeighbourSlot* NeighbourList::find(std::int32_t i, std::int32_t j) {
  for (std::int32_t k = row_begin(i); k < row_end(i); ++k)
    if (slots_[at(k)].neighbour == j) return &slots_[at(k)];
  return nullptr;
}

std::int32_t NeighbourList::release(std::int32_t i, std::int32_t j, double contact_distance) {
  NeighbourSlot* slot = find(i, j);
  if (slot == nullptr || slot->bonded == 0) return -1;
  slot->bonded = 0;
  slot->contact_distance = contact_distance;
  slot->history = {};
  ++active_[at(i)];
  return static_cast<std::int32_t>(slot - slots_.data());
}

NeighbourList::Snapshot NeighbourList::snapshot() const {
  Snapshot s;
  s.start = start_;
  s.active = active_;
  for (const NeighbourSlot& slot : slots_) {
    s.neighbour.push_back(slot.neighbour);
    s.bonded.push_back(slot.bonded);
    s.contact_distance.push_back(slot.contact_distance);
    s.shear.push_back(slot.history.shear);
    s.viscous_force.push_back(slot.history.viscous_force);
  }
  s.reference_x = reference_x_;
  s.reference_y = reference_y_;
  s.reference_cell = reference_cell_;
  s.rebuilds = rebuilds_;
  return s;
}

void NeighbourList::restore(const Snapshot& s) {
  start_ = s.start;
  active_ = s.active;
  slots_.resize(s.neighbour.size());
  for (std::size_t k = 0; k < slots_.size(); ++k)
    slots_[k] = {s.neighbour[k], s.bonded[k], s.contact_distance[k], {s.shear[k], s.viscous_force[k]}};
  reference_x_ = s.reference_x;
  reference_y_ = s.reference_y;
  reference_cell_ = s.reference_cell;
  rebuilds_ = s.rebuilds;
}

}  // namespace perfora::solver
