// What is here: the step. Order: cell, kick and drift (leapfrog form of velocity Verlet), neighbour list, forces with
// damage and breaks, ledger.
#include "solver/simulation.h"
#include "solver/index.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace perfora::solver {
namespace {

constexpr double skin_ratio = 0.35;  // Verlet skin over <d>: long enough that rubble rebuilds every few hundred steps
/// Share of the skin at which a list is renewed when displacements are looked at; below it, looking often would cost
/// more than a list.
constexpr double renewal_fraction = 0.9;
constexpr std::int64_t compaction_stride = 1024;  // steps between looks at the fraction of empty slots
constexpr double compaction_fraction = 0.02;      // of the intact bonds: then rows are compacted

/// sum V_ab (dH H^-1)_ab, the affine part of the pair work, for upper-triangular matrices.
double affine_work(const Virial& v, const CellMatrix& change, const CellMatrix& h) {
  const double gxx = change.xx / h.xx, gyy = change.yy / h.yy;
  const double gxy = (change.xy - gxx * h.xy) / h.yy;
  return v.xx * gxx + v.xy * gxy + v.yy * gyy;
}

/// DiscState::position_shift: how often the cell may be halved so that a branch of `longest` (m) still fits into half
/// of what is left, down to the shortest edge that any run may reach: resuming to a larger strain changes nothing.
int record_shift(const CellMatrix& start, double longest_bond, double longest_contact) {
  constexpr double stretched = 1.2;  // no bond bears more
  constexpr int finest = 6;          // 2^-38 of the cell: beyond it floats round more than the record does
  const double edge = std::min(start.xx, (1.0 - largest_run_strain) * start.yy);
  const double longest = std::max(stretched * longest_bond, longest_contact);
  return std::clamp(static_cast<int>(std::floor(std::log2(0.5 * edge / longest))), 0, finest);
}

}  // namespace

Simulation::Simulation(SimulationInput input)
    : options_(std::move(input.options)),
      cell_(input.cell),
      loading_(input.loading),
      block_(input.block),
      now_(input.cell.start),
      before_(input.cell.start),
      time_step_(input.time_step),
      threads_(std::max(1, input.threads)),
      bond_law_(make_bond_law(options_.material, input.mean_diameter)),
      contact_law_(make_contact_law(options_.material)),
      network_(std::move(input.network)) {
  const geometry::Packing& packing = *input.clipped;
  const std::size_t n = packing.x.size();
  discs_.resize(n);
  double largest_radius = 0.0;
  for (std::size_t d = 0; d < n; ++d) {
    const double s_y = packing.y[d] / now_.yy;
    const double s_x = (packing.x[d] - now_.xy * s_y) / now_.xx;
    discs_.sx[d] = fixed_point(s_x - std::floor(s_x));
    discs_.sy[d] = fixed_point(s_y - std::floor(s_y));
    discs_.radius[d] = packing.radius[d];
    largest_radius = std::max(largest_radius, packing.radius[d]);
  }
  discs_.mass = std::move(input.masses.mass);
  discs_.inertia = std::move(input.masses.inertia);
  for (std::size_t d = 0; d < n; ++d) {
    inverse_mass_.push_back(1.0 / discs_.mass[d]);
    inverse_inertia_.push_back(1.0 / discs_.inertia[d]);
  }
  damping_ = CundallDamping(options_.dynamics, network_, n);
  discs_.position_shift = record_shift(now_, input.mean_diameter * options_.material.horizon,
                                       2.0 * largest_radius + skin_ratio * input.mean_diameter);
  refresh_records();
  neighbour_list_.configure(discs_.size(), largest_radius, skin_ratio * input.mean_diameter);
  neighbour_list_.rebuild(discs_, now_, network_, threads_);
  walls_ = Walls(std::move(input.walls), contact_law_, 1.0 / bond_law_.inverse_critical_normal, discs_, now_);
  backend_ = options_.dynamics.kernel == KernelChoice::reference
                 ? make_reference_backend(bond_law_, contact_law_)
                 : make_openmp_backend(bond_law_, contact_law_, threads_, options_.dynamics.simd);
  backend_->load(network_, discs_, cell_.start);
  backend_->set_neighbours(neighbour_list_, discs_);
  broken_.reserve(static_cast<std::size_t>(network_.size()));
  events_.reserve(static_cast<std::size_t>(network_.size()));
  chunk_sums_.resize((n + chunk_discs - 1) / chunk_discs);
  progress_.intact = static_cast<double>(network_.size());
  progress_.cell = now_;
}

void Simulation::refresh_records() {
  for (std::size_t d = 0; d < discs_.sx.size(); ++d) discs_.refresh_record(d);
  discs_.sx_before = discs_.sx;
  discs_.sy_before = discs_.sy;
  discs_.half_angle_before = discs_.half_angle;
}

