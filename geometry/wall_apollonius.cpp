// What is here: the thinnest wall from the Apollonius graph (additively weighted Voronoi diagram) of the holes and
// their periodic images, for circular holes alone (thinnest_wall compares all pairs where there are others).
// What is not: the definition (wall.cpp), which this is tested against.
#include "geometry/wall.h"

#include <CGAL/Apollonius_graph_2.h>
#include <CGAL/Apollonius_graph_filtered_traits_2.h>
#include <CGAL/Apollonius_graph_hierarchy_2.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace perfora::geometry {

namespace {

using Plane = CGAL::Simple_cartesian<double>;
using Graph = CGAL::Apollonius_graph_hierarchy_2<CGAL::Apollonius_graph_filtered_traits_2<Plane>>;

/// A hole or a periodic image of it.
struct SiteImage {
  int hole = -1;
  double shift_x = 0.0, shift_y = 0.0;
};
using SiteKey = std::array<double, 3>;  // x, y, radius: what the graph keeps of a site

SiteKey key_of(const Graph::Site_2& site) {
  return {site.point().x(), site.point().y(), site.weight()};
}

}  // namespace

// Where the gap between two holes that are not nested is the smallest of all, the middle of it is nearest to these two
// and to no other hole (triangle inequality), so they share an edge of the graph. A hole inside another, or equal to
// it, is hidden from the graph: it is compared with all.
ThinnestWall thinnest_wall_apollonius(const PerforationLayout& layout) {
  ThinnestWall wall{std::numeric_limits<double>::infinity(), -1, -1};
  const auto offer = [&wall](double gap, int first, int second) {
    if (gap < wall.thickness) wall = {gap, std::min(first, second), std::max(first, second)};
  };
  const std::vector<Perforation>& holes = layout.perforations;
  Graph graph;
  std::map<SiteKey, SiteImage> images;
  std::vector<bool> hidden(holes.size(), false);
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const int hole = static_cast<int>(i);
    const double diameter = std::get<Circle>(holes[i].shape).diameter;
    offer(std::min(layout.width, layout.height) - diameter, hole, hole);
    for (int row = -1; row <= 1; ++row)
      for (int column = -1; column <= 1; ++column) {
        const SiteImage image{hole, column * layout.width, row * layout.height};
        const Graph::Site_2 site({holes[i].x + image.shift_x, holes[i].y + image.shift_y}, 0.5 * diameter);
        if (images.emplace(key_of(site), image).second)
          graph.insert(site);
        else
          hidden[i] = true;
      }
  }
  std::vector<bool> visible(holes.size(), false);
  for (auto site = graph.visible_sites_begin(); site != graph.visible_sites_end(); ++site) {
    const SiteImage& image = images.at(key_of(*site));
    if (image.shift_x == 0.0 && image.shift_y == 0.0) visible[static_cast<std::size_t>(image.hole)] = true;
  }
  for (auto edge = graph.finite_edges_begin(); edge != graph.finite_edges_end(); ++edge) {
    const SiteImage& a = images.at(key_of(edge->first->vertex((edge->second + 1) % 3)->site()));
    const SiteImage& b = images.at(key_of(edge->first->vertex((edge->second + 2) % 3)->site()));
    const Perforation& first = holes[static_cast<std::size_t>(a.hole)];
    const Perforation& second = holes[static_cast<std::size_t>(b.hole)];
    offer(first.signed_gap(second, b.shift_x - a.shift_x, b.shift_y - a.shift_y), a.hole, b.hole);
  }
  const auto nearest = [](double difference, double period) { return -period * std::round(difference / period); };
  for (std::size_t i = 0; i < holes.size(); ++i) {
    if (visible[i] && !hidden[i]) continue;
    for (std::size_t j = 0; j < holes.size(); ++j) {
      if (j == i) continue;
      const double shift_x = nearest(holes[j].x - holes[i].x, layout.width);
      const double shift_y = nearest(holes[j].y - holes[i].y, layout.height);
      offer(holes[i].signed_gap(holes[j], shift_x, shift_y), static_cast<int>(i), static_cast<int>(j));
    }
  }
  return wall;
}

}  // namespace perfora::geometry
