// What is here: finished sweeps read back from their result.json, and two of them compared case by case. What is not:
// running and writing sweeps (sweep_run.h, sweep_result.h), pictures (report/).
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "optimize/campaign/rank_correlation.h"

namespace perfora::optimize {

/// Mean of a result over the replicates of a case, SI; NaN where it is not known.
struct CaseMean {
  double mean = 0.0;
  double half_interval = 0.0;  ///< of its 95 % confidence interval
};

struct SweepRecord {
  std::string name;  ///< of its folder
  struct Case {
    std::string label;
    int completed = 0;                        ///< replicates
    std::map<std::string, CaseMean> results;  ///< by the names of sweep_measures()
  };
  std::vector<Case> cases;  ///< those with a completed replicate
  /// Engineering strains between which the plateau is taken, as the design says that every case starts from; empty
  /// where an older program left them out.
  std::vector<double> plateau_window;
};

/// Reads a sweep's folder or result.json. Throws io::InputError for anything else and where no case has completed.
SweepRecord read_sweep_record(const std::filesystem::path& path);

/// One result of the cases that two sweeps share.
struct ComparedMeasure {
  std::string measure;
  std::vector<std::string> labels;         ///< of the cases both know, in the reference's order
  std::vector<CaseMean> reference, other;  ///< by label
  RankCorrelation correlation;
  double median_ratio = 0.0;  ///< of other over reference; NaN without pairs
};

/// Why numbers of the two may differ though the cases are the same: other plateau windows, other strains reached.
std::vector<std::string> differences(const SweepRecord& reference, const SweepRecord& other);

/// How `other` orders the cases that it shares with `reference` by label and that `only` chooses (case_choice.h).
/// `measures` are names of sweep_measures(). Throws io::InputError for fewer than three shared cases.
std::vector<ComparedMeasure> compare_sweeps(const SweepRecord& reference, const SweepRecord& other,
                                            const std::vector<std::string>& measures,
                                            const std::vector<std::string>& only);

/// One entry of schema "perfora.correlate/1": name of `other` and every measure with coefficient, interval and cases.
nlohmann::json to_json(const SweepRecord& other, const std::vector<ComparedMeasure>& compared);

}  // namespace perfora::optimize
