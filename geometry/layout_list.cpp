// What is here: the rows of a list of holes. What is not: whether their walls are thick enough (layout.cpp).
#include "geometry/layout_list.h"

#include <cmath>
#include <string>

#include "geometry/layout.h"
#include "io/csv.h"
#include "io/text.h"

namespace perfora::geometry {
namespace {

std::string length_text(double length) {
  return io::quantity(length, io::Dimension::length);
}

double wrapped(double value, double period) {
  value -= period * std::floor(value / period);
  return value < period ? value : 0.0;
}

void add_listed(std::vector<Perforation>& holes, const LayoutOptions& cell, double x, double y, double diameter,
                const io::Origin& origin) {
  const std::string name = "hole " + std::to_string(holes.size() + 1);
  if (!(std::isfinite(diameter) && diameter > 0.0))
    throw io::InputError(origin, name + " has no size", "a positive diameter in metres",
                         "correct or leave out this hole");
  if (!(x >= 0.0 && x <= cell.width && y >= 0.0 && y <= cell.height))
    throw io::InputError(origin, name + " at (" + length_text(x) + ", " + length_text(y) + ") lies outside the cell",
                         "0 to " + length_text(cell.width) + " in x, 0 to " + length_text(cell.height) + " in y",
                         "give centres in metres within the cell");
  holes.push_back({wrapped(x, cell.width), wrapped(y, cell.height), Circle{diameter}});
}

}  // namespace

std::vector<Perforation> listed_holes(const LayoutOptions& options, std::size_t most, const io::Origin& keys) {
  std::vector<Perforation> holes;
  if (options.file.empty()) {
    for (std::size_t k = 0; k + 2 < options.holes.size(); k += 3)
      add_listed(holes, options, options.holes[k], options.holes[k + 1], options.holes[k + 2], keys);
    return holes;
  }
  const io::CsvTable table = io::read_csv(options.file, {"x", "y", "diameter"}, most);
  for (std::size_t k = 0; k < table.rows(); ++k)
    add_listed(holes, options, table.columns[0][k], table.columns[1][k], table.columns[2][k],
               {options.file.string(), table.lines[k], "layout.file"});
  return holes;
}

}  // namespace perfora::geometry
