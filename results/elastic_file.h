// What is here: the file of an elastic response (`perfora evaluate --elastic`): its record, its one reader and its one
// writer. What is not: the solution (solver/elastic/).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "geometry/packing.h"
#include "geometry/perforation.h"
#include "results/provenance.h"

namespace perfora::results {

/// Bonds that yield first, equally long, by rising strain.
struct FirstBonds {
  std::vector<double> x, y, strain;  ///< m, m, 1
  std::vector<std::int32_t> pairs;   ///< (n,2) discs
  std::vector<std::int32_t> mode;    ///< 0 tension, 1 shear
};

/// n discs.
struct ElasticResult {
  std::filesystem::path path;
  Provenance provenance;
  geometry::Packing clipped;
  geometry::PerforationLayout layout;
  std::vector<double> stiffness, affine_stiffness;  ///< (3,3) xx, yy, xy with engineering shear, Pa
  std::array<std::vector<double>, 3> displacement;  ///< (n,3) each: m, m, rad per unit strain xx, yy, xy
  std::vector<double> disc_strain;                  ///< (n) at which the first bond of a disc yields; infinite: none
  FirstBonds first_bonds;
  nlohmann::json summary;
};

/// Throws io::InputError for a file that is missing, not HDF5, of another `format`, or whose arrays do not agree.
ElasticResult read_elastic(const std::filesystem::path& path);
/// Whole or not at all; `elastic.path` does not count. Throws std::runtime_error when the disk fails.
void write_elastic(const std::filesystem::path& path, const ElasticResult& elastic);

}  // namespace perfora::results
