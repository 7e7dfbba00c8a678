// What is here: the holes of a layout as a workshop lists them: sizes, counts, chains of distances. What is not:
// drawing.
#pragma once

#include <string>
#include <vector>

#include "geometry/perforation.h"

namespace perfora::report {

/// A distance along an edge, m from the lower left corner, and what stands at it: "25", "5 x 25 = 125".
struct Chain {
  double from = 0.0, to = 0.0;
  std::string words;
};

class HoleList {
 public:
  /// `layout` must outlive the list.
  explicit HoleList(const geometry::PerforationLayout& layout);

  /// "Ø20" of a circle, "20 x 10" (longest, shortest extent) of other shapes; mm.
  std::string size_text(std::size_t hole) const;
  bool first_of_its_size(std::size_t hole) const;
  /// Whether every size can be named on a line.
  bool few_sizes() const;
  /// "36 x Ø20", "9 of 20 x 10", several sizes after each other, largest number first; of many "60, Ø7.44 to Ø16.4".
  std::string summary() const;
  /// From the edge to the first centre and from there on, along x or y. Empty where there are more places than a chain
  /// can show: the list says where the holes are.
  std::vector<Chain> chain_x() const;
  std::vector<Chain> chain_y() const;

 private:
  std::vector<Chain> chain(std::vector<double> places) const;
  const geometry::PerforationLayout& layout_;
  std::vector<std::string> sizes_;
};

}  // namespace perfora::report
