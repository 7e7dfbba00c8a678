// What is here: two sweeps compared case by case. What is not: reading them (results/sweep_record.h), pictures
// (report/).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "optimize/campaign/rank_correlation.h"
#include "results/sweep_record.h"

namespace perfora::optimize {

using results::CaseMean;
using results::SweepRecord;

/// Reads a sweep's folder or result.json, or the folder of a map, whose designs are the cases; the cases alone that
/// have a completed replicate. Throws io::InputError for anything else and where no case has completed.
SweepRecord read_completed_sweep(const std::filesystem::path& path);

/// What a cheap sweep may stand for.
enum class Trust {
  trusted,      ///< it orders the cases as the other does: Spearman's coefficient is 0.8 or more, on 20 cases or more
  not_trusted,  ///< it does not
  too_few       ///< fewer cases: nothing can be said
};
inline constexpr double trusted_from = 0.8;
inline constexpr int fewest_cases = 20;
Trust trust_in(const RankCorrelation& correlation);
/// "trusted", "not trusted", "too few cases".
const char* trust_name(Trust trust);

/// Mean wall time of a run, s, from the journal of a folder; 0 where there is none.
double seconds_of_a_run(const std::filesystem::path& folder);

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
