// What is here: a grid of cells over a periodic rectangle, to find what is near a point, and the nearest periodic
// image. What is not: any meaning of the points.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace perfora::geometry {

/// `difference` of two coordinates, both within one period of [0, period), brought to its nearest periodic image.
inline double nearest_image(double difference, double period, double half_period) {
  if (difference > half_period) difference -= period;
  if (difference < -half_period) difference += period;
  return difference;
}

/// Cells at least `reach` wide, each with its points in ascending order.
class CellGrid {
 public:
  /// `point(i)` returns something with members x and y in [0, width) x [0, height), for i < count.
  template <class Point>
  CellGrid(double width, double height, double reach, std::size_t count, Point point)
      : columns_(cells_along(width, reach)),
        rows_(cells_along(height, reach)),
        column_width_(width / columns_),
        row_height_(height / rows_),
        start_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0),
        members_(count) {
    std::vector<std::size_t> home(count);
    for (std::size_t i = 0; i < count; ++i) {
      home[i] = cell(column_of(point(i).x), row_of(point(i).y));
      ++start_[home[i] + 1];
    }
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int32_t slot = next[home[i]]++;
      members_[static_cast<std::size_t>(slot)] = static_cast<std::int32_t>(i);
    }
  }

  /// Calls visit(index) once for every point that may be within reach of (x, y), in a fixed order.
  template <class Visit>
  void for_each_near(double x, double y, Visit visit) const {
    const int column = column_of(x), row = row_of(y);
    // With fewer than three cells along a side all of them are near, and none may be met twice.
    const int first_column = columns_ < 3 ? 0 : column - 1, last_column = columns_ < 3 ? columns_ - 1 : column + 1;
    const int first_row = rows_ < 3 ? 0 : row - 1, last_row = rows_ < 3 ? rows_ - 1 : row + 1;
    for (int r = first_row; r <= last_row; ++r)
      for (int c = first_column; c <= last_column; ++c) {
        const std::size_t here = cell((c + columns_) % columns_, (r + rows_) % rows_);
        for (std::int32_t k = start_[here]; k < start_[here + 1]; ++k) visit(members_[static_cast<std::size_t>(k)]);
      }
  }

  /// The number of the cell that (x, y) lies in.
  std::size_t cell_at(double x, double y) const { return cell(column_of(x), row_of(y)); }
  double middle_x(std::size_t cell) const {
    return (static_cast<double>(cell % static_cast<std::size_t>(columns_)) + 0.5) * column_width_;
  }
  double middle_y(std::size_t cell) const {
    const std::size_t row = cell / static_cast<std::size_t>(columns_);
    return (static_cast<double>(row) + 0.5) * row_height_;
  }

 private:
  static int cells_along(double period, double reach) {
    // Finer grids than this cost memory and gain nothing.
    constexpr double most = 8192.0;
    return static_cast<int>(std::clamp(period / reach, 1.0, most));
  }
  int column_of(double x) const { return std::clamp(static_cast<int>(x / column_width_), 0, columns_ - 1); }
  int row_of(double y) const { return std::clamp(static_cast<int>(y / row_height_), 0, rows_ - 1); }
  std::size_t cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  int columns_, rows_;
  double column_width_, row_height_;
  std::vector<std::int32_t> start_, members_;
};

}  // namespace perfora::geometry
