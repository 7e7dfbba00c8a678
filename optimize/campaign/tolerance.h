// What is here: the tolerance analysis of a design as plain data: blocks as the design is, and blocks with one
// deviation each, as a sweep of paired seeds; reading and checking it. What is not: how a design is changed
// (deviation.h), running it (sweep_run.h), what comes out (tolerance_result.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "optimize/campaign/deviation.h"
#include "optimize/campaign/sweep.h"

namespace perfora::optimize {

/// [tolerance]. A deviation of 0 is left out.
struct ToleranceKeys {
  std::filesystem::path design;  ///< design file, or the folder of a study, whose best design is taken
  int replicates = 5;         ///< blocks of each kind; block r has the same seeds and, but for holes, material in all
  double until = 0.0;         ///< engineering strain; 0: as the design says
  double hole_size = 0.2e-3;  ///< m, either way
  double hole_position = 0.5e-3;      ///< m, in any direction
  double grade = 0.1;                 ///< either way
  double tilt = 0.08726646259971647;  ///< rad, 5 degrees, to either side in turn
  double shear = 0.02;                ///< to either side in turn
  ExecutionKeys execution;            ///< the result does not depend on it
};

/// One line of the analysis.
struct ToleranceCase {
  Deviation deviation = Deviation::hole_size;
  std::string label;     ///< "hole size +- 0.2 mm"
  double amount = 0.0;   ///< signed for the grade
  int number = 0;        ///< of its case in the sweep; 0: it is left out
  std::string left_out;  ///< why; empty: it is not
};

struct Tolerance {
  std::filesystem::path file;
  ToleranceKeys keys;
  std::vector<ToleranceCase> cases;
  Sweep sweep;  ///< case 0 is the design itself
};

/// Reads `path`: a design file, a file with a section [tolerance] that names one, or the folder of a study.
/// `overrides` are "section.key=value"; those of [tolerance] go there, all others to the design. The blocks of a
/// study's best design have seeds that nothing has chosen it by. Throws io::InputError, also for a design that wishes
/// nothing.
Tolerance read_tolerance(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

/// Keys of [tolerance] in one printed reference (Markdown).
std::string tolerance_reference();

}  // namespace perfora::optimize
