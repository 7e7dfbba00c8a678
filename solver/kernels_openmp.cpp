// What is here: the vectorised OpenMP backend. Each disc sums all its own bonds and contacts ("full list") in fixed
// order, so no two threads write the same place and the bits do not depend on their number. Bonds go through the vector
// loop of the best instruction set the machine has (bond_kernel.h); those near their yield surface leave it and go
// through laws.h one by one in double precision. What is not: the vector loop, the law itself.
#include <algorithm>
#include <cmath>


#include "solver/bond_kernel.h"
#include "solver/bond_rows.h"
#include "solver/kernels.h"

#define PERFORA_INLINE __attribute__((always_inline)) inline

namespace perfora::solver {
namespace {

std::size_t at(std::int32_t k) {
  return static_cast<std::size_t>(k);
}

/// Everything the loops over one chunk read and write.
struct ChunkTask {
  const BondLaw* bond;
  const ContactLaw* contact;
  BondRows* rows;
  ForceStep* step;
  std::int32_t begin, end;  ///< discs
  std::int32_t* broken;     ///< room for the bonds whose lower disc is in this chunk
  std::int32_t broken_count;
  StepSums sums;
  BondSweep sweep;
};

/// Off the vector path: one end of a bond near its yield surface (or, with damage in compression, damaged). Updates D,
/// writes the network from the lower end, and returns the forces; both ends see mirrored numbers and so take the same
/// decision. Damage is kept in single precision, as the rows hold it.
BondEndForce bond_end(void* context, std::int32_t i, std::int64_t slot) {
  ChunkTask& task = *static_cast<ChunkTask*>(context);
  ForceStep& step = *task.step;
  const BondLaw& law = *task.bond;
  const DiscState& discs = step.discs;
  const std::int32_t j = task.rows->neighbour(slot), id = task.rows->bond(slot);
  const double sign = i < j ? 1.0 : -1.0;
  const double l0 = step.network.rest_length[at(id)], e0x = sign * step.network.direction_x[at(id)],
               e0y = sign * step.network.direction_y[at(id)];
  const BondKinematics k = kinematics_of(discs, i, j, step.cell, e0x, e0y, l0);
  const double contact_distance = discs.radius[at(i)] + discs.radius[at(j)];
  const double touch = std::min(contact_distance, l0);
  const BondPoint now{k.delta_n, k.delta_t, std::max(0.0, touch - k.length)};
  const double old_damage = task.rows->damage(slot);
  const double strength = step.network.strength[at(id)];
  const double damage =
      static_cast<double>(static_cast<float>(updated_damage(law, k.delta_n, k.delta_t, strength, old_damage)));
  if (damage > old_damage) {
    const BondKinematics old = kinematics_before(discs, i, j, step.cell_before, e0x, e0y, l0);
    const BondPoint before{old.delta_n, old.delta_t, std::max(0.0, touch - old.length)};
    double dissipated = damageable_energy(law, before, now) * (damage - old_damage);
    if (i < j) step.network.damage[at(id)] = damage;
    if (damage >= 1.0) {
      dissipated += compression_release(law, before, now, l0 <= contact_distance);
      if (i < j) {
        step.network.state[at(id)] = BondState::broken;
        task.broken[task.broken_count++] = id;
      }
      step.near_pairs.release(i, j, touch);
      task.rows->clear(slot, i);
    } else {
      task.rows->set_damage(slot, damage, 1.0 / (strength * zeta_of_damage(law, damage)));
    }
    task.sums.damage += 0.5 * dissipated;  // the other end adds the other half
  }
  if (damage >= 1.0) return {};
  const BondForce f = bond_force(law, now, damage);
  return {f.normal, f.shear};
}

/// One end of a contact, seen from disc i; adds to its force and torque.
PERFORA_INLINE void contact_end(ChunkTask& task, std::int32_t i, NearSlot& slot, double& fx, double& fy,
                                double& torque) {
  ForceStep& step = *task.step;
  const DiscState& discs = step.discs;
  const std::int32_t j = slot.neighbour;
  const double dx = reduced(discs.sx[at(j)] - discs.sx[at(i)]), dy = reduced(discs.sy[at(j)] - discs.sy[at(i)]);
  const double rx = step.cell.xx * dx + step.cell.xy * dy, ry = step.cell.yy * dy;
  const double sum_radii = discs.radius[at(i)] + discs.radius[at(j)];
  const double square = rx * rx + ry * ry;
  if (square > sum_radii * sum_radii) slot.touch = sum_radii;
  const bool open = square >= slot.touch * slot.touch;
  if (open && slot.history.shear == 0.0 && slot.history.viscous_force == 0.0) return;
  const double length = std::sqrt(square);
  const double nx = rx / length, ny = ry / length;
  const VelocityGradient& l = step.gradient;
  const double ux = discs.vx[at(j)] - discs.vx[at(i)] + (l.xx * rx + l.xy * ry);
  const double uy = discs.vy[at(j)] - discs.vy[at(i)] + l.yy * ry;
  const double v_n = ux * nx + uy * ny;
  const double overlap = slot.touch - length;
  const double lever_i = length * discs.radius[at(i)] / sum_radii, lever_j = length * discs.radius[at(j)] / sum_radii;
  const double v_t = (uy * nx - ux * ny) - (lever_i * discs.omega[at(i)] + lever_j * discs.omega[at(j)]);
  if (!(overlap > 0.0)) {
    const ContactForce lost = contact_opening(*task.contact, v_n, v_t, step.dt, slot.history);
    task.sums.friction += 0.5 * lost.friction;
    task.sums.viscous += 0.5 * lost.viscous;
    return;
  }
  const double effective_mass = discs.mass[at(i)] * discs.mass[at(j)] / (discs.mass[at(i)] + discs.mass[at(j)]);
  const ContactForce f = contact_force(*task.contact, overlap, v_n, v_t, effective_mass, step.dt, slot.history);
  const double px = f.normal * nx + f.shear * ny, py = f.normal * ny - f.shear * nx;  // force on j
  fx -= px;
  fy -= py;
  torque += lever_i * f.shear;
  Virial& v = task.sums.virial;
  v.xx += 0.5 * (px * rx);
  v.xy += 0.5 * (px * ry);
  v.yx += 0.5 * (py * rx);
  v.yy += 0.5 * (py * ry);
  task.sums.friction += 0.5 * f.friction;
  task.sums.viscous += 0.5 * f.viscous;
  task.sums.largest_overlap = std::max(task.sums.largest_overlap, overlap);
}

/// Contacts of the chunk's discs, on top of the bond forces.
void chunk_contacts(ChunkTask& task) {
  ForceStep& step = *task.step;
  DiscState& discs = step.discs;
  for (std::int32_t i = task.begin; i < task.end; ++i) {
    if (step.near_pairs.active(i) == 0) continue;
    double fx = discs.fx[at(i)], fy = discs.fy[at(i)], torque = discs.torque[at(i)];
    NearSlot* slots = step.near_pairs.slots().data();
    for (std::int32_t k = step.near_pairs.row_begin(i), last = step.near_pairs.row_end(i); k < last; ++k)
      if (slots[k].bonded == 0) contact_end(task, i, slots[k], fx, fy, torque);
    discs.fx[at(i)] = fx;
    discs.fy[at(i)] = fy;
    discs.torque[at(i)] = torque;
  }
}

/// The loops of one choice; null where this machine has not got the instructions.
const BondKernels* kernels_of(SimdChoice choice) {
#if defined(PERFORA_X86_KERNELS)
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
  if (choice == SimdChoice::avx512) return avx512 ? &bond_kernels_avx512 : nullptr;
  if (choice == SimdChoice::avx2) return avx2 ? &bond_kernels_avx2 : nullptr;
#endif
  return choice == SimdChoice::portable ? &bond_kernels_portable : nullptr;
}

class OpenmpBackend final : public ForceBackend {
 public:
  OpenmpBackend(const BondLaw& bond, const ContactLaw& contact, int threads, const BondKernels& kernels)
      : bond_(bond), contact_(contact), threads_(threads), kernels_(kernels), rows_(kernels.lanes) {}

