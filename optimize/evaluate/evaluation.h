// What is here: the one record of the project, Request -> Evaluation, the function that walks the whole way, and its
// JSON form (cache key, journal line, message to a worker, result of the command line). What is not: the search
// (driver.h), processes (executor.h).
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "geometry/packing.h"
#include "geometry/perforation.h"
#include "optimize/evaluate/design.h"
#include "solver/response.h"
#include "solver/run.h"

namespace perfora::io {
class Hdf5Writer;
}

namespace perfora::optimize {

struct EvaluateOptions {
  int threads = 1;
  std::filesystem::path run_file;      ///< R.h5, empty: none
  std::filesystem::path packing_file;  ///< P.h5 to take the periodic packing from (its key must agree); empty: make it
                                       ///< or take it from memory
  bool resume = false;
  double wall_time_limit = 0.0;  ///< s, 0: none
  std::string command_line;
  std::function<void(double, const std::string&)> progress;
};

/// What `perfora pack` reports, beside what evaluate reports.
struct PackSummary {
  std::int64_t discs = 0, perforations = 0;
  double mean_diameter = 0.0, solid_fraction = 0.0, porosity = 0.0, bonds_per_disc = 0.0;
  geometry::ThinnestWall thinnest_wall;
  double thinnest_wall_discretised = 0.0;
  double max_overlap_ratio = 0.0, coordination_number = 0.0, rattler_fraction = 0.0;
};

/// Layout, periodic packing, clipped packing of one design and replicate, with what was measured on them.
struct PackedDesign {
  geometry::PerforationLayout layout;
  geometry::Packing periodic;
  geometry::Packing clipped;
  PackSummary summary;
};

/// status, summary, curve of one design and replicate.
struct Evaluation {
  solver::RunStatus status = solver::RunStatus::completed;
  std::string reason;
  Seeds::Effective seeds;
  int replicate = 0;
  PackSummary pack;
  solver::Summary summary;
  solver::Performance performance;
  solver::History curve;
};

/// Makes layout and packing (the packing is kept in memory per key and reused within this process; `packing_file` reads
/// it from a file) and clips. Throws io::InputError; a packing that was not reached shows in periodic.quality.
PackedDesign pack_design(const DesignFile& design, const EvaluateOptions& options, int replicate);

/// With options.resume a run that is finished is read from its file, an unfinished one goes on from its checkpoint.
/// The whole way Design -> PerforationLayout -> Packing -> clipped Packing -> BondNetwork -> Simulation -> Response.
/// Throws io::InputError for bad input only.
Evaluation evaluate_design(const DesignFile& design, const EvaluateOptions& options, int replicate);

/// An evaluation that gave nothing: status `failed`, every result not reached (a design that cannot be laid out, a
/// worker that died).
Evaluation failed_evaluation(const std::string& reason, int replicate, const Seeds::Effective& seeds = {});

/// What r_H and the overlaps of a run are stated in: <d> of the size law, or the mean of the discs of an imported
/// packing, m.
double mean_diameter_of(const DesignFile& design, const geometry::Packing& periodic);

/// What every result file of a design begins and ends with: format, who wrote it and how, seeds; the resolved
/// configuration and `summary`, the object that --json prints.
void write_record(io::Hdf5Writer& file, const std::string& format, const DesignFile& design,
                  const nlohmann::json& summary, const std::string& command_line);

/// P.h5 of a packed design (docs/formats.md), whole or not at all; `summary` is the object that `perfora pack --json`
/// prints.
void write_pack_file(const std::filesystem::path& path, const DesignFile& design, const PackedDesign& packed,
                     const nlohmann::json& summary, const std::string& command_line);

/// Throws io::InputError unless `packing_file` holds the periodic packing that `design` and `replicate` ask for; what
/// --packing is checked with before work starts.
void require_packing_file(const DesignFile& design, const std::filesystem::path& packing_file, int replicate);

/// The evaluation a finished run file holds, when it is one of this design, seeds and strain; nothing when the file is
/// missing or its run was stopped. Throws io::InputError when it is a finished run of another configuration.
std::optional<Evaluation> finished_evaluation(const DesignFile& design, const std::filesystem::path& run_file,
                                              int replicate);

/// A JSON number, null where it was not reached (NaN or infinite).
nlohmann::json number(double value);

/// JSON forms. SI, engineering strain, null for what was not reached, never NaN.
nlohmann::json to_json(const PackSummary& summary);
nlohmann::json to_json(const solver::Summary& summary);
nlohmann::json to_json(const solver::Performance& performance);
nlohmann::json to_json(const Seeds::Effective& seeds);
/// schema "perfora.pack/1": what `perfora pack --json` prints; status "failed" when the packing was not reached.
nlohmann::json pack_record(const PackedDesign& packed, const Seeds::Effective& seeds,
                           const solver::Performance& performance);
/// schema "perfora.evaluate/1"; `with_curve` adds strain and stress arrays.
nlohmann::json to_json(const Evaluation& evaluation, bool with_curve);
Evaluation evaluation_from_json(const nlohmann::json& record);

/// One request of a search: the resolved design as TOML text, replicate, results_version. Equal requests have equal
/// keys.
struct Request {
  std::string design_toml;
  int replicate = 0;
  double until = 0.0;
  /// Where the run is written, and gone on with when it is there (finished or not) from the same instruction set;
  /// empty: nowhere. No part of the key.
  std::filesystem::path run_file = {};
  bool frames = false;  ///< few frames in the run file; otherwise none. No part of the key
  /// Hash over the design's keys that are not at their defaults, replicate, strain and results_version: a key that the
  /// program learns later leaves it as it is.
  std::string key() const;
};
nlohmann::json to_json(const Request& request);
Request request_from_json(const nlohmann::json& record);
/// The request for one replicate of a design; `until` = 0: as far as the design says.
Request make_request(const DesignFile& design, int replicate, double until = 0.0);
/// Frames and checkpoints change no result; left in a request's design, they would change its key.
void drop_output(Design& design);
/// Evaluates a request (used by in-process and child-process executors alike). A design that cannot be evaluated is an
/// Evaluation with status `failed` and the reason, so that a search goes on.
Evaluation evaluate_request(const Request& request, int threads);

}  // namespace perfora::optimize
