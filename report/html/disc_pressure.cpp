// What is here: normal forces of bonds and contacts summed up disc by disc. What is not: laws with history (shear,
// viscous forces).
#include "report/html/disc_pressure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <unordered_set>

#include "report/html/part.h"

namespace perfora::report {
namespace {

using results::Frame;
using results::FrameInfo;
using results::RunResult;

/// Vectors between discs, to the nearest image where the block is periodic.
struct Images {
  FrameInfo info;
  bool along_x, along_y;

  void nearest(double& dx, double& dy) const {
    if (along_y) {
      const double rows = std::round(dy / info.h_yy);
      dy -= rows * info.h_yy;
      dx -= rows * info.h_xy;
    }
    if (along_x) dx -= std::round(dx / info.h_xx) * info.h_xx;
  }
};

std::uint64_t pair_key(std::int32_t i, std::int32_t j) {
  const auto [low, high] = std::minmax(i, j);
  return (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint32_t>(high);
}

/// Discs sorted into square cells a little wider than the largest disc; periodic neighbours are found by images.
class Cells {
 public:
  Cells(const Frame& frame, const geometry::Packing& discs, const Images& images) : images_(images) {
    const double side = 2.0 * *std::max_element(discs.radius.begin(), discs.radius.end());
    left_ = low_ = 1e300;
    double right = -1e300, high = -1e300;
    for (std::size_t k = 0; k + 1 < frame.position.size(); k += 2) {
      left_ = std::min(left_, frame.position[k]);
      right = std::max(right, frame.position[k]);
      low_ = std::min(low_, frame.position[k + 1]);
      high = std::max(high, frame.position[k + 1]);
    }
    if (images.along_x) left_ = 0.0, right = images.info.h_xx;
    if (images.along_y) low_ = 0.0, high = images.info.h_yy;
    columns_ = std::max<std::int64_t>(1, static_cast<std::int64_t>((right - left_) / side));
    rows_ = std::max<std::int64_t>(1, static_cast<std::int64_t>((high - low_) / side));
    width_ = std::max((right - left_) / static_cast<double>(columns_), side * 1e-9);
    height_ = std::max((high - low_) / static_cast<double>(rows_), side * 1e-9);
    first_.assign(static_cast<std::size_t>(columns_ * rows_), -1);
    next_.assign(discs.radius.size(), -1);
    for (std::size_t d = 0; d < next_.size(); ++d) {
      auto& head = first_[index(column_of(frame.position[2 * d]), row_of(frame.position[2 * d + 1]))];
      next_[d] = head;
      head = static_cast<std::int32_t>(d);
    }
  }

  /// Calls visit(other) for every disc in the 3 x 3 cells around (x, y); none twice.
  template <class Visit>
  void around(double x, double y, Visit visit) const {
    std::int64_t seen[9];
    int count = 0;
    for (std::int64_t dr = -1; dr <= 1; ++dr)
      for (std::int64_t dc = -1; dc <= 1; ++dc) {
        std::int64_t column = column_of(x) + dc, row = row_of(y) + dr;
        if (images_.along_x) column = (column + columns_) % columns_;
        if (images_.along_y) row = (row + rows_) % rows_;
        if (column < 0 || column >= columns_ || row < 0 || row >= rows_) continue;
        const auto cell = static_cast<std::int64_t>(index(column, row));
        if (std::find(seen, seen + count, cell) != seen + count) continue;
        seen[count++] = cell;
        for (std::int32_t d = first_[static_cast<std::size_t>(cell)]; d >= 0; d = next_[static_cast<std::size_t>(d)])
          visit(d);
      }
  }

 private:
  std::int64_t column_of(double x) const {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>((x - left_) / width_), 0, columns_ - 1);
  }
  std::int64_t row_of(double y) const {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>((y - low_) / height_), 0, rows_ - 1);
  }
  std::size_t index(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }

