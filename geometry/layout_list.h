// What is here: holes that a design lists one by one. What is not: the other families (layout.h).
#pragma once

#include <functional>
#include <vector>

#include "geometry/perforation.h"
#include "io/error.h"

namespace perfora::geometry {

struct LayoutOptions;

/// The holes of layout.holes or layout.file, centres brought into [0, width) x [0, height). `usual` makes the shape of
/// a row that names none from its diameter (> 0); `keys`: the origin of layout.holes. Columns of a file
/// (docs/user/formats.md): x, y, diameter, and shape, breadth, angle, corner_radius, wkt where it has them. Throws
/// io::InputError for a file of more than `most` holes or one that cannot be read, a hole without a size, of a shape
/// that cannot be, or with a centre outside the cell.
std::vector<Perforation> listed_holes(const LayoutOptions& options, const std::function<Shape(double)>& usual,
                                      std::size_t most, const io::Origin& keys);

}  // namespace perfora::geometry
