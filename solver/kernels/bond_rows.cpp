// What is here: making and changing the sliced rows of bonds.
#include "solver/kernels/bond_rows.h"
#include "solver/index.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace perfora::solver {
namespace {

enum Field { e0x = 0, e0y = 1, l0 = 2, neighbour_offset = 3 };
constexpr double largest_stored = 65535.0;                             // of a 16-bit threshold
constexpr double half_last_place = 0x1p-24, largest_fraction = 127.0;  // of floats and of what is left, in 8 bits

}  // namespace

float* BondRows::field(std::int64_t slot, int which) {
  char* const group = groups_.data() + at(slot / lanes_) * group_bytes();
  return reinterpret_cast<float*>(group) + which * lanes_ + slot % lanes_;
}

std::int32_t BondRows::neighbour(std::int64_t slot) const {
  std::int32_t offset = 0;
  std::memcpy(&offset, const_cast<BondRows*>(this)->field(slot, neighbour_offset), sizeof offset);
  return offset / static_cast<std::int32_t>(sizeof(DiscRecord));
}

/// Rounded up: a bond may be watched too early, never too late.
std::uint16_t BondRows::stored(double threshold) const {
  return static_cast<std::uint16_t>(std::min(largest_stored, std::ceil(threshold / threshold_unit_)));
}

void BondRows::set_damage(std::int64_t slot, double damage, double threshold) {
  damage_[at(slot)] = static_cast<float>(damage);
  threshold_[at(slot)] = stored(threshold);
  if (damage > 0.0) damaged_[at(slot / lanes_)] = 1;
}

void BondRows::clear(std::int64_t slot, std::int32_t own) {
  *field(slot, e0x) = *field(slot, e0y) = *field(slot, l0) = 0.0f;
  const std::int32_t offset = record_offset(own);
  std::memcpy(field(slot, neighbour_offset), &offset, sizeof offset);
  threshold_[at(slot)] = 0;
  length_residual_[at(slot)] = 0;
  damage_[at(slot)] = 0.0f;
  bond_[at(slot)] = -1;
}

double BondRows::padding() const {
  const auto filled = std::count_if(bond_.begin(), bond_.end(), [](std::int32_t b) { return b >= 0; });
  return filled > 0 ? static_cast<double>(bond_.size()) / static_cast<double>(filled) : 1.0;
}

void BondRows::build(const BondNetwork& network, std::int32_t discs, const BondLaw& law, double unit) {
  double weakest = 1.0, longest = 0.0;
  std::vector<std::int32_t> degree(at(discs), 0);
  for (std::int64_t b = 0; b < network.size(); ++b) {
    weakest = std::min(weakest, network.strength[at(b)]);
    longest = std::max(longest, network.reference_length[at(b)] / unit);
    if (network.state[at(b)] == BondState::compacted) continue;
    ++degree[at(network.i[at(b)])];
    ++degree[at(network.j[at(b)])];
  }
  threshold_unit_ = 1.0 / (weakest * largest_stored);
  length_residual_unit_ = longest * half_last_place / largest_fraction;

  rows_.build(degree);
  const std::size_t groups = rows_.groups(), slots = groups * at(lanes_);
  groups_.resize(groups * group_bytes());
  threshold_.resize(slots);
  length_residual_.resize(slots);
  damage_.resize(slots);
  bond_.resize(slots);
  damaged_.assign(groups, 0);
  rows_.for_each_place([&](std::int64_t slot, std::int32_t disc) { clear(slot, disc); });
  // Bonds are sorted by (i, j), so filling in order sorts every row by neighbour.
  std::vector<std::int32_t> filled(at(discs), 0);
  for (std::int64_t b = 0; b < network.size(); ++b) {
    if (network.state[at(b)] == BondState::compacted) continue;
    for (const bool forward : {true, false}) {
      const std::int32_t own = forward ? network.i[at(b)] : network.j[at(b)];
      const std::int32_t other = forward ? network.j[at(b)] : network.i[at(b)];
      const std::int64_t slot = rows_.place(own, filled[at(own)]++);
      if (network.state[at(b)] != BondState::intact) continue;  // keeps its empty place until the rows are compacted
      const double sign = forward ? 1.0 : -1.0;
      *field(slot, e0x) = static_cast<float>(sign * network.direction_x[at(b)]);
      *field(slot, e0y) = static_cast<float>(sign * network.direction_y[at(b)]);
      const double rest = network.reference_length[at(b)] / unit;
      const auto held = static_cast<float>(rest);
      *field(slot, l0) = held;
      length_residual_[at(slot)] =
          static_cast<std::int8_t>(std::lround((rest - static_cast<double>(held)) / length_residual_unit_));
      const std::int32_t offset = record_offset(other);
      std::memcpy(field(slot, neighbour_offset), &offset, sizeof offset);
      bond_[at(slot)] = static_cast<std::int32_t>(b);
      const double damage = network.damage[at(b)];
      set_damage(slot, damage, 1.0 / (network.strength[at(b)] * zeta_of_damage(law, damage)));
    }
  }
}

void BondRows::aim(BondTask& task, std::int32_t chunk) const {
  task.groups = groups_.data();
  task.threshold = threshold_.data();
  task.length_residual = length_residual_.data();
  task.damage = damage_.data();
  task.damaged = damaged_.data();
  rows_.aim(task, chunk);
}

}  // namespace perfora::solver
