// What is here: the vectorised OpenMP backend. Each disc sums all its own bonds and contacts ("full list") in fixed
// order, so no two threads write the same place and the bits do not depend on their number. Both go through the vector
// loops of the best instruction set the machine has (vector_kernels.h); bonds near their yield surface leave it and go
// through laws.h one by one in double precision. What is not: the vector loops, the law itself.
#include <algorithm>
#include <cmath>

#include "solver/index.h"
#include "solver/kernels/bond_rows.h"
#include "solver/kernels/contact_rows.h"
#include "solver/kernels/kernels.h"
#include "solver/kernels/vector_kernels.h"

namespace perfora::solver {
namespace {

/// Everything the loops over one chunk read and write.
struct ChunkTask {
  const BondLaw* bond;
  const ContactLaw* contact;
  BondRows* rows;
  ContactRows* contact_rows;
  ForceStep* step;
  std::int32_t* broken;  ///< room for the bonds whose lower disc is in this chunk
  std::int32_t broken_count;
  StepSums sums;
  BondTask bonds;
  ContactTask contacts;
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
  const double l0 = step.network.reference_length[at(id)], e0x = sign * step.network.direction_x[at(id)],
               e0y = sign * step.network.direction_y[at(id)];
  const BondKinematics k = kinematics_of(discs, i, j, step.cell, e0x, e0y, l0);
  const double sum_radii = discs.radius[at(i)] + discs.radius[at(j)];
  const double contact_distance = std::min(sum_radii, l0);
  const BondPoint now{k.delta_n, k.delta_t, std::max(0.0, contact_distance - k.length)};
  const double old_damage = task.rows->damage(slot);
  const double strength = step.network.strength[at(id)];
  const double damage =
      static_cast<double>(static_cast<float>(updated_damage(law, k.delta_n, k.delta_t, strength, old_damage)));
  if (damage > old_damage) {
    const BondKinematics old = kinematics_before(discs, i, j, step.cell_before, e0x, e0y, l0);
    const BondPoint before{old.delta_n, old.delta_t, std::max(0.0, contact_distance - old.length)};
    double dissipated = damageable_energy(law, before, now) * (damage - old_damage);
    if (i < j) step.network.damage[at(id)] = damage;
    if (damage >= 1.0) {
      dissipated += compression_release(law, before, now, l0 <= sum_radii);
      if (i < j) {
        step.network.state[at(id)] = BondState::broken;
        task.broken[task.broken_count++] = id;
      }
      const std::int32_t pair = step.neighbour_list.release(i, j, contact_distance);
      if (pair >= 0) task.contact_rows->open(step.neighbour_list, i, pair, discs, *task.contact);
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

/// The loops of one choice; null where this machine has not got the instructions.
const VectorKernels* kernels_of(SimdChoice choice) {
#if defined(PERFORA_X86_KERNELS)
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
  if (choice == SimdChoice::avx512) return avx512 ? &vector_kernels_avx512 : nullptr;
  if (choice == SimdChoice::avx2) return avx2 ? &vector_kernels_avx2 : nullptr;
#endif
  return choice == SimdChoice::portable ? &vector_kernels_portable : nullptr;
}

class OpenmpBackend final : public ForceBackend {
 public:
  OpenmpBackend(const BondLaw& bond, const ContactLaw& contact, int threads, const VectorKernels& kernels)
      : bond_(bond),
        contact_(contact),
        threads_(threads),
        kernels_(kernels),
        rows_(kernels.lanes),
        contact_rows_(kernels.lanes) {}

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
      task.contact_rows = &contact_rows_;
      task.broken = broken_.data() + lower[at(c * chunk_discs)];
      rows_.aim(task.bonds, c);
      task.bonds.twice_alpha = bond_.twice_alpha;
      task.bonds.context = &task;
      task.bonds.bond_end = bond_end;
    }
  }

  void set_neighbours(const NeighbourList& neighbour_list, const DiscState& discs) override {
    contact_rows_.build(neighbour_list, discs, contact_);
    for (std::size_t c = 0; c < tasks_.size(); ++c) contact_rows_.aim(tasks_[c].contacts, static_cast<std::int32_t>(c));
  }

  void export_contact_history(NeighbourList& neighbour_list) const override {
    contact_rows_.export_history(neighbour_list);
  }

  StepSums forces(ForceStep& step) override {
    const bool weak = bond_.damage_in_compression == DamageInCompression::full;
    const auto kernel = bond_.twice_alpha == 8 ? (weak ? kernels_.quartic_weak : kernels_.quartic)
                                               : (weak ? kernels_.general_weak : kernels_.general);
    const double unit = unit_of(step.cell, step.discs);
    const auto count = static_cast<std::int32_t>(tasks_.size());
    // Chunks of rubble cost more or less than intact ones: handed out a few at a time. Who does which changes no bits.
#pragma omp parallel for schedule(dynamic, 4) num_threads(threads_) if (threads_ > 1)
    for (std::int32_t c = 0; c < count; ++c) {
      ChunkTask& task = tasks_[at(c)];
      task.step = &step;
      task.broken_count = 0;
      task.sums = {};
      task.bonds.record = step.discs.record.data();
      task.bonds.fx = step.discs.fx.data();
      task.bonds.fy = step.discs.fy.data();
      task.bonds.torque = step.discs.torque.data();
      scale(task.bonds, step.cell, unit);
      kernel(task.bonds);
      // Each bond was seen from both ends, with the force on i: minus half of it is its fraction of sum F_j r.
      const Virial& v = task.bonds.virial;
      task.sums.virial = {-0.5 * v.xx, -0.5 * v.xy, -0.5 * v.yx, -0.5 * v.yy};
      scale(task.contacts, step);
      kernels_.contacts(task.contacts);
      add_contacts(task);
    }
    StepSums sums;
    for (const ChunkTask& task : tasks_) {
      sums.add(task.sums);
      for (std::int32_t k = 0; k < task.broken_count; ++k) step.broken.push_back(task.broken[k]);
    }
    return sums;
  }

  std::string simd() const override {
    return kernels_.name;
  }

  void set_threads(int threads) override {
    threads_ = threads;
  }

 private:
  /// One step of the record's x, m.
  static double unit_of(const CellMatrix& cell, const DiscState& discs) {
    return std::ldexp(cell.xx, -32 - discs.position_shift);
  }

  void scale(BondTask& task, const CellMatrix& cell, double unit) const {
    task.unit = unit;
    task.cell_shear = static_cast<float>(cell.xy / cell.xx);
    task.height = static_cast<float>(cell.yy / cell.xx);
    const double g_yy = (cell.xy * cell.xy + cell.yy * cell.yy) / (cell.xx * cell.xx);
    task.twice_g_xy = static_cast<float>(2.0 * cell.xy / cell.xx);
    task.g_yy = static_cast<float>(g_yy);
    task.g_yy_residual = static_cast<float>(g_yy - static_cast<double>(task.g_yy));
    task.reference_scale = static_cast<float>(start_unit_ / unit);
    task.length_residual_unit = static_cast<float>(rows_.length_residual_unit() * start_unit_ / unit);
    task.normal_stiffness = static_cast<float>(bond_.normal_stiffness * unit);
    task.tangential_stiffness = static_cast<float>(bond_.tangential_stiffness * unit);
    task.normal_scale = static_cast<float>(bond_.inverse_critical_normal * rows_.threshold_unit() * unit);
    task.shear_scale = static_cast<float>(bond_.inverse_critical_shear * rows_.threshold_unit() * unit);
  }

  void scale(ContactTask& task, const ForceStep& step) const {
    const double unit = std::ldexp(1.0, -32 - step.discs.position_shift);
    task.record = step.discs.record.data();
    task.motion = step.discs.motion.data();
    task.fx = step.discs.fx.data();
    task.fy = step.discs.fy.data();
    task.torque = step.discs.torque.data();
    task.step_xx = static_cast<float>(step.cell.xx * unit);
    task.step_xy = static_cast<float>(step.cell.xy * unit);
    task.step_yy = static_cast<float>(step.cell.yy * unit);
    task.gradient_xx = static_cast<float>(step.gradient.xx);
    task.gradient_xy = static_cast<float>(step.gradient.xy);
    task.gradient_yy = static_cast<float>(step.gradient.yy);
    task.normal_stiffness = static_cast<float>(contact_.normal_stiffness);
    task.tangential_stiffness = static_cast<float>(contact_.tangential_stiffness);
    task.friction_coefficient = static_cast<float>(contact_.friction_coefficient);
    task.dt = static_cast<float>(step.dt);
  }

  /// Each contact was seen from both ends.
  static void add_contacts(ChunkTask& task) {
    const ContactTask& c = task.contacts;
    Virial& v = task.sums.virial;
    v.xx += 0.5 * c.virial.xx;
    v.xy += 0.5 * c.virial.xy;
    v.yx += 0.5 * c.virial.yx;
    v.yy += 0.5 * c.virial.yy;
    task.sums.friction += 0.5 * c.friction;
    task.sums.viscous += 0.5 * c.viscous;
    task.sums.largest_overlap = c.largest_overlap;
  }

  BondLaw bond_;
  ContactLaw contact_;
  int threads_;
  double start_unit_ = 1.0;
  const VectorKernels& kernels_;
  BondRows rows_;
  ContactRows contact_rows_;
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
  const VectorKernels* const kernels = kernels_of(simd == SimdChoice::automatic ? usable_simd().front() : simd);
  return std::make_unique<OpenmpBackend>(bond, contact, std::max(1, threads), *kernels);
}

}  // namespace perfora::solver
