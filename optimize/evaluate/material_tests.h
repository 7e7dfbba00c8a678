// What is here: tests of a design's solid material: samples, replicates side by side, the material's numbers with their
// scatter, their record and file. What is not: one test (solver/material_test.h), calibration (calibration.h).
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/cancellation.h"
#include "optimize/evaluate/design.h"
#include "optimize/evaluate/evaluation.h"
#include "results/statistic.h"
#include "solver/material_test.h"

namespace perfora::optimize {

struct MaterialTestsOptions {
  int threads = 1;                     ///< tests run side by side, each on one thread
  int replicates = 1;                  ///< samples with packings and strength fields of their own
  io::Cancellation cancellation;       ///< requested: every test stops
  results::ProgressCallback progress;  ///< of all tests together; may be empty
  /// Called when a test is finished, from one thread at a time. May be empty.
  std::function<void(const solver::MaterialTestResult&, int replicate)> finished;
};

/// One test of one sample.
struct MaterialTestRun {
  int replicate = 0;
  solver::MaterialTestResult result;
};

/// All tests of a material. Statistics are over the replicates; names and units:
/// young_modulus, poisson_ratio (two-dimensional, from tension; from compression where there is no tension test),
/// shear_modulus, oedometric_modulus, tensile_strength, compressive_strength, shear_strength, oedometric_strength,
/// strength_ratio (compressive/tensile), fracture_energy (J/m2), characteristic_length (E G/sigma_t^2, m), and the
/// plane-strain reading young_modulus_plane_strain, poisson_ratio_plane_strain (docs/user/theory.md, "Material tests").
struct MaterialTests {
  results::RunStatus status = results::RunStatus::completed;
  std::string reason;
  Seeds::Effective seeds;
  std::int64_t discs = 0, bonds = 0;  ///< of replicate 0
  double mean_diameter = 0.0;         ///< m
  geometry::Packing sample;           ///< of replicate 0
  std::vector<MaterialTestRun> runs;  ///< by replicate, then by kind
  std::vector<results::Statistic> statistics;
  results::Performance performance;
};

/// The solid sample of a design: no perforations, a square cell of material_test.size (an imported packing keeps its cell).
/// Throws io::InputError for a sample too small for the discs.
DesignFile material_sample(const DesignFile& design);

/// The tests that [test] asks for. Throws io::InputError when it asks for none.
std::vector<solver::MaterialTestKind> wanted_tests(const DesignFile& design);

/// Runs the `kinds` on every replicate; a request to stop ends all of them. Throws io::InputError for bad input.
MaterialTests test_material(const DesignFile& design, const std::vector<solver::MaterialTestKind>& kinds,
                            const MaterialTestsOptions& options);

/// One test of one sample as an evaluation, for those who ask for many of them: its first peak is the strength and the
/// strain it was reached at; counts of steps and broken bonds; all else of a compression is not reached. The same bits
/// as in test_material(). Throws io::InputError for bad input.
Evaluation evaluate_material_test(const DesignFile& design, solver::MaterialTestKind kind, int replicate, int threads,
                                  const io::Cancellation& cancellation = {});

/// The kind that files and JSON name so. Throws io::InputError for another name.
solver::MaterialTestKind material_test_called(const std::string& name);

}  // namespace perfora::optimize
