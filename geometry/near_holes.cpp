// What is here: boxes of holes and their images in a grid. What is not: points in a grid (cell_grid.h).
#include "geometry/near_holes.h"

#include <algorithm>
#include <cmath>

namespace perfora::geometry {

NearHoles::NearHoles(const PerforationLayout& layout, double margin)
    : column_width_(layout.width), row_height_(layout.height) {
  // About two cells along each hole: finer ones cost memory and spare few tests.
  constexpr double cells_per_hole = 4.0, most_along_a_side = 1024.0;
  const double count = static_cast<double>(layout.perforations.size());
  const double side = std::sqrt(layout.width * layout.height / std::max(1.0, cells_per_hole * count));
  columns_ = static_cast<int>(std::clamp(layout.width / side, 1.0, most_along_a_side));
  rows_ = static_cast<int>(std::clamp(layout.height / side, 1.0, most_along_a_side));
  column_width_ = layout.width / columns_;
  row_height_ = layout.height / rows_;
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  const double rounding = 1e-12 * (layout.width + layout.height);
  for (std::size_t k = 0; k < layout.perforations.size(); ++k) {
    const Bounds box = layout.perforations[k].bounds().grown_by(margin + rounding);
    const auto first = [](double end, double period) { return static_cast<int>(std::ceil(-end / period)); };
    const auto last = [](double begin, double period) { return static_cast<int>(std::floor(1.0 - begin / period)); };
    for (int b = first(box.top, layout.height); b <= last(box.bottom, layout.height); ++b)
      for (int a = first(box.right, layout.width); a <= last(box.left, layout.width); ++a) {
        const Bounds image = box.moved_by(a * layout.width, b * layout.height);
        for (int row = row_of(image.bottom); row <= row_of(image.top); ++row)
          for (int column = column_of(image.left); column <= column_of(image.right); ++column)
            cells_[cell(column, row)].push_back({static_cast<std::int32_t>(k), a, b});
      }
  }
}

int NearHoles::column_of(double x) const {
  return static_cast<int>(std::clamp(x / column_width_, 0.0, columns_ - 1.0));
}

int NearHoles::row_of(double y) const {
  return static_cast<int>(std::clamp(y / row_height_, 0.0, rows_ - 1.0));
}

}  // namespace perfora::geometry
