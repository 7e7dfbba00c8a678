// What is here: how dense periodic disc packings are made and imported. What is not: clipping (clip.h), HDF5 files
// (packing_file.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "geometry/clip.h"
#include "geometry/packing.h"
#include "io/cancellation.h"
#include "io/schema.h"

namespace perfora::geometry {

enum class PackingProtocol { dilate, quench };

/// Options of the design file's [packing] section. Lengths in m.
struct PackingOptions {
  double mean_diameter = 0.5044e-3;
  double maximum_diameter = 1.0e-3;
  double size_ratio = 3.0;      ///< d_max/d_min
  double solid_fraction = 0.0;  ///< 0: what compaction reaches
  PackingProtocol protocol = PackingProtocol::dilate;
  ClipRule clip = ClipRule::centre;
  std::filesystem::path file;  ///< CSV (x, y, radius in metres) to import instead of making one
};

void describe(io::Schema& schema, PackingOptions& options);

/// Raised with every change of the bits make_packing gives.
inline constexpr int packing_algorithm_version = 2;

PackingKey packing_key(const PackingOptions& options, double width, double height, std::uint64_t seed);

/// Number of discs make_packing will use for a wanted solid fraction (or its estimate of the jamming fraction when 0).
std::int64_t expected_discs(const PackingOptions& options, double width, double height);

/// The periodic, unclipped packing of a key; bitwise repeatable for one binary whatever the number of threads.
/// A fraction that is not reached is `quality.reached = false`, not an exception. `progress(fraction_done, text)` may
/// be empty. Throws io::Cancelled once `cancellation` is requested.
Packing make_packing(const PackingOptions& options, double width, double height, std::uint64_t seed, int threads,
                     const std::function<void(double, const std::string&)>& progress = {},
                     const io::Cancellation& cancellation = {});

/// A packing of someone else's: CSV with columns x, y, radius (metres), wrapped into the cell. Throws io::InputError
/// with file and line: for a radius that does not belong in the cell, for a disc that lies within another (also across
/// the boundary), for more area of discs than the cell has.
Packing import_packing(const std::filesystem::path& csv, double width, double height);

}  // namespace perfora::geometry
