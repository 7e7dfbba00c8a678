// What is here: what one compression is asked for and what it answers, as plain data. What is not: running it (run.h),
// setting it up (run_setup.h), its files (run_files.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "geometry/packing.h"
#include "geometry/perforation.h"
#include "solver/options.h"
#include "solver/response.h"

namespace perfora::solver {

/// Text written to R.h5 as it is: everything that says where a result came from.
struct Provenance {
  std::string config_toml;  ///< resolved configuration
  std::string seeds_json;
  std::string command_line;
  std::string program_version, git_revision, compiler;
  int results_version = 0;
};

struct Response;

struct RunRequest {
  const geometry::Packing* clipped = nullptr;  ///< discs to bond (Hilbert order)
  const geometry::PerforationLayout* layout = nullptr;
  SolverOptions options;
  std::uint64_t noise_seed = 1;
  int threads = 1;
  double mean_diameter = 0.0;  ///< <d> of the size law, m: r_H = horizon x this
  /// R.h5; empty: nothing is written (a search needs only the response). While the run goes on, closed files grow in
  /// R.part/.
  std::filesystem::path run_file;
  bool resume = false;  ///< go on from R.part/ when it holds a checkpoint of the same configuration
  const geometry::Packing* periodic = nullptr;  ///< unclipped packing for /packing in R.h5; may be null
  Provenance provenance;
  double wall_time_limit = 0.0;  ///< s; 0: none. Reaching it writes a checkpoint and stops with status `stopped`.
  /// Text for /summary of R.h5, made from the finished response (the JSON of `perfora evaluate --json`). May be empty.
  std::function<std::string(const Response&)> summary_text;
  /// Called at history rows: fraction done and a line with strain, stress, rate. May be empty.
  std::function<void(double, const std::string&)> progress;
};

struct Response {
  Summary summary;
  Performance performance;
  History history;
  std::int64_t discs = 0;
  std::int64_t bonds = 0;
  double bonds_per_disc = 0.0;  ///< 2 bonds/discs
};

}  // namespace perfora::solver
