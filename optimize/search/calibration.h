// What is here: calibration: stiffnesses and critical displacements of the bonds for a wanted E, nu, tensile and
// compressive strength; its file and its result. What is not: the search (calibration_search.h), the tests
// (material_tests.h).
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/cancellation.h"
#include "optimize/campaign/execution.h"
#include "optimize/evaluate/material_tests.h"
#include "optimize/evaluate/material_tests_file.h"

namespace perfora::optimize {

enum class ElasticReading { two_dimensional, plane_strain };

/// [calibrate]
struct CalibrationKeys {
  std::filesystem::path design;       ///< packing, horizon, law and density come from it; relative to the file
  double young_modulus = 0.0;         ///< Pa; 0: not wanted, k_n stays
  double poisson_ratio = 0.0;         ///< 0: not wanted, k_t/k_n stays
  double tensile_strength = 0.0;      ///< Pa; must be given
  double compressive_strength = 0.0;  ///< Pa; 0: not wanted, delta_t0/delta_n0 stays
  ElasticReading reading = ElasticReading::two_dimensional;  ///< how E and nu are meant
  bool vary_rupture_delay = false;  ///< try other zeta_max where the wanted ratio of strengths is out of reach
  double tolerance = 0.03;          ///< of each wanted number
  int replicates = 2;               ///< samples a point
  int maxeval = 14;                 ///< points of the search for delta_t0/delta_n0, a zeta_max
  bool chart = true;                ///< draw which ratios of strengths can be reached
  ExecutionKeys execution;          ///< the result does not depend on it
};

/// A calibration, read and checked.
struct Calibration {
  std::filesystem::path file;
  CalibrationKeys keys;
  std::shared_ptr<const DesignFile> start;
  std::vector<std::string> warnings;
};
/// `overrides` of calibrate.* go to the calibration, others to the design. Throws io::InputError.
Calibration read_calibration(const std::filesystem::path& path, const std::vector<std::string>& overrides);
/// Keys of a calibration file (Markdown).
std::string calibration_reference();

/// What a calibration sets.
struct BondParameters {
  double normal_stiffness = 0.0, tangential_stiffness = 0.0;                     ///< N/m
  double critical_normal_displacement = 0.0, critical_shear_displacement = 0.0;  ///< m, as in the design file
  double rupture_delay = 0.0;
};

/// One point of the plane (delta_t0/delta_n0, zeta_max) that was tested.
struct StrengthPoint {
  double shear_ratio = 0.0;                 ///< delta_t0/delta_n0
  double rupture_delay = 0.0;               ///< zeta_max
  results::Statistic tensile, compressive;  ///< Pa, over the samples
  bool of_chart = false;
  double ratio() const { return compressive.mean / tensile.mean; }
};

/// A wanted number and what came out.
struct CalibrationTarget {
  std::string name;  ///< as in [calibrate]
  double wanted = 0.0, reached = 0.0;
  bool met = false;
};

struct CalibrationResult {
  results::RunStatus status = results::RunStatus::completed;
  std::string reason;
  BondParameters found;
  std::vector<CalibrationTarget> targets;
  std::vector<std::string> not_met;  ///< a sentence each: what and why
  std::vector<StrengthPoint> points;
  MaterialTests confirmation;           ///< all tests with the parameters found
  std::vector<std::string> troubles;    ///< failures of the surroundings that ended it; it is `stopped` then
  std::filesystem::path material_file;  ///< that designs name as material.from; empty: not written
  double seconds = 0.0;
};

/// schema "perfora.calibrate/1".
nlohmann::json to_json(const CalibrationResult& result);

}  // namespace perfora::optimize