  void load(const BondNetwork& network, const DiscState& discs, const CellMatrix& start) override {
    const std::int32_t n = discs.size();
    start_unit_ = unit_of(start, discs);
    rows_.build(network, n, bond_, start_unit_);
    std::vector<std::int32_t> lower(at(n) + 1, 0);
    for (const std::int32_t i : network.i) ++lower[at(i) + 1];
    for (std::int32_t k = 0; k < n; ++k) lower[at(k) + 1] += lower[at(k)];
    const std::int32_t chunks = (n + chunk_discs - 1) / chunk_discs;
    tasks_.resize(at(chunks));
    broken_.resize(static_cast<std::size_t>(network.size()));
    for (std::int32_t c = 0; c < chunks; ++c) {
      ChunkTask& task = tasks_[at(c)];
      task.bond = &bond_;
      task.contact = &contact_;
      task.rows = &rows_;
      task.begin = c * chunk_discs;
      task.end = std::min(n, task.begin + chunk_discs);
      task.broken = broken_.data() + lower[at(task.begin)];
      rows_.aim(task.sweep, c);
      task.sweep.twice_alpha = bond_.twice_alpha;
      task.sweep.context = &task;
      task.sweep.bond_end = bond_end;
    }
  }

  StepSums forces(ForceStep& step) override {
    const bool weak = bond_.damage_in_compression == DamageInCompression::full;
    const auto kernel = bond_.twice_alpha == 8 ? (weak ? kernels_.quartic_weak : kernels_.quartic)
                                               : (weak ? kernels_.general_weak : kernels_.general);
    const double unit = unit_of(step.cell, step.discs);
    const auto count = static_cast<std::int32_t>(tasks_.size());
#pragma omp parallel for schedule(static) num_threads(threads_) if (threads_ > 1)
    for (std::int32_t c = 0; c < count; ++c) {
      ChunkTask& task = tasks_[at(c)];
      task.step = &step;
      task.broken_count = 0;
      task.sums = {};
      task.sweep.record = step.discs.record.data();
      task.sweep.fx = step.discs.fx.data();
      task.sweep.fy = step.discs.fy.data();
      task.sweep.torque = step.discs.torque.data();
      scale(task.sweep, step.cell, unit);
      kernel(task.sweep);
      // Each bond was seen from both ends, with the force on i: minus half of it is its share of sum F_j r.
      const Virial& v = task.sweep.virial;
      task.sums.virial = {-0.5 * v.xx, -0.5 * v.xy, -0.5 * v.yx, -0.5 * v.yy};
      chunk_contacts(task);
    }
    StepSums sums;
    for (const ChunkTask& task : tasks_) {
      sums.add(task.sums);
      for (std::int32_t k = 0; k < task.broken_count; ++k) step.broken.push_back(task.broken[k]);
    }
    return sums;
  }