void Simulation::move_discs() {
  std::swap(discs_.sx, discs_.sx_before);
  std::swap(discs_.sy, discs_.sy_before);
  std::swap(discs_.half_angle, discs_.half_angle_before);
  const KickAndDrift task{discs_,
                          inverse_mass_.data(),
                          inverse_inertia_.data(),
                          time_step_,
                          damping_.coefficients(),
                          damping_.rotation_ratio(),
                          {0.5 * (before_.xx + now_.xx), 0.5 * (before_.xy + now_.xy), 0.5 * (before_.yy + now_.yy)}};
  const auto chunks = static_cast<std::int32_t>(chunk_sums_.size());
#pragma omp parallel for schedule(static) num_threads(threads_) if (threads_ > 1)
  for (std::int32_t chunk = 0; chunk < chunks; ++chunk)
    chunk_sums_[at(chunk)] =
        kick_and_drift(task, chunk * chunk_discs, std::min(discs_.size(), (chunk + 1) * chunk_discs));
  double speed_squared = 0.0;
  for (const KickSums& sums : chunk_sums_) {
    progress_.ledger.cundall += sums.cundall;
    speed_squared = std::max(speed_squared, sums.speed_squared);
  }
  progress_.travelled += std::sqrt(speed_squared) * time_step_;
}

void Simulation::keep_near_pairs() {
  if (!neighbour_list_.outdated(progress_.travelled, now_)) return;
  // No disc has gone farther than `travelled`; most have gone less.
  progress_.travelled = neighbour_list_.largest_displacement(discs_, now_);
  if (!neighbour_list_.outdated(progress_.travelled / renewal_fraction, now_)) return;
  backend_->export_contact_history(neighbour_list_);
  neighbour_list_.rebuild(discs_, now_, network_, threads_);
  backend_->set_neighbours(neighbour_list_, discs_);
  progress_.travelled = 0.0;
}

void Simulation::move_cell() {
  before_ = now_;
  const Virial s = stress();
  LoadingState& path = progress_.loading;
  const bool driven = loading_.segment_strain > 0.0;
  if (driven && path.steps == 0.0) {
    const double motion = kinetic_energy_at_half_step() + progress_.ledger.cundall + progress_.ledger.viscous;
    begin_segment(loading_, measure_segment(loading_, motion, peak_frozen(), path), path);
  }
  ++progress_.steps;
  now_ = cell_.next(before_, {s.xx, 0.5 * (s.xy + s.yx), s.yy}, time(), time_step_);
  if (driven) {
    path.step += 1.0;
    path.stress_sum += s.yy;
    now_.yy = cell_.start.yy * (1.0 - path_strain(path));
    if (path.step == path.steps) finish_segment(loading_, path);
  }
  progress_.cell = now_;
}

double Simulation::kinetic_energy_at_half_step() const {
  double sum = 0.0, mass = 0.0, px = 0.0, py = 0.0;
  for (std::int32_t d = 0; d < discs_.size(); ++d) {
    const std::size_t k = at(d);
    const double m = discs_.mass[k], vx = discs_.vx[k], vy = discs_.vy[k], w = discs_.omega[k];
    sum += m * (vx * vx + vy * vy) + discs_.inertia[k] * w * w;
    mass += m;
    px += m * vx;
    py += m * vy;
  }
  return 0.5 * (sum - (px * px + py * py) / mass);
}

void Simulation::step() {
  move_cell();
  move_discs();
  keep_near_pairs();
  broken_.clear();
  ForceStep step{discs_,     network_, neighbour_list_, now_, before_, velocity_gradient(before_, now_, time_step_),
                 time_step_, broken_};
  StepSums sums = backend_->forces(step);
  walls_.add_forces(step, threads_, sums);
  account(sums, before_);
  if (!broken_.empty()) record_breaks();
  compact_when_due();
}

void Simulation::set_threads(int threads) {
  threads_ = std::max(1, threads);
  backend_->set_threads(threads_);
}

void Simulation::account(const StepSums& sums, const CellMatrix& before) {
  Ledger& ledger = progress_.ledger;
  // Trapezoid of the cell's work over the step, with the virial at both ends: what the pair forces take up through the
  // affine motion.
  const CellMatrix change{now_.xx - before.xx, now_.xy - before.xy, now_.yy - before.yy};
  ledger.external_work -=
      0.5 * (affine_work(progress_.virial, change, before) + affine_work(sums.virial, change, now_));
  ledger.damage += sums.damage;
  ledger.friction += sums.friction;
  ledger.viscous += sums.viscous;
  progress_.virial = sums.virial;
  // A row is a mean over strain: a step counts with the strain it makes.
  const double weight = progress_.loading.rate > 0.0 ? progress_.loading.rate : 1.0;
  walls_.add_to_row(block(), weight);
  const Virial s = stress();
  progress_.row_sum.xx += weight * s.xx;
  progress_.row_sum.xy += weight * s.xy;
  progress_.row_sum.yx += weight * s.yx;
  progress_.row_sum.yy += weight * s.yy;
  progress_.row_weight += weight;
  if (!peak_frozen() && s.yy > progress_.peak_stress) {
    progress_.peak_stress = s.yy;
    progress_.peak_strain = strain();
    progress_.peak_step = static_cast<double>(progress_.steps);
  }
  progress_.largest_overlap = std::max(progress_.largest_overlap, sums.largest_overlap);
  progress_.largest_asymmetry = std::max(progress_.largest_asymmetry, std::fabs(s.xy - s.yx));
  progress_.bond_steps += progress_.intact;
}

