// What is here: a perforation as a name and numbers, for records that are written as text. What is not: the groups of
// HDF5 files (packing_file.h), who writes such records.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/perforation.h"

namespace perfora::geometry {

struct HoleRow {
  std::string shape;  ///< "circle" or "polygon"
  /// x, y of the centre, then what the shape knows, m. Circle: its diameter. Polygon: the radius round its core, then
  /// x, y of the corners of the core relative to the centre (two of a slot).
  std::vector<double> numbers;
};

HoleRow hole_row(const Perforation& hole);
/// Nothing for a shape that this program does not know, or another count of numbers.
std::optional<Perforation> hole_of(const HoleRow& row);

}  // namespace perfora::geometry
