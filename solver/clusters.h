// What is here: union-find, for fragments and cracks alike.
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace perfora::solver {

/// Items 0 to n-1 in clusters; the root of a cluster is its lowest item. Path halving.
class Clusters {
 public:
  explicit Clusters(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a > b) std::swap(a, b);
    parent_[b] = a;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace perfora::solver
