// What is here: the thinnest wall by its definition, its place, and the choice between that and what is faster.
// What is not: the sweep (wall_sweep.cpp), CGAL (wall_apollonius.cpp), walls between clipped discs
// (wall_discretised.cpp).
#include "geometry/wall.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace perfora::geometry {

namespace {

/// Below this many holes all pairs are cheaper than nine times as many sites of a graph.
constexpr std::size_t brute_force_holes = 256;

/// The graph is one of circles; with any other shape among the holes the sweep is taken.
bool all_circles(const PerforationLayout& layout) {
  return std::all_of(layout.perforations.begin(), layout.perforations.end(),
                     [](const Perforation& hole) { return std::holds_alternative<Circle>(hole.shape); });
}

/// Where the wall that was found is: of the images of the two holes those with the least gap.
void find_place(const PerforationLayout& layout, ThinnestWall& wall) {
  if (wall.first < 0) return;
  const Perforation& first = layout.perforations[static_cast<std::size_t>(wall.first)];
  const Perforation& second = layout.perforations[static_cast<std::size_t>(wall.second)];
  double least = std::numeric_limits<double>::infinity();
  for (int column = -2; column <= 2; ++column)
    for (int row = -2; row <= 2; ++row) {
      if (wall.first == wall.second && column == 0 && row == 0) continue;
      const Gap gap = first.gap_to(second, column * layout.width, row * layout.height);
      if (gap.length < least) {
        least = gap.length;
        wall.from = gap.from;
        wall.to = gap.to;
      }
    }
}

}  // namespace

ThinnestWall thinnest_wall(const PerforationLayout& layout) {
  const bool few = layout.perforations.size() <= brute_force_holes;
  ThinnestWall wall = !all_circles(layout) ? thinnest_wall_sweep(layout)
                      : few                ? thinnest_wall_brute_force(layout)
                                           : thinnest_wall_apollonius(layout);
  find_place(layout, wall);
  return wall;
}

ThinnestWall thinnest_wall_brute_force(const PerforationLayout& layout) {
  ThinnestWall wall{std::numeric_limits<double>::infinity(), -1, -1};
  const auto offer = [&wall](double gap, std::size_t first, std::size_t second) {
    if (gap < wall.thickness) wall = {gap, static_cast<int>(first), static_cast<int>(second)};
  };
  const auto nearest = [](double difference, double period) { return -period * std::round(difference / period); };
  // Of two circles the image with the nearest centre is nearest. Long holes can be nearer with the next but one: with
  // extents below the periods none beyond those can.
  const int around = all_circles(layout) ? 0 : 2;
  for (std::size_t i = 0; i < layout.perforations.size(); ++i) {
    const Perforation& a = layout.perforations[i];
    for (const Point& image : {Point{layout.width, 0.0}, Point{0.0, layout.height}, Point{layout.width, layout.height},
                               Point{layout.width, -layout.height}})
      offer(a.gap_to_image(image.x, image.y), i, i);
    for (std::size_t j = i + 1; j < layout.perforations.size(); ++j) {
      const Perforation& b = layout.perforations[j];
      const double near_x = nearest(b.x - a.x, layout.width), near_y = nearest(b.y - a.y, layout.height);
      for (int column = -around; column <= around; ++column)
        for (int row = -around; row <= around; ++row)
          offer(a.signed_gap(b, near_x + column * layout.width, near_y + row * layout.height), i, j);
    }
  }
  return wall;
}

}  // namespace perfora::geometry
