// What is here: the workshop drawing of a block: outline, holes, dimensions, thinnest wall, direction of loading, list
// of holes, title block. What is not: its forms as files (drawing.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "geometry/perforation.h"
#include "report/export/drawing.h"

namespace perfora::report {

/// What a drawing says beside the holes.
struct BlockSheet {
  std::string title;   ///< of the design
  std::string source;  ///< "designs/quick.toml, perfora 0.1.0"
  geometry::PerforationLayout layout;
  std::vector<std::pair<std::string, std::string>> notes;  ///< "material", "..."; a line each
};

/// Scale 1:1 on the smallest ISO sheet (A4 to A0, landscape or upright) that takes it, else on one as large as needed.
/// Holes that reach over an edge are drawn whole, at each edge. Never fails: what has no room (numbers in small holes,
/// rows of a long list) is left out, and the sheet says so.
Drawing draw_block_sheet(const BlockSheet& sheet);

}  // namespace perfora::report
