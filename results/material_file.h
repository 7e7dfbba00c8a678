// What is here: T.h5, the file of material tests: its record, its one reader and its one writer. What is not: the tests
// (solver/material_test.h).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "geometry/packing.h"
#include "results/break_event.h"
#include "results/frame.h"
#include "results/provenance.h"

namespace perfora::results {

/// Rows of a test: equally long columns. Strain and stress have the sign of the test (positive as the test loads).
struct MaterialCurve {
  std::vector<double> strain;          ///< engineering, of the height; shear: h_xy/h_yy
  std::vector<double> stress;          ///< Pa: along the loading; shear: the shear stress
  std::vector<double> lateral_strain;  ///< engineering, extension positive
  std::vector<double> lateral_stress;  ///< Pa, compression positive
  std::vector<double> damage;          ///< dissipated by damage so far, J per metre of depth
  std::vector<double> work, cundall;   ///< external work, Cundall damping, J per metre of depth
  std::vector<double> broken_bonds;
};

/// One test of T.h5; frame and events for replicate 0 only.
struct MaterialTest {
  std::string name;  ///< "tension", "compression", "shear", "oedometric"
  int replicate = 0;
  MaterialCurve curve;
  std::optional<Frame> frame;      ///< the sample at the end
  std::vector<BreakEvent> events;  ///< written beside the frame
};

struct MaterialResult {
  std::filesystem::path path;
  Provenance provenance;
  geometry::Packing sample;
  std::vector<MaterialTest> tests;  ///< by name, then by replicate
  nlohmann::json summary;
};

/// Throws io::InputError for a file that is missing, not HDF5, of another `format`, or whose arrays do not agree.
MaterialResult read_material_tests(const std::filesystem::path& path);
/// Whole or not at all; `result.path` does not count. Throws std::runtime_error when the disk fails.
void write_material_tests(const std::filesystem::path& path, const MaterialResult& result);

}  // namespace perfora::results
