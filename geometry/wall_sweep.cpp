// What is here: the thinnest wall by a sweep over boxes, for holes of any shape. What is not: the definition
// (wall.cpp), which this is tested against.
#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

#include "geometry/wall.h"

namespace perfora::geometry {
namespace {

/// A hole moved by `column` widths and `row` heights.
struct Image {
  Bounds box;
  int hole = 0, column = 0, row = 0;
};

/// Images that may be nearer than `limit` to a hole of the cell, by the left end of their box.
std::vector<Image> images_near(const PerforationLayout& layout, const std::vector<Bounds>& boxes, double limit) {
  Bounds all = boxes[0];
  for (const Bounds& box : boxes)
    all = {std::min(all.left, box.left), std::max(all.right, box.right), std::min(all.bottom, box.bottom),
           std::max(all.top, box.top)};
  std::vector<Image> images;
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (int column = -2; column <= 2; ++column)
      for (int row = -2; row <= 2; ++row) {
        const Bounds box = boxes[k].moved_by(column * layout.width, row * layout.height);
        if (distance(box, all) <= limit) images.push_back({box, static_cast<int>(k), column, row});
      }
  std::sort(images.begin(), images.end(), [](const Image& a, const Image& b) { return a.box.left < b.box.left; });
  return images;
}

}  // namespace

// Own images first: they bound the wall. A pair whose boxes are farther apart than the best so far cannot be thinner.
// Of equal walls that of the lowest numbers is given, as by the definition.
ThinnestWall thinnest_wall_sweep(const PerforationLayout& layout) {
  ThinnestWall wall{std::numeric_limits<double>::infinity(), -1, -1};
  const std::vector<Perforation>& holes = layout.perforations;
  if (holes.empty()) return wall;
  const auto offer = [&wall](double gap, int first, int second) {
    if (std::tie(gap, first, second) < std::tie(wall.thickness, wall.first, wall.second)) wall = {gap, first, second};
  };
  const double rounding = 1e-12 * (layout.width + layout.height);
  const auto limit = [&] { return std::max(0.0, wall.thickness) + rounding; };
  std::vector<Bounds> boxes;
  double widest = 0.0;
  for (std::size_t k = 0; k < holes.size(); ++k) {
    boxes.push_back(holes[k].bounds());
    widest = std::max(widest, boxes.back().width());
    const int hole = static_cast<int>(k);
    for (const Point& image : {Point{layout.width, 0.0}, Point{0.0, layout.height}, Point{layout.width, layout.height},
                               Point{layout.width, -layout.height}})
      if (distance(boxes[k], boxes[k].moved_by(image.x, image.y)) <= limit())
        offer(holes[k].gap_to_image(image.x, image.y), hole, hole);
  }
  const std::vector<Image> images = images_near(layout, boxes, limit());
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const double least_left = boxes[k].left - widest - limit();
    auto image = std::lower_bound(images.begin(), images.end(), least_left,
                                  [](const Image& one, double left) { return one.box.left < left; });
    for (; image != images.end() && image->box.left <= boxes[k].right + limit(); ++image) {
      if (image->hole <= static_cast<int>(k)) continue;
      if (distance(boxes[k], image->box) > limit()) continue;
      offer(holes[k].signed_gap(holes[static_cast<std::size_t>(image->hole)], image->column * layout.width,
                                image->row * layout.height),
            static_cast<int>(k), image->hole);
    }
  }
  return wall;
}

}  // namespace perfora::geometry
