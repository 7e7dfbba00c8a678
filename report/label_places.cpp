// What is here: the place of each label: of those around its point the one that covers least. What is not: drawing.
#include "report/label_places.h"

#include <algorithm>
#include <array>
#include <limits>

namespace perfora::report {
namespace {

struct Direction {
  double x, y;
};
/// Page coordinates: y points down.
constexpr std::array<Direction, 8> directions{{{1, -1}, {1, 0}, {1, 1}, {0, -1}, {0, 1}, {-1, -1}, {-1, 0}, {-1, 1}}};
constexpr std::array<double, 3> distances{1.5, 9.0, 18.0};

double overlap(const Box& a, const Box& b) {
  const double width = std::min(a.right(), b.right()) - std::max(a.x, b.x);
  const double height = std::min(a.bottom(), b.bottom()) - std::max(a.y, b.y);
  return width > 0.0 && height > 0.0 ? width * height : 0.0;
}

}  // namespace

void LabelPlaces::keep_clear(double x, double y, double radius) {
  taken_.push_back({x - radius, y - radius, 2.0 * radius, 2.0 * radius});
}

double LabelPlaces::covered(const Box& box) const {
  double sum = box.width * box.height - overlap(box, area_);  // what sticks out of the area counts as well
  for (const Box& other : taken_) sum += overlap(box, other);
  return sum;
}

Box LabelPlaces::place(double x, double y, double radius, double width, double height) {
  Box best;
  double least = std::numeric_limits<double>::infinity();
  for (const double distance : distances)
    for (const Direction& to : directions) {
      const double reach = radius + distance;
      const Box box{x + to.x * (reach + 0.5 * width) - 0.5 * width, y + to.y * (reach + 0.5 * height) - 0.5 * height,
                    width, height};
      const double cover = covered(box);
      if (cover < least) {
        best = box;
        least = cover;
      }
    }
  taken_.push_back(best);
  return best;
}

}  // namespace perfora::report
