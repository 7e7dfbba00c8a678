// What is here: calibration: stiffnesses and critical displacements of the bonds for a wanted E, nu, tensile and
// compressive strength; its file, its search, its result. What is not: the tests (material_tests.h).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/cancellation.h"
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
  double normal_stiffness = 0.0, tangential_stiffness = 0.0;                ///< N/m
  double critical_normal_stretch = 0.0, critical_shear_displacement = 0.0;  ///< m, as in the design file
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
  MaterialTests confirmation;  ///< all tests with the parameters found
  double seconds = 0.0;
};

struct CalibrationOptions {
  std::filesystem::path folder;
  int threads = 1;
  bool resume = false, force = false;
  std::string command_line;
  io::Cancellation cancellation;                             ///< requested: tests stop, finished ones are kept
  std::function<void(double, const std::string&)> progress;  ///< may be empty
};

/// k_t/k_n from nu and k_n from E by the elastic answer of the samples (a root and a division); delta_t0/delta_n0 from
/// the ratio of strengths by a bracketed secant in logarithms at thresholds that give nearly the wanted tensile
/// strength, delta_n0 by proportion; then all tests once more with what was found. Every point of the search is a line
/// of DIR/journal.jsonl and never tested twice. Writes journal.jsonl, material.toml (the design with the parameters
/// found), result.json, reachable.csv. Throws io::InputError.
CalibrationResult calibrate(const Calibration& calibration, const CalibrationOptions& options);

/// Largest number of points a calibration may test.
int most_points(const Calibration& calibration);

/// schema "perfora.calibrate/1".
nlohmann::json to_json(const CalibrationResult& result);

}  // namespace perfora::optimize
