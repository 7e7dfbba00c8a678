// What is here: a perforation as a name and numbers, for records that are written as text. What is not: the groups of
// HDF5 files (packing_file.h), who writes such records.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/perforation.h"

namespace perfora::geometry {

struct HoleRow {
  std::string shape;            ///< "circle"
  std::vector<double> numbers;  ///< x, y of the centre, then what the shape knows (circle: its diameter), m
};

HoleRow hole_row(const Perforation& hole);
/// Nothing for a shape that this program does not know, or another count of numbers.
std::optional<Perforation> hole_of(const HoleRow& row);

}  // namespace perfora::geometry
