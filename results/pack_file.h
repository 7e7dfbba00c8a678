// What is here: P.h5, the file of a packing: its record, its one reader and its one writer. What is not: the groups
// /packing, /clipped and /layout (geometry/packing_file.h).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "geometry/packing.h"
#include "geometry/perforation.h"
#include "results/provenance.h"

namespace perfora::results {

struct PackResult {
  std::filesystem::path path;
  Provenance provenance;
  geometry::Packing periodic, clipped;
  geometry::PerforationLayout layout;
  nlohmann::json summary;
};

/// Throws io::InputError for a file that is missing, not HDF5, of another `format`, or whose arrays do not agree.
PackResult read_pack(const std::filesystem::path& path);
/// Whole or not at all; `pack.path` does not count. Throws std::runtime_error when the disk fails.
void write_pack(const std::filesystem::path& path, const PackResult& pack);

}  // namespace perfora::results