void Simulation::record_breaks() {
  for (const std::int32_t id : broken_) {
    const std::int32_t i = network_.i[at(id)], j = network_.j[at(id)];
    const BondKinematics k = kinematics_of(discs_, i, j, now_, network_.direction_x[at(id)],
                                           network_.direction_y[at(id)], network_.reference_length[at(id)]);
    const auto [x, y] = position(i);
    results::BreakEvent event;
    event.time = time();
    event.strain = strain();
    event.bond = id;
    event.i = i;
    event.j = j;
    event.x = x + 0.5 * k.nx * k.length;
    event.y = y + 0.5 * k.ny * k.length;
    // Mode: which term of phi(zeta_max), the surface the bond broke on, is larger (docs/user/theory.md, "Bonds").
    const double scale = 1.0 / (network_.strength[at(id)] * bond_law_.rupture_delay);
    const double tension = k.delta_n * bond_law_.inverse_critical_normal * scale;
    const double shear =
        half_integer_power(std::fabs(k.delta_t) * bond_law_.inverse_critical_shear * scale, bond_law_.twice_alpha);
    event.mode = tension > shear ? results::BreakMode::tension : results::BreakMode::shear;
    const double contact_distance =
        std::min(discs_.radius[at(i)] + discs_.radius[at(j)], network_.reference_length[at(id)]);
    const BondPoint point{k.delta_n, k.delta_t, std::max(0.0, contact_distance - k.length)};
    event.energy = damageable_energy(bond_law_, point, point);
    events_.push_back(event);
    damping_.bond_broke(i, j);
  }
  progress_.intact -= static_cast<double>(broken_.size());
  progress_.broken_in_layout += static_cast<double>(broken_.size());
}

void Simulation::compact_when_due() {
  if (progress_.steps % compaction_stride != 0 || progress_.broken_in_layout <= compaction_fraction * progress_.intact)
    return;
  for (BondState& state : network_.state)
    if (state == BondState::broken) state = BondState::compacted;
  progress_.broken_in_layout = 0.0;
  backend_->load(network_, discs_, cell_.start);
}

Virial Simulation::stress() const {
  const double inverse = 1.0 / block().area();
  const Virial& v = progress_.virial;
  return {v.xx * inverse, v.xy * inverse, v.yx * inverse, v.yy * inverse};
}

Virial Simulation::row_stress() const {
  if (progress_.row_weight == 0.0) return stress();
  const double inverse = 1.0 / progress_.row_weight;
  const Virial& v = progress_.row_sum;
  return {v.xx * inverse, v.xy * inverse, v.yx * inverse, v.yy * inverse};
}

void Simulation::reset_row() {
  walls_.reset_row();
  progress_.row_sum = {};
  progress_.row_weight = 0.0;
}

std::pair<double, double> Simulation::position(std::int32_t disc) const {
  return block_.position(discs_.sx[at(disc)], discs_.sy[at(disc)], now_);
}

Simulation::Snapshot Simulation::snapshot() const {
  backend_->export_contact_history(neighbour_list_);
  Snapshot s;
  s.progress = progress_;
  s.discs = discs_;
  s.damage = network_.damage;
  for (const BondState state : network_.state) s.bond_state.push_back(static_cast<std::uint8_t>(state));
  s.neighbour_list = neighbour_list_.snapshot();
  s.walls = walls_.snapshot();
  s.events = events_;
  return s;
}

void Simulation::restore(Snapshot s) {
  progress_ = s.progress;
  now_ = progress_.cell;
  before_ = now_;  // only the next step's drift asks for it, and sets it itself
  const int shift = discs_.position_shift;
  discs_ = std::move(s.discs);
  discs_.position_shift = shift;
  discs_.record.resize(discs_.sx.size());
  discs_.motion.resize(discs_.sx.size());
  network_.damage = std::move(s.damage);
  for (std::size_t b = 0; b < s.bond_state.size(); ++b) network_.state[b] = static_cast<BondState>(s.bond_state[b]);
  neighbour_list_.restore(s.neighbour_list);
  walls_.restore(s.walls);
  events_.reserve(static_cast<std::size_t>(network_.size()));
  events_.assign(s.events.begin(), s.events.end());
  damping_ = CundallDamping(options_.dynamics, network_, discs_.sx.size());
  refresh_records();
  backend_->load(network_, discs_, cell_.start);
  backend_->set_neighbours(neighbour_list_, discs_);
}

}  // namespace perfora::solver
