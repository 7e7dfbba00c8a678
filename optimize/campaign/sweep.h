// What is here: the sweep file as plain data: a table of designs that differ from one design in named keys; reading and
// checking it. What is not: running it (sweep_run.h), its result files (sweep_result.h).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "optimize/campaign/execution.h"
#include "optimize/evaluate/design.h"
#include "optimize/evaluate/request.h"

namespace perfora::optimize {

/// [sweep]
struct SweepKeys {
  std::filesystem::path design;  ///< design file that every case starts from; relative to the sweep file
  int replicates = 1;            ///< a case; replicate r has the same seeds in every case
  double until = 0.0;            ///< engineering strain; 0: as the design says
  bool base = false;             ///< the design itself is case 0, to which all others are compared
  bool run_files = false;        ///< keep the run file of every simulation
  ExecutionKeys execution;       ///< the result does not depend on it
  std::string measures = "first_peak_stress, plateau_stress, densification_strain";  ///< that the picture shows
};

/// One row of the table.
struct SweepCase {
  int number = 0;     ///< from 1 in the order of the file; 0: the design itself
  std::string label;  ///< "horizon 2, amplitude 1.8", or its name in [rows]
  /// What is drawn together: "" for [rows] and [grid], the key for [each].
  std::string group;
  std::vector<DesignChange> settings;    ///< beyond the design and [set]
  std::shared_ptr<const Design> design;  ///< resolved
  /// Instead of `design`, one a replicate: blocks that differ from each other. Empty: they do not.
  std::vector<std::shared_ptr<const Design>> of_replicate;
  std::string problem;  ///< why it cannot be run; empty: it can

  Request request(int replicate) const {
    return {of_replicate.empty() ? design : of_replicate.at(static_cast<std::size_t>(replicate)), replicate, 0.0, {}};
  }
};

/// Names the simulation that answers a request: designs that differ in the grade of their material alone share it.
std::string simulation_key(const Request& request);

/// A sweep, read and checked. Copies share the design.
struct Sweep {
  std::filesystem::path file;
  SweepKeys keys;
  std::vector<std::string> measures;  ///< of keys.measures
  std::vector<SweepCase> cases;
  int left_out = 0;      ///< cases of the file that were not chosen
  std::string grid_key;  ///< of [grid], the one with several values that changes fastest; "" without [grid]
  /// Keys of [each] and how many values each has: the last cases, in this order.
  std::vector<std::pair<std::string, int>> each;
  std::vector<std::string> columns;  ///< every key that some case sets, in the order of the file
  std::shared_ptr<const DesignFile> start;
  std::vector<std::string> warnings;

  int workers(int asked) const;  ///< `asked`, or keys.workers, or one a processor, but not more than there are runs
  std::int64_t runs() const;     ///< simulations, at most: different designs that can be run x replicates
};

/// Reads a sweep file and the design it names. Cases: every row of [rows] with every combination of [grid], then the
/// values of [each] one at a time. `overrides` of [sweep], [set], [rows], [grid], [each] go to the sweep, all others to
/// the design, but not a key that the sweep varies. A case that breaks a rule across keys (overlapping holes) stays in
/// the table with its problem. Where `only` has texts, cases with none of them in their label are left out, but for the
/// design itself; the others keep their numbers. Throws io::InputError, also when no case can be run.
Sweep read_sweep(const std::filesystem::path& path, const std::vector<std::string>& overrides = {},
                 const std::vector<std::string>& only = {});

/// Keys of a sweep file in one printed reference (Markdown).
std::string sweep_reference();

/// Numbers of an evaluation that a sweep can show, by their names in --json.
const std::vector<std::string>& sweep_measures();
/// The names in "first_peak_stress, undulation". Throws io::InputError at `origin` for one that sweep_measures() lacks.
std::vector<std::string> measures_in(const std::string& list, const io::Origin& origin);
/// By the places of sweep_measures(); NaN where one was not reached.
std::vector<double> measures_of(const Evaluation& evaluation);

}  // namespace perfora::optimize
