// What is here: a disc packing as plain data, its identity (PackingKey) and its measured quality.
// What is not: how it is made (make_packing.h), files (packing_file.h), CGAL.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace perfora::geometry {

/// Identity of a periodic packing: equal keys mean equal bits. Every field enters the comparison.
struct PackingKey {
  double width = 0.0;             ///< m
  double height = 0.0;            ///< m
  double mean_diameter = 0.0;     ///< number mean of the size law, m
  double maximum_diameter = 0.0;  ///< m
  double size_ratio = 0.0;        ///< d_max/d_min
  double solid_fraction = 0.0;    ///< wanted; 0: what compaction reaches
  std::string protocol;           ///< "dilate", "quench" or "imported"
  std::uint64_t seed = 0;
  int algorithm_version = 0;  ///< raised with every change of the bits the packing algorithm gives
  std::string source;         ///< imported packings: checksum of the file; "" otherwise

  bool operator==(const PackingKey&) const = default;
};

/// What was measured on a packing.
struct PackingQuality {
  double solid_fraction = 0.0;       ///< area of discs over area of the cell (overlaps counted twice)
  double jamming_fraction = 0.0;     ///< what compaction reached; 0 where it was not compacted
  double max_overlap_ratio = 0.0;    ///< largest overlap over the smaller diameter of its pair
  double coordination_number = 0.0;  ///< contacts per disc, rattlers left out; 0 where nothing touches
  double rattler_fraction = 0.0;     ///< fraction of discs with fewer than three contacts
  std::int64_t iterations = 0;       ///< of the minimiser
  bool reached = true;  ///< false: wanted fraction or overlap limit not reached; a numerical failure, not an error
  std::string reason;   ///< why not
};

/// Discs in a periodic rectangle [0, width) x [0, height); equally long arrays, metres.
struct Packing {
  PackingKey key;
  double width = 0.0;
  double height = 0.0;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> radius;
  PackingQuality quality;

  std::int32_t size() const { return static_cast<std::int32_t>(x.size()); }
  double mean_diameter() const;
};

/// Largest overlap, contacts, rattlers of a periodic packing as it stands.
PackingQuality measure_packing(const Packing& packing);

}  // namespace perfora::geometry
