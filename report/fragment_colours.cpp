// What is here: one colour a fragment so that touching fragments differ (greedy graph colouring over neighbouring
// discs). What is not: drawing.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "report/block_picture.h"
#include "results/frame.h"

namespace perfora::report {
namespace {

/// Fragments of fewer discs share one grey: hundreds of crumbs in loud colours hide the pieces that carry load.
constexpr int dust = 6;
/// Discs nearer than this fraction of the sum of their radii count as neighbours in the picture.
constexpr double neighbour_reach = 1.3;

/// Pairs (a < b) of fragments with neighbouring discs, each once. No periodic images: only the picture counts.
std::vector<std::pair<std::int32_t, std::int32_t>> touching_fragments(const results::Frame& frame,
                                                                      std::span<const double> radius) {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  const std::size_t discs = radius.size();
  if (discs == 0) return pairs;
  const double side = 2.0 * neighbour_reach * *std::max_element(radius.begin(), radius.end());
  double left = frame.position[0], right = left, low = frame.position[1], high = low;
  for (std::size_t k = 0; k < discs; ++k) {
    left = std::min(left, frame.position[2 * k]);
    right = std::max(right, frame.position[2 * k]);
    low = std::min(low, frame.position[2 * k + 1]);
    high = std::max(high, frame.position[2 * k + 1]);
  }
  const auto columns = static_cast<std::int64_t>((right - left) / side) + 3;
  const auto rows = static_cast<std::int64_t>((high - low) / side) + 3;
  const auto cell_of = [&](std::size_t k) {
    const auto cx =
        std::clamp<std::int64_t>(static_cast<std::int64_t>((frame.position[2 * k] - left) / side) + 1, 1, columns - 2);
    const auto cy =
        std::clamp<std::int64_t>(static_cast<std::int64_t>((frame.position[2 * k + 1] - low) / side) + 1, 1, rows - 2);
    return static_cast<std::size_t>(cy * columns + cx);
  };
  std::vector<std::int32_t> head(static_cast<std::size_t>(columns * rows), -1);
  std::vector<std::int32_t> next(discs, -1);
  for (std::size_t k = 0; k < discs; ++k) {
    next[k] = head[cell_of(k)];
    head[cell_of(k)] = static_cast<std::int32_t>(k);
  }
  const auto compare = [&](std::size_t k, std::size_t other) {
    const std::int32_t a = frame.fragment[k];
    const std::int32_t b = frame.fragment[other];
    if (a >= b) return;
    const double dx = frame.position[2 * k] - frame.position[2 * other];
    const double dy = frame.position[2 * k + 1] - frame.position[2 * other + 1];
    const double reach = neighbour_reach * (radius[k] + radius[other]);
    if (dx * dx + dy * dy < reach * reach) pairs.emplace_back(a, b);
  };
  for (std::size_t k = 0; k < discs; ++k) {
    const auto home = static_cast<std::int64_t>(cell_of(k));
    for (std::int64_t dy = -1; dy <= 1; ++dy)
      for (std::int64_t dx = -1; dx <= 1; ++dx)
        for (std::int32_t other = head[static_cast<std::size_t>(home + dy * columns + dx)]; other >= 0;
             other = next[static_cast<std::size_t>(other)])
          compare(k, static_cast<std::size_t>(other));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::vector<int> colour_fragments(const results::Frame& frame, std::span<const double> radius, int colours) {
  std::int32_t last = 0;
  for (std::int32_t fragment : frame.fragment) last = std::max(last, fragment);
  const auto count = static_cast<std::size_t>(last) + 1;
  std::vector<int> size(count, 0);
  for (std::int32_t fragment : frame.fragment) ++size[static_cast<std::size_t>(fragment)];
  std::vector<std::vector<std::size_t>> neighbours(count);
  for (const auto& [a, b] : touching_fragments(frame, radius)) {
    neighbours[static_cast<std::size_t>(a)].push_back(static_cast<std::size_t>(b));
    neighbours[static_cast<std::size_t>(b)].push_back(static_cast<std::size_t>(a));
  }
  std::vector<std::size_t> order;
  for (std::size_t fragment = 1; fragment < count; ++fragment)
    if (size[fragment] >= dust) order.push_back(fragment);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });

  std::vector<int> chosen(count, dust_colour);
  chosen[0] = main_colour;
  std::vector<int> taken(static_cast<std::size_t>(colours));
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    std::fill(taken.begin(), taken.end(), 0);
    for (std::size_t other : neighbours[order[rank]])
      if (chosen[other] >= 0) ++taken[static_cast<std::size_t>(chosen[other])];
    int best = static_cast<int>(rank) % colours;
    for (int step = 1; step < colours; ++step) {
      const int candidate = (static_cast<int>(rank) + step) % colours;
      if (taken[static_cast<std::size_t>(candidate)] < taken[static_cast<std::size_t>(best)]) best = candidate;
    }
    chosen[order[rank]] = best;
  }
  return chosen;
}

}  // namespace perfora::report
