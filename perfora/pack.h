// What is here: the disc packing of a design, cut by its openings: made, written, read. What is not: its compression
// (evaluate.h).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "perfora/design.h"
#include "perfora/evaluate.h"
#include "perfora/results.h"

namespace perfora {

/// Discs; equally long arrays, m. The origin is the lower left corner of the block.
struct Discs {
  std::vector<double> x;       ///< of the centres
  std::vector<double> y;       ///< of the centres
  std::vector<double> radius;  ///< of the discs
};

/// The rim of an opening as a closed polygon, anticlockwise, m; the last point is joined to the first. Openings at an
/// edge of the block reach beyond it.
struct Outline {
  std::vector<double> x;  ///< of the corners
  std::vector<double> y;  ///< of the corners
};

/// A packing: the discs that a block consists of.
struct Packing {
  Status status = Status::completed;  ///< failed: the wanted density was not reached; stopped: nothing is there
  std::string reason;                 ///< in words
  double width = 0.0;                 ///< of the block, m
  double height = 0.0;                ///< of the block, m
  Discs discs;                        ///< those left between the openings
  Discs periodic;                     ///< all, before the openings were cut out
  std::vector<Outline> openings;      ///< in the order of the layout
  std::vector<Measure> measures;      ///< "porosity", "solid_fraction", "thinnest_wall", ...

  /// The value of a measure, NaN where it is not known. Throws Error for an unknown key.
  double measure(const std::string& key) const;
};

/// How a packing is made.
struct PackOptions {
  int threads = 0;             ///< 0: one a processor. The packing does not depend on it
  int replicate = 0;           ///< 0, 1, ...: packings of other seeds of the same design
  std::filesystem::path file;  ///< packing file to write; empty: none
  bool force = false;          ///< replace a file that exists
  ProgressCallback progress;   ///< may be empty
  std::shared_ptr<Stop> stop;  ///< may be null; is requested where the callback says false, too
};

/// Makes the packing of a design, what `perfora pack` does. No file is written when it was not reached or stopped.
/// Throws Error for a design that cannot be laid out and a file that exists.
Packing pack(const Design& design, const PackOptions& options = {});

/// Reads a packing file P.h5. Throws Error for a file that is missing, damaged or no packing.
Packing read_packing(const std::filesystem::path& file);

}  // namespace perfora
