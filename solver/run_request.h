// What is here: the request for one compression and its answer, as plain data. What is not: running it (run.h),
// setting it up (run_setup.h), its files (run_folder.h, results/run_file.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "geometry/packing.h"
#include "geometry/perforation.h"
#include "io/cancellation.h"
#include "results/history.h"
#include "results/measure_options.h"
#include "results/progress.h"
#include "results/provenance.h"
#include "results/summary.h"
#include "solver/options.h"

namespace perfora::solver {

struct Response;

struct RunRequest {
  const geometry::Packing* clipped = nullptr;  ///< discs to bond (Hilbert order)
  const geometry::PerforationLayout* layout = nullptr;
  SolverOptions options;
  results::MeasuringFrame measuring;  ///< what the curve is measured by; its reference area is that of the layout
  std::uint64_t noise_seed = 1;
  int threads = 1;
  double mean_diameter = 0.0;  ///< <d> of the size law, m: r_H = horizon x this
  /// R.h5; empty: nothing is written (a search needs only the response). While the run goes on, closed files grow in
  /// R.part/.
  std::filesystem::path run_file;
  bool resume = false;  ///< go on from R.part/ when it holds a checkpoint of the same configuration
  /// Turns a provenance.config, stored or of now, into what tells runs apart. May be empty: it is that.
  std::function<std::string(const std::string&)> comparable;
  const geometry::Packing* periodic = nullptr;  ///< unclipped packing for /packing in R.h5; may be null
  results::Provenance provenance;               ///< all but simd, threads and seconds
  double wall_time_limit = 0.0;   ///< s; 0: none. Reaching it writes a checkpoint and stops with status `stopped`.
  io::Cancellation cancellation;  ///< requested: a checkpoint is written, the run stops with reason "signal"
  /// /summary of R.h5, made from the finished response (what `perfora evaluate --json` prints). May be empty.
  std::function<nlohmann::json(const Response&)> summary;
  results::ProgressCallback progress;  ///< called every 0.05 % of strain; may be empty
};

struct Response {
  results::Summary summary;
  results::Performance performance;
  results::History history;
  std::int64_t discs = 0;
  std::int64_t bonds = 0;
  double bonds_per_disc = 0.0;  ///< 2 bonds/discs
};

}  // namespace perfora::solver