  Images images_;
  double left_, low_, width_, height_;
  std::int64_t columns_, rows_;
  std::vector<std::int32_t> first_, next_;
};

}  // namespace

NormalSprings normal_springs(const RunResult& run) {
  const Configured keys(run.provenance.config);
  return {keys.number("material.normal_stiffness").value_or(0.0) * keys.number("material.grade").value_or(1.0),
          keys.text("material.damage_in_compression") == "full"};
}

std::vector<double> disc_pressure(const RunResult& run, const Frame& frame, const NormalSprings& springs) {
  const std::vector<double>& radius = run.clipped.radius;
  std::vector<double> pressure(radius.size(), 0.0);
  if (frame.has_forces()) {
    for (std::size_t d = 0; d < pressure.size(); ++d)
      pressure[d] = 0.5 * (frame.stress[3 * d] + frame.stress[3 * d + 1]);
    return pressure;
  }
  if (springs.stiffness <= 0.0 || radius.empty()) return pressure;
  const Images images{frame.info, !run.edges.open_x(), !run.edges.platens};
  const auto between = [&](std::size_t i, std::size_t j) {
    double dx = frame.position[2 * j] - frame.position[2 * i];
    double dy = frame.position[2 * j + 1] - frame.position[2 * i + 1];
    images.nearest(dx, dy);
    return std::hypot(dx, dy);
  };
  const auto add = [&](std::size_t i, std::size_t j, double tension, double length) {
    pressure[i] -= 0.25 * tension * length;
    pressure[j] -= 0.25 * tension * length;
  };
  // Lengths of all bonds by their pair: a frame names its intact bonds by their discs alone.
  std::vector<std::pair<std::uint64_t, double>> reference;
  reference.reserve(run.bonds.size());
  for (std::size_t b = 0; b < run.bonds.size(); ++b)
    reference.emplace_back(pair_key(run.bonds.pairs[2 * b], run.bonds.pairs[2 * b + 1]), run.bonds.reference_length[b]);
  std::sort(reference.begin(), reference.end());
  std::unordered_set<std::uint64_t> bonded;
  bonded.reserve(frame.bond_damage.size());
  for (std::size_t b = 0; b < frame.bond_damage.size(); ++b) {
    const auto i = static_cast<std::size_t>(frame.bond_pairs[2 * b]);
    const auto j = static_cast<std::size_t>(frame.bond_pairs[2 * b + 1]);
    const std::uint64_t key = pair_key(frame.bond_pairs[2 * b], frame.bond_pairs[2 * b + 1]);
    bonded.insert(key);
    const auto found = std::lower_bound(reference.begin(), reference.end(), std::pair(key, -1.0));
    if (found == reference.end() || found->first != key) continue;
    const double length = between(i, j), extension = length - found->second, damage = frame.bond_damage[b];
    const bool weakened = extension > 0.0 || springs.damage_in_compression;
    double tension = springs.stiffness * extension * (weakened ? 1.0 - damage : 1.0);
    if (springs.damage_in_compression)
      tension -= springs.stiffness * damage * std::max(0.0, radius[i] + radius[j] - length);
    add(i, j, tension, length);
  }
  const Cells cells(frame, run.clipped, images);
  for (std::size_t i = 0; i < radius.size(); ++i)
    cells.around(frame.position[2 * i], frame.position[2 * i + 1], [&](std::int32_t other) {
      const auto j = static_cast<std::size_t>(other);
      if (j <= i) return;
      const double length = between(i, j), overlap = radius[i] + radius[j] - length;
      if (overlap > 0.0 && !bonded.contains(pair_key(static_cast<std::int32_t>(i), other)))
        add(i, j, -springs.stiffness * overlap, length);
    });
  for (std::size_t d = 0; d < radius.size(); ++d) pressure[d] /= std::numbers::pi * radius[d] * radius[d];
  return pressure;
}

}  // namespace perfora::report
