// What is here: the vectorised OpenMP backend in double precision. Each disc sums all its own bonds and contacts ("full
// list") in fixed order, so no two threads write the same place and the bits do not depend on their number. Four bonds
// make one vector; the lanes are fixed (GCC vector extensions), so the bits do not depend on the instruction set
// either: no contraction, only IEEE operations. What is not: the law itself (laws.h). Bonds that yield leave the vector
// path and go through laws.h one by one.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "solver/kernels.h"
#include "solver/vector4.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define PERFORA_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define PERFORA_CLONES
#endif

namespace perfora::solver {
namespace {

std::size_t at(std::int32_t k) {
  return static_cast<std::size_t>(k);
}

/// Four half-bonds of one disc. An empty lane points at the disc itself with everything zero and D = 1: its branch is
/// exactly zero, and so is its force.
struct alignas(32) Group {
  Vector l0, e0x, e0y;
  Vector scale;   ///< 1/(strength zeta(D)): what turns displacements into shares of the current yield surface, before
                  ///< 1/delta^0
  Vector damage;  ///< D
  std::int32_t neighbour[lanes];
  std::int32_t bond[lanes];  ///< -1: empty
};

/// Everything the loops over one chunk read and write.
struct ChunkTask {
  const BondLaw* bond;
  const ContactLaw* contact;
  ForceStep* step;
  Group* groups;
  const std::int32_t* row;  ///< first group of each disc
  std::int32_t begin, end;  ///< discs
  std::int32_t* broken;     ///< room for the bonds whose lower disc is in this chunk
  std::int32_t broken_count;
  StepSums sums;
};

/// Off the vector path: one end of a bond that yields (or, with damage in compression, is damaged). Updates D, writes
/// the network from the lower end, and returns the forces; both ends see mirrored numbers and so take the same
/// decision.
BondForce yielding_bond(ChunkTask& task, std::int32_t i, Group& group, int lane) {
  ForceStep& step = *task.step;
  const BondLaw& law = *task.bond;
  const DiscState& discs = step.discs;
  const std::int32_t j = group.neighbour[lane], id = group.bond[lane];
  const double l0 = group.l0[lane], e0x = group.e0x[lane], e0y = group.e0y[lane];
  const BondKinematics k = kinematics_of(discs.record[at(i)], discs.record[at(j)], step.cell, e0x, e0y, l0);
  const double contact_distance = discs.radius[at(i)] + discs.radius[at(j)];
  const double touch = std::min(contact_distance, l0);
  const BondPoint now{k.delta_n, k.delta_t, std::max(0.0, touch - k.length)};
  const double old_damage = group.damage[lane];
  const double strength = step.network.strength[at(id)];
  const double damage = updated_damage(law, k.delta_n, k.delta_t, strength, old_damage);
  if (damage > old_damage) {
    const BondKinematics old =
        kinematics_of(discs.record_before[at(i)], discs.record_before[at(j)], step.cell_before, e0x, e0y, l0);
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
      group.l0[lane] = group.e0x[lane] = group.e0y[lane] = group.scale[lane] = 0.0;
      group.damage[lane] = 1.0;
      group.neighbour[lane] = i;
      group.bond[lane] = -1;
    } else {
      group.damage[lane] = damage;
      group.scale[lane] = 1.0 / (strength * zeta_of_damage(law, damage));
    }
    task.sums.damage += 0.5 * dissipated;  // the other end adds the other half
  }
  if (damage >= 1.0) return {0.0, 0.0};
  return bond_force(law, now, damage);
}

/// One end of a contact, seen from disc i; adds to its force and torque.
PERFORA_INLINE void contact_end(ChunkTask& task, std::int32_t i, NearSlot& slot, double& fx, double& fy,
                                double& torque) {
  ForceStep& step = *task.step;
  const DiscState& discs = step.discs;
  const std::int32_t j = slot.neighbour;
  const DiscRecord &a = discs.record[at(i)], &b = discs.record[at(j)];
  double dx = b.x - a.x, dy = b.y - a.y;
  dx -= dx > 0.5 ? 1.0 : (dx < -0.5 ? -1.0 : 0.0);
  dy -= dy > 0.5 ? 1.0 : (dy < -0.5 ? -1.0 : 0.0);
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

/// The chunk: bonds four at a time, then contacts, disc by disc. `quartic`: alpha = 4, the paper's, without a loop.
template <bool quartic, bool compression_weakens>
PERFORA_INLINE void chunk_forces(ChunkTask& task) {
  ForceStep& step = *task.step;
  DiscState& discs = step.discs;
  const BondLaw& law = *task.bond;
  const DiscRecord* record = discs.record.data();
  const Vector h_xx = splat(step.cell.xx), h_xy = splat(step.cell.xy), h_yy = splat(step.cell.yy);
  const Vector k_n = splat(law.normal_stiffness), k_t = splat(law.tangential_stiffness);
  const Vector inverse_n = splat(law.inverse_critical_normal), inverse_t = splat(law.inverse_critical_shear);
  const Vector one = splat(1.0), zero = splat(0.0), half = splat(0.5);
  const Vector tiny = splat(1e-300);  // keeps an empty lane's 1/|r| finite; far below the rounding of any real |r|^2
  Vector virial_xx = zero, virial_xy = zero, virial_yx = zero, virial_yy = zero;
  for (std::int32_t i = task.begin; i < task.end; ++i) {
    Vector force_x = zero, force_y = zero, twice_torque = zero;
    const DiscRecord own = record[i];
    const Vector xi = splat(own.x), yi = splat(own.y), ci = splat(own.c), si = splat(own.s);
    for (std::int32_t g = task.row[i]; g < task.row[i + 1]; ++g) {
      Group& group = task.groups[g];
      Vector r0, r1, r2, r3;  // records of the four neighbours: loaded whole, then transposed
      std::memcpy(&r0, record + group.neighbour[0], sizeof r0);
      std::memcpy(&r1, record + group.neighbour[1], sizeof r1);
      std::memcpy(&r2, record + group.neighbour[2], sizeof r2);
      std::memcpy(&r3, record + group.neighbour[3], sizeof r3);
      const Vector low01 = __builtin_shuffle(r0, r1, Mask{0, 4, 2, 6}),
                   high01 = __builtin_shuffle(r0, r1, Mask{1, 5, 3, 7});
      const Vector low23 = __builtin_shuffle(r2, r3, Mask{0, 4, 2, 6}),
                   high23 = __builtin_shuffle(r2, r3, Mask{1, 5, 3, 7});
      const Vector xj = __builtin_shuffle(low01, low23, Mask{0, 1, 4, 5}),
                   cj = __builtin_shuffle(low01, low23, Mask{2, 3, 6, 7});
      const Vector yj = __builtin_shuffle(high01, high23, Mask{0, 1, 4, 5}),
                   sj = __builtin_shuffle(high01, high23, Mask{2, 3, 6, 7});

      Vector dx = xj - xi, dy = yj - yi;
      dx -= nearest(dx);
      dy -= nearest(dy);
      const Vector rx = h_xx * dx + h_xy * dy, ry = h_yy * dy;
      const Vector length = root(rx * rx + ry * ry + tiny);
      const Vector inverse = one / length;
      const Vector cosine = ci * cj - si * sj, sine = si * cj + ci * sj;
      const Vector ex = cosine * group.e0x - sine * group.e0y, ey = sine * group.e0x + cosine * group.e0y;
      const Vector along = ex * rx + ey * ry;
      const Vector delta_n = length - group.l0, delta_t = ex * ry - ey * rx;

      const Vector share_n = delta_n * inverse_n * group.scale, share_t = magnitude(delta_t) * inverse_t * group.scale;
      Vector power;
      if constexpr (quartic) {
        const Vector square = share_t * share_t;
        power = square * square;
      } else {
        power = half_integer_power_of(share_t, law.twice_alpha);
      }
      const Vector left = one - group.damage;
      Vector normal = k_n * delta_n * (compression_weakens ? left : (delta_n > zero ? left : one));
      Vector shear = k_t * delta_t * left;
      Mask off_path = share_n + power > one;
      if constexpr (compression_weakens) off_path |= (group.damage > zero) & (group.damage < one);
      if (__builtin_expect(any(off_path), 0)) {
        for (int lane = 0; lane < lanes; ++lane) {
          if (off_path[lane] == 0) continue;
          const BondForce f = yielding_bond(task, i, group, lane);
          normal[lane] = f.normal;
          shear[lane] = f.shear;
        }
      }
      const Vector per_length = normal * inverse;
      const Vector gx = per_length * rx - shear * ey, gy = per_length * ry + shear * ex;  // f_n n + f_t t: on i
      force_x += gx;
      force_y += gy;
      twice_torque += shear * along;
      virial_xx += gx * rx;
      virial_xy += gx * ry;
      virial_yx += gy * rx;
      virial_yy += gy * ry;
    }
    double fx = sum(force_x), fy = sum(force_y), torque = 0.5 * sum(twice_torque);
    if (step.near_pairs.active(i) > 0) {
      NearSlot* slots = step.near_pairs.slots().data();
      for (std::int32_t k = step.near_pairs.row_begin(i), last = step.near_pairs.row_end(i); k < last; ++k)
        if (slots[k].bonded == 0) contact_end(task, i, slots[k], fx, fy, torque);
    }
    discs.fx[at(i)] = fx;
    discs.fy[at(i)] = fy;
    discs.torque[at(i)] = torque;
  }
  // Each bond was seen from both ends, with the force on i: minus half of it is its share of sum F_j r.
  task.sums.virial.xx -= sum(half * virial_xx);
  task.sums.virial.xy -= sum(half * virial_xy);
  task.sums.virial.yx -= sum(half * virial_yx);
  task.sums.virial.yy -= sum(half * virial_yy);
}

PERFORA_CLONES void chunk_quartic(ChunkTask& task) {
  chunk_forces<true, false>(task);
}
PERFORA_CLONES void chunk_quartic_weak(ChunkTask& task) {
  chunk_forces<true, true>(task);
}
PERFORA_CLONES void chunk_general(ChunkTask& task) {
  chunk_forces<false, false>(task);
}
PERFORA_CLONES void chunk_general_weak(ChunkTask& task) {
  chunk_forces<false, true>(task);
}

class OpenmpBackend final : public ForceBackend {
 public:
  OpenmpBackend(const BondLaw& bond, const ContactLaw& contact, int threads)
      : bond_(bond), contact_(contact), threads_(threads) {}

  void load(const BondNetwork& network, const DiscState& discs) override {
    const std::int32_t n = discs.size();
    std::vector<std::int32_t> degree(at(n), 0), lower(at(n) + 1, 0);
    for (std::int64_t b = 0; b < network.size(); ++b) {
      const auto id = static_cast<std::size_t>(b);
      ++lower[at(network.i[id]) + 1];
      if (network.state[id] == BondState::compacted) continue;
      ++degree[at(network.i[id])];
      ++degree[at(network.j[id])];
    }
    for (std::int32_t k = 0; k < n; ++k) lower[at(k) + 1] += lower[at(k)];
    row_.assign(at(n) + 1, 0);
    for (std::int32_t k = 0; k < n; ++k) row_[at(k) + 1] = row_[at(k)] + (degree[at(k)] + lanes - 1) / lanes;
    groups_.resize(at(row_.back()));
    const Vector zero = splat(0.0);
    for (std::int32_t k = 0; k < n; ++k)
      for (std::int32_t g = row_[at(k)]; g < row_[at(k) + 1]; ++g) {
        groups_[at(g)] = {zero, zero, zero, zero, splat(1.0), {k, k, k, k}, {-1, -1, -1, -1}};
      }
    // Bonds are sorted by (i, j), so filling in order sorts every row by neighbour.
    std::vector<std::int32_t> filled(at(n), 0);
    for (std::int64_t b = 0; b < network.size(); ++b) {
      const auto id = static_cast<std::size_t>(b);
      if (network.state[id] == BondState::compacted) continue;
      for (int end = 0; end < 2; ++end) {
        const std::int32_t own = end == 0 ? network.i[id] : network.j[id],
                           other = end == 0 ? network.j[id] : network.i[id];
        const std::int32_t slot = filled[at(own)]++;
        if (network.state[id] != BondState::intact) continue;  // keeps its empty place until the rows are compacted
        Group& group = groups_[at(row_[at(own)] + slot / lanes)];
        const int lane = slot % lanes;
        const double sign = end == 0 ? 1.0 : -1.0;
        group.l0[lane] = network.rest_length[id];
        group.e0x[lane] = sign * network.direction_x[id];
        group.e0y[lane] = sign * network.direction_y[id];
        group.damage[lane] = network.damage[id];
        group.scale[lane] = 1.0 / (network.strength[id] * zeta_of_damage(bond_, network.damage[id]));
        group.neighbour[lane] = other;
        group.bond[lane] = static_cast<std::int32_t>(b);
      }
    }
    const std::int32_t chunks = (n + chunk_discs - 1) / chunk_discs;
    tasks_.resize(at(chunks));
    broken_.resize(static_cast<std::size_t>(network.size()));
    for (std::int32_t c = 0; c < chunks; ++c) {
      ChunkTask& task = tasks_[at(c)];
      task.bond = &bond_;
      task.contact = &contact_;
      task.groups = groups_.data();
      task.row = row_.data();
      task.begin = c * chunk_discs;
      task.end = std::min(n, task.begin + chunk_discs);
      task.broken = broken_.data() + lower[at(task.begin)];
    }
  }

  StepSums forces(ForceStep& step) override {
    const bool quartic = bond_.twice_alpha == 8;
    const bool weak = bond_.damage_in_compression == DamageInCompression::full;
    const auto kernel =
        quartic ? (weak ? chunk_quartic_weak : chunk_quartic) : (weak ? chunk_general_weak : chunk_general);
    const auto count = static_cast<std::int32_t>(tasks_.size());
#pragma omp parallel for schedule(static) num_threads(threads_) if (threads_ > 1)
    for (std::int32_t c = 0; c < count; ++c) {
      ChunkTask& task = tasks_[at(c)];
      task.step = &step;
      task.broken_count = 0;
      task.sums = {};
      kernel(task);
    }
    StepSums sums;
    for (const ChunkTask& task : tasks_) {
      sums.add(task.sums);
      for (std::int32_t k = 0; k < task.broken_count; ++k) step.broken.push_back(task.broken[k]);
    }
    return sums;
  }

  std::string simd() const override {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2") ? "avx2 (double)" : "sse2 (double)";
#else
    return "portable (double)";
#endif
  }

 private:
  BondLaw bond_;
  ContactLaw contact_;
  int threads_;
  std::vector<Group> groups_;
  std::vector<std::int32_t> row_, broken_;
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

std::unique_ptr<ForceBackend> make_openmp_backend(const BondLaw& bond, const ContactLaw& contact, int threads) {
  return std::make_unique<OpenmpBackend>(bond, contact, std::max(1, threads));
}

}  // namespace perfora::solver
