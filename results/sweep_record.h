// What is here: sweeps and ensembles read back from their files: cases, results with their scatter, and for pictures
// every run with its curve. What is not: running and writing them, comparing two (optimize/campaign/), pictures
// (report/).
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "results/curve.h"
#include "results/target.h"

namespace perfora::results {

/// Mean of a result over the replicates of a case, SI; NaN where it is not known.
struct CaseMean {
  double mean = 0.0;
  double half_interval = 0.0;  ///< of its 95 % confidence interval
};

/// One run that was made.
struct CaseRun {
  int replicate = 0;
  bool completed = false;
  std::filesystem::path run_file;         ///< that was kept; empty: none
  std::map<std::string, double> results;  ///< by the names of --json; NaN where not reached
  Curve curve;
};

struct SweepCase {
  int number = 0;  ///< 0: the design itself
  std::string label;
  bool can_run = true;
  int completed = 0;                        ///< replicates
  std::map<std::string, CaseMean> results;  ///< by the names of --json
  std::vector<CaseRun> runs;                ///< read by read_sweep_runs() and read_ensemble_record() only
  /// Where a picture puts it: group of cases that are drawn together, what their x axis is called, its place there and
  /// its series, as written.
  std::string group, axis, place, series;
};

struct SweepRecord {
  std::filesystem::path folder;
  std::string name;   ///< of its folder
  std::string title;  ///< of the file it came from
  std::string reason;
  int replicates = 0;                 ///< of each case, as requested
  std::vector<std::string> measures;  ///< that its picture shows
  std::vector<SweepCase> cases;
  std::vector<Wish> wishes;  ///< of the design
  /// Engineering strains between which the plateau is taken, as the design says that every case starts from; empty
  /// for a found plateau, and where an older program left them out.
  std::vector<double> plateau_window;
  /// {verdict, single_blocks} as results::to_json() writes them, of an ensemble or of a sweep of one case, where the
  /// design wishes something and a run was judged; else empty. Of several cases each has its own, in cases.csv.
  nlohmann::json judged = nlohmann::json::object();
  std::string design;           ///< of an ensemble: its resolved configuration; empty where it is not known
  std::vector<Curve> measured;  ///< of experiments, for pictures; no reader fills it
};

/// Reads a sweep's folder or result.json; without the runs. Throws io::InputError for anything else.
SweepRecord read_sweep_record(const std::filesystem::path& path);

/// Adds the runs from runs.csv and curves.csv of record.folder. Throws io::InputError.
void read_sweep_runs(SweepRecord& record);

/// Reads an ensemble's folder from its journal: one case, with its runs, of the results that a sweep shows. Throws
/// io::InputError for anything else.
SweepRecord read_ensemble_record(const std::filesystem::path& folder);

}  // namespace perfora::results