  std::string simd() const override { return kernels_.name; }

 private:
  /// One step of the record's x, m.
  static double unit_of(const CellMatrix& cell, const DiscState& discs) {
    return std::ldexp(cell.xx, -32 - discs.position_shift);
  }

  void scale(BondSweep& sweep, const CellMatrix& cell, double unit) const {
    sweep.unit = unit;
    sweep.lean = static_cast<float>(cell.xy / cell.xx);
    sweep.height = static_cast<float>(cell.yy / cell.xx);
    const double g_yy = (cell.xy * cell.xy + cell.yy * cell.yy) / (cell.xx * cell.xx);
    sweep.twice_g_xy = static_cast<float>(2.0 * cell.xy / cell.xx);
    sweep.g_yy = static_cast<float>(g_yy);
    sweep.g_yy_rest = static_cast<float>(g_yy - static_cast<double>(sweep.g_yy));
    sweep.rest_stretch = static_cast<float>(start_unit_ / unit);
    sweep.rest_fraction_unit = static_cast<float>(rows_.rest_fraction_unit() * start_unit_ / unit);
    sweep.normal_stiffness = static_cast<float>(bond_.normal_stiffness * unit);
    sweep.tangential_stiffness = static_cast<float>(bond_.tangential_stiffness * unit);
    sweep.normal_share = static_cast<float>(bond_.inverse_critical_normal * rows_.threshold_unit() * unit);
    sweep.shear_share = static_cast<float>(bond_.inverse_critical_shear * rows_.threshold_unit() * unit);
  }

  BondLaw bond_;
  ContactLaw contact_;
  int threads_;
  double start_unit_ = 1.0;
  const BondKernels& kernels_;
  BondRows rows_;
  std::vector<std::int32_t> broken_;
  std::vector<ChunkTask> tasks_;
};

}  // namespace

void StepSums::add(const StepSums& other) {
  virial.xx += other.virial.xx;
  virial.xy += other.virial.xy;
  virial.yx += other.virial.yx;
  virial.yy += other.virial.yy;
  damage += other.damage;
  friction += other.friction;
  viscous += other.viscous;
  largest_overlap = std::max(largest_overlap, other.largest_overlap);
}

std::vector<SimdChoice> usable_simd() {
  std::vector<SimdChoice> usable;
  for (const SimdChoice choice : {SimdChoice::avx512, SimdChoice::avx2, SimdChoice::portable})
    if (kernels_of(choice) != nullptr) usable.push_back(choice);
  return usable;
}

std::unique_ptr<ForceBackend> make_openmp_backend(const BondLaw& bond, const ContactLaw& contact, int threads,
                                                  SimdChoice simd) {
  const BondKernels* const kernels = kernels_of(simd == SimdChoice::automatic ? usable_simd().front() : simd);
  return std::make_unique<OpenmpBackend>(bond, contact, std::max(1, threads), *kernels);
}

}  // namespace perfora::solver
