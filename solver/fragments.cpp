// What is here: clusters of intact bonds, labelled by area.
#include "solver/fragments.h"

#include <algorithm>

#include "solver/clusters.h"

namespace perfora::solver {

Fragments find_fragments(const BondNetwork& network, const std::vector<double>& radius) {
  const std::size_t n = radius.size();
  Clusters clusters(n);
  for (std::size_t b = 0; b < network.i.size(); ++b)
    if (network.state[b] == BondState::intact)
      clusters.join(static_cast<std::size_t>(network.i[b]), static_cast<std::size_t>(network.j[b]));
  std::vector<double> area(n, 0.0);
  std::vector<std::size_t> roots;
  double total = 0.0;
  for (std::size_t d = 0; d < n; ++d) {
    const std::size_t root = clusters.root(d);
    if (root == d) roots.push_back(d);
    area[root] += radius[d] * radius[d];
    total += radius[d] * radius[d];
  }
  std::stable_sort(roots.begin(), roots.end(), [&](std::size_t a, std::size_t b) { return area[a] > area[b]; });
  std::vector<std::int32_t> rank(n, 0);
  for (std::size_t k = 0; k < roots.size(); ++k) rank[roots[k]] = static_cast<std::int32_t>(k);
  Fragments fragments;
  fragments.label.resize(n);
  for (std::size_t d = 0; d < n; ++d) fragments.label[d] = rank[clusters.root(d)];
  fragments.count = static_cast<std::int32_t>(roots.size());
  if (!roots.empty() && total > 0.0) fragments.largest_fraction = area[roots[0]] / total;
  return fragments;
}

}  // namespace perfora::solver
