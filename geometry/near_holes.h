// What is here: which holes of a periodic layout, and which of their images, lie near a point. What is not: whether the
// point lies in one (perforation.h).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/perforation.h"

namespace perfora::geometry {

/// A grid over the rectangle of a layout; each cell knows the holes and images whose box, grown by a margin, reaches
/// into it.
class NearHoles {
 public:
  /// Of a hole moved by `column` widths and `row` heights.
  struct Image {
    std::int32_t hole = 0;
    std::int32_t column = 0, row = 0;
  };

  /// Cost O(holes, and cells their boxes cover). Centres may lie outside the rectangle.
  NearHoles(const PerforationLayout& layout, double margin);

  /// All images within `margin` of (x, y), and some others; the point lies in [0, width] x [0, height].
  const std::vector<Image>& around(double x, double y) const { return cells_[cell(column_of(x), row_of(y))]; }

 private:
  std::size_t cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  int column_of(double x) const;
  int row_of(double y) const;

  int columns_ = 1, rows_ = 1;
  double column_width_, row_height_;
  std::vector<std::vector<Image>> cells_;
};

}  // namespace perfora::geometry
