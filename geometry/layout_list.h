// What is here: holes that a design lists one by one. What is not: the other families (layout.h).
#pragma once

#include <vector>

#include "geometry/perforation.h"
#include "io/error.h"

namespace perfora::geometry {

struct LayoutOptions;

/// The holes of layout.holes or layout.file, centres brought into [0, width) x [0, height). `keys`: the origin of
/// layout.holes. Throws io::InputError for a file of more than `most` holes, one without a size or with a centre
/// outside the cell, a file that cannot be read.
std::vector<Perforation> listed_holes(const LayoutOptions& options, std::size_t most, const io::Origin& keys);

}  // namespace perfora::geometry
