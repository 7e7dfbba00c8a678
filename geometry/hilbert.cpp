// What is here: CGAL's Hilbert sort over indices.
// What is not: any use of it.
#include "geometry/hilbert.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <numeric>

namespace perfora::geometry {

std::vector<std::size_t> hilbert_order(const std::vector<double>& x, const std::vector<double>& y) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Map = CGAL::Pointer_property_map<Kernel::Point_2>::type;
  std::vector<Kernel::Point_2> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.emplace_back(x[i], y[i]);
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const CGAL::Spatial_sort_traits_adapter_2<Kernel, Map> traits(CGAL::make_property_map(points));
  CGAL::hilbert_sort(order.begin(), order.end(), traits);
  return order;
}

}  // namespace perfora::geometry
