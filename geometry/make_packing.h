// What is here: how dense periodic disc packings are made and imported. What is not: clipping (clip.h), HDF5 files
// (packing_file.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "geometry/clip.h"
#include "geometry/packing.h"
#include "io/cancellation.h"
#include "io/schema.h"

namespace perfora::geometry {

enum class PackingProtocol { dilate, quench };
/// Which axes of an imported file are those of the block.
enum class ImportPlane { xy, xz, yz };

/// Options of the design file's [packing] section. Lengths in m.
struct PackingOptions {
  double mean_diameter = 0.5044e-3;
  double maximum_diameter = 1.0e-3;
  double size_ratio = 3.0;      ///< d_max/d_min
  double solid_fraction = 0.0;  ///< 0: what compaction reaches
  PackingProtocol protocol = PackingProtocol::dilate;
  ClipRule clip = ClipRule::centre;
  std::filesystem::path file;  ///< discs to import instead of making a packing: import_packing
  std::string file_checksum;   ///< io::content_checksum() of that file
  ImportPlane file_plane = ImportPlane::xy;
  std::string file_unit;  ///< of its lengths; "": as the file says
};

void describe(io::Schema& schema, PackingOptions& options);

/// Memory is about 0.3 kB a disc; the whole way of a run takes far more.
inline constexpr std::int64_t maximum_discs = 5'000'000;
/// The cell must hold this many of the largest discs (as large as they are at jamming) along each side.
inline constexpr double largest_discs_along_a_side = 3.0;

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

/// A packing of someone else's, options.file, wrapped into the cell: CSV with columns of the plane and radius or
/// diameter (metres, file_unit, or units in the header), the last frame of a LAMMPS text dump, or a LAMMPS data file of
/// spheres. Of the latter two the box must be the cell. Throws io::InputError with file and line: for what cannot be
/// read, a unit that nobody says, a radius that does not belong in the cell, discs that lie in no plane or within each
/// other (also across the boundary), more area of discs than the cell has.
Packing import_packing(const PackingOptions& options, double width, double height);
/// What import_packing assumes of options.file that its writer may not have meant: a sentence without a full stop,
/// empty where there is nothing to say. Throws io::InputError for a file that cannot be read.
std::string import_note(const PackingOptions& options);

}  // namespace perfora::geometry
