// What is here: forces between discs and walls, their contact history, and the forces on the walls.
#include "solver/walls.h"

#include <algorithm>
#include <cmath>

namespace perfora::solver {
namespace {

bool across(WallSide side) {
  return side == WallSide::bottom || side == WallSide::top;
}

/// Component of the normal, which points into the block.
double inward(WallSide side) {
  return side == WallSide::bottom || side == WallSide::left ? 1.0 : -1.0;
}

}  // namespace

Walls::Walls(std::vector<WallPlace> places, const ContactLaw& contact, double critical_stretch, const DiscState& discs,
             const CellMatrix& cell)
    : places_(std::move(places)), law_(contact), critical_stretch_(critical_stretch), discs_(discs.sx.size()) {
  for (const WallPlace& place : places_) fixed_.push_back(fixed_point(place.reduced));
  contact_.resize(places_.size() * discs_);
  for (std::size_t w = 0; w < places_.size(); ++w) {
    for (std::size_t d = 0; d < discs_; ++d)
      contact_[w * discs_ + d].contact_distance = std::min(discs.radius[d], distance(w, d, discs, cell));
    for (const FaceStiffness& face : places_[w].face_stiffness) {
      const auto d = static_cast<std::size_t>(face.disc);
      contact_[w * discs_ + d] = {distance(w, d, discs, cell), face.normal_stiffness, face.tangential_stiffness, {}};
    }
  }
  if (!empty()) chunk_sums_.resize((discs_ + chunk_discs - 1) / chunk_discs);
}

double Walls::distance(std::size_t w, std::size_t d, const DiscState& discs, const CellMatrix& cell) const {
  const WallPlace& place = places_[w];
  const bool y = across(place.side);
  double fraction = inward(place.side) * reduced((y ? discs.sy[d] : discs.sx[d]) - fixed_[w]);
  if (fraction < -place.behind)
    fraction += 1.0;  // beyond the middle of the vacuum: the far end of the block, seen from here
  return fraction * (y ? cell.yy : cell.xx);
}

ContactLaw Walls::law_of(const Contact& contact, std::size_t w) const {
  ContactLaw law = law_;
  law.friction_coefficient = places_[w].friction;
  if (contact.has_face_stiffness()) {
    law.normal_stiffness = contact.face_normal_stiffness;
    law.tangential_stiffness = contact.face_tangential_stiffness;
    law.viscous_rate = 0.0;
  }
  return law;
}

/// Wall i, disc j, n into the block: laws.h's contact with the disc's own mass (the wall's is infinite) and its
/// distance as lever. Relative velocity: v' + L (x - nearest point of the wall).
void Walls::wall_contact(ForceStep& step, std::size_t w, std::size_t d, ChunkSums& chunk) {
  DiscState& discs = step.discs;
  Contact& contact = contact_[w * discs_ + d];
  const double lever = distance(w, d, discs, step.cell);
  const double radius = discs.radius[d];
  const double lost_at =
      contact.has_face_stiffness() ? std::max(radius, contact.contact_distance + critical_stretch_) : radius;
  const bool lost = lever > lost_at;
  const double overlap = contact.contact_distance - lever;
  const bool open = !(overlap > 0.0);
  const ContactLaw law = law_of(contact, w);
  if (lost) {
    contact.contact_distance = radius;
    contact.face_normal_stiffness = contact.face_tangential_stiffness = 0.0;
  }
  if (open && contact.history.shear == 0.0 && contact.history.viscous_force == 0.0) return;
  const bool y = across(places_[w].side);
  const double nx = y ? 0.0 : inward(places_[w].side), ny = y ? inward(places_[w].side) : 0.0;
  const double rx = lever * nx, ry = lever * ny;
  const VelocityGradient& l = step.gradient;
  const double ux = discs.vx[d] + l.xx * rx + l.xy * ry, uy = discs.vy[d] + l.yy * ry;
  const double v_n = ux * nx + uy * ny;
  const double v_t = uy * nx - ux * ny - lever * discs.omega[d];
  if (open) {
    const ContactForce rest = contact_opening(law, v_n, v_t, step.dt, contact.history);
    chunk.sums.friction += rest.friction;
    chunk.sums.viscous += rest.viscous;
    return;
  }
  const ContactForce f = contact_force(law, overlap, v_n, v_t, discs.mass[d], step.dt, contact.history);
  const double px = f.normal * nx + f.shear * ny, py = f.normal * ny - f.shear * nx;
  discs.fx[d] += px;
  discs.fy[d] += py;
  discs.torque[d] += lever * f.shear;
  chunk.force[w][0] += px;
  chunk.force[w][1] += py;
  Virial& v = chunk.sums.virial;
  v.xx += px * rx;
  v.xy += px * ry;
  v.yx += py * rx;
  v.yy += py * ry;
  chunk.sums.friction += f.friction;
  chunk.sums.viscous += f.viscous;
  // The residual stiffness stands for bonds, whose shortening is no overlap of discs.
  if (!contact.has_face_stiffness()) chunk.sums.largest_overlap = std::max(chunk.sums.largest_overlap, overlap);
}

void Walls::add_forces(ForceStep& step, int threads, StepSums& sums) {
  if (empty()) return;
  const auto chunks = static_cast<std::int64_t>(chunk_sums_.size());
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::int64_t chunk = 0; chunk < chunks; ++chunk) {
    ChunkSums own;
    const std::size_t begin = static_cast<std::size_t>(chunk) * chunk_discs;
    for (std::size_t d = begin; d < std::min(discs_, begin + chunk_discs); ++d)
      for (std::size_t w = 0; w < places_.size(); ++w) wall_contact(step, w, d, own);
    chunk_sums_[static_cast<std::size_t>(chunk)] = own;
  }
  force_ = {};
  for (const ChunkSums& chunk : chunk_sums_) {
    sums.add(chunk.sums);
    for (std::size_t w = 0; w < places_.size(); ++w)
      for (std::size_t a = 0; a < 2; ++a) force_[w][a] += chunk.force[w][a];
  }
}

