// What is here: P.h5: /packing (periodic, unclipped, with its key), /layout, /clipped, /config. What is not: how they are made.
#pragma once

#include <filesystem>
#include <string>

#include "geometry/packing.h"
#include "geometry/perforation.h"
#include "io/hdf5.h"

namespace perfora::geometry {

/// Writes the three groups into an open file (docs/user/formats.md); used by P.h5 and R.h5 alike.
void write_packing(io::Hdf5Writer& file, const std::string& group, const Packing& packing);
void write_layout(io::Hdf5Writer& file, const std::string& group, const PerforationLayout& layout);
Packing read_packing(const io::Hdf5Reader& file, const std::string& group);
PerforationLayout read_layout(const io::Hdf5Reader& file, const std::string& group);

/// Throws io::InputError naming the first field in which `found` (of the file) disagrees with `wanted` (of the design), with both values.
void require_same_key(const PackingKey& wanted, const PackingKey& found, const std::filesystem::path& file);

}  // namespace perfora::geometry
