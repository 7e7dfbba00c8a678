// What is here: the holes of a layout as a path of SVG. What is not: pictures for files (block_picture.h).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "geometry/perforation.h"

namespace perfora::report {

/// {width, height (mm), path}: the rims of all holes and of their images that reach into the cell, mm, y downwards from
/// the cell's upper edge.
nlohmann::json layout_facts(const geometry::PerforationLayout& layout);

/// The layout that a resolved configuration (TOML) lays out; `seed` is that of random families. Nothing where the
/// configuration is of another program or cannot be laid out.
std::optional<geometry::PerforationLayout> layout_of(const std::string& configuration, std::uint64_t seed);

}  // namespace perfora::report
