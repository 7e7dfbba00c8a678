// What is here: the holes of a block from a drawing of another program. What is not: reading the drawing
// (drawn_shapes.h), lists as CSV (layout_list.h).
#pragma once

#include <filesystem>
#include <vector>

#include "geometry/perforation.h"

namespace perfora::geometry {

struct LayoutOptions;

/// Whether the file's extension says that it is a drawing: .dxf, .svg or .wkt, in any case.
bool is_drawing(const std::filesystem::path& file);

/// The holes of layout.file, a drawing. The layer or group that options.file_layer names holds them; without it the one
/// called "holes", where there is one, else they are all closed outlines. The outline in a layer "block", or a
/// rectangle of the size of the cell, is the block: its lower left corner is that of the cell. Without one the
/// drawing's own origin is. A hole that is drawn at both edges it crosses is one hole. Throws io::InputError with file
/// and line for what cannot be read, a block of another size than the cell, a hole outside the cell, no hole at all,
/// more than `most`.
std::vector<Perforation> drawn_holes(const LayoutOptions& options, std::size_t most);

}  // namespace perfora::geometry