double Walls::elastic_energy(const DiscState& discs, const CellMatrix& cell) const {
  double energy = 0.0;
  for (std::size_t w = 0; w < places_.size(); ++w)
    for (std::size_t d = 0; d < discs_; ++d) {
      const Contact& contact = contact_[w * discs_ + d];
      const double overlap = std::max(0.0, contact.contact_distance - distance(w, d, discs, cell));
      const ContactLaw law = law_of(contact, w);
      energy += 0.5 * (law.normal_stiffness * overlap * overlap +
                       law.tangential_stiffness * contact.history.shear * contact.history.shear);
    }
  return energy;
}

void Walls::add_to_row(const CellMatrix& edges, double weight) {
  if (empty()) return;
  for (std::size_t w = 0; w < places_.size(); ++w) {
    const bool y = across(places_[w].side);
    pressure_[w] = inward(places_[w].side) * force_[w][y ? 1 : 0] / (y ? edges.xx : edges.yy);
    row_sum_[w] += weight * pressure_[w];
  }
  row_weight_ += weight;
}

void Walls::reset_row() {
  row_sum_ = {};
  row_weight_ = 0.0;
}

double Walls::row_pressure(std::size_t w) const {
  return row_weight_ > 0.0 ? row_sum_[w] / row_weight_ : pressure_[w];
}

Walls::Snapshot Walls::snapshot() const {
  Snapshot s;
  for (const Contact& contact : contact_) {
    s.contact_distance.push_back(contact.contact_distance);
    s.shear.push_back(contact.history.shear);
    s.viscous_force.push_back(contact.history.viscous_force);
    s.has_face_stiffness.push_back(contact.has_face_stiffness() ? 1 : 0);
  }
  s.row.insert(s.row.end(), pressure_.begin(), pressure_.end());
  s.row.insert(s.row.end(), row_sum_.begin(), row_sum_.end());
  s.row.push_back(row_weight_);
  return s;
}

void Walls::restore(const Snapshot& s) {
  if (empty()) return;
  for (std::size_t k = 0; k < contact_.size(); ++k) {
    Contact& contact = contact_[k];
    contact.contact_distance = s.contact_distance.at(k);
    contact.history = {s.shear.at(k), s.viscous_force.at(k)};
    if (s.has_face_stiffness.at(k) == 0) contact.face_normal_stiffness = contact.face_tangential_stiffness = 0.0;
  }
  for (std::size_t w = 0; w < pressure_.size(); ++w) {
    pressure_[w] = s.row.at(w);
    row_sum_[w] = s.row.at(pressure_.size() + w);
  }
  row_weight_ = s.row.at(2 * pressure_.size());
}

}  // namespace perfora::solver
