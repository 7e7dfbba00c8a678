// What is here: union-find with path halving, labels sorted by area.
#include "solver/fragments.h"

#include <algorithm>
#include <numeric>

namespace perfora::solver {

Fragments find_fragments(const BondNetwork& network, const std::vector<double>& radius) {
  const std::size_t n = radius.size();
  std::vector<std::int32_t> parent(n);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t k) {
    while (parent[static_cast<std::size_t>(k)] != k) {
      std::int32_t& up = parent[static_cast<std::size_t>(k)];
      up = parent[static_cast<std::size_t>(up)];
      k = up;
    }
    return k;
  };
  for (std::size_t b = 0; b < network.i.size(); ++b) {
    if (network.state[b] != BondState::intact) continue;
    const std::int32_t a = root(network.i[b]), c = root(network.j[b]);
    if (a != c) parent[static_cast<std::size_t>(std::max(a, c))] = std::min(a, c);
  }
  std::vector<double> area(n, 0.0);
  double total = 0.0;
  for (std::size_t d = 0; d < n; ++d) {
    area[static_cast<std::size_t>(root(static_cast<std::int32_t>(d)))] += radius[d] * radius[d];
    total += radius[d] * radius[d];
  }
  std::vector<std::int32_t> roots;
  for (std::size_t d = 0; d < n; ++d)
    if (parent[d] == static_cast<std::int32_t>(d)) roots.push_back(static_cast<std::int32_t>(d));
  std::stable_sort(roots.begin(), roots.end(), [&](std::int32_t a, std::int32_t b) {
    return area[static_cast<std::size_t>(a)] > area[static_cast<std::size_t>(b)];
  });
  std::vector<std::int32_t> rank(n, 0);
  for (std::size_t k = 0; k < roots.size(); ++k)
    rank[static_cast<std::size_t>(roots[k])] = static_cast<std::int32_t>(k);
  Fragments fragments;
  fragments.label.resize(n);
  for (std::size_t d = 0; d < n; ++d)
    fragments.label[d] = rank[static_cast<std::size_t>(root(static_cast<std::int32_t>(d)))];
  fragments.count = static_cast<std::int32_t>(roots.size());
  if (!roots.empty() && total > 0.0) fragments.largest_fraction = area[static_cast<std::size_t>(roots[0])] / total;
  return fragments;
}

}  // namespace perfora::solver
