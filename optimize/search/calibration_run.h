// What is here: a calibration carried out in a folder: elastic response, material tests by workers, confirmation,
// results. What is not: which points are tested (calibration_search.h), the keys and the record (calibration.h).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "io/cancellation.h"
#include "optimize/campaign/executor.h"
#include "optimize/search/calibration.h"

namespace perfora::optimize {

struct CalibrationOptions {
  std::filesystem::path folder;
  int threads = 1;  ///< of the packings and of the confirmation in this process
  bool resume = false, force = false;
  std::string command_line;
  results::ProgressCallback progress;  ///< may be empty
  /// Makes what carries the tests of the search; not called when the journal answers all of them.
  std::function<std::unique_ptr<Executor>()> make_executor;
  std::function<void()> results_written;  ///< called about once a minute, when results so far were; may be empty
  io::Cancellation cancellation;          ///< requested: tests stop, finished ones are kept
};

/// k_t/k_n from nu and k_n from E by the elastic response of the samples (a root and a division); delta_t0/delta_n0
/// from the ratio of strengths by a bracketed secant in logarithms at thresholds that give nearly the wanted tensile
/// strength, delta_n0 by proportion; then all tests once more with what was found, in this process. Every point of the
/// search is a line of DIR/journal.jsonl and never tested twice. Writes journal.jsonl, material.toml (the design with
/// the parameters found), calibrated.toml (their material alone, calibrated_material.h), result.json, reachable.csv,
/// confirmation.h5. Throws io::InputError.
CalibrationResult calibrate(const Calibration& calibration, const CalibrationOptions& options);

/// How many tests run at once: `asked`, or what the file says, or one a core (0: not given), but not more than can be
/// under way together.
int calibration_workers(const Calibration& calibration, int asked);

}  // namespace perfora::optimize
