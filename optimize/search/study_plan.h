// What is here: how many designs each stage of a study runs and what that takes: the plan, and a budget made into one.
// What is not: carrying it out (driver.h), the estimate of one run (optimize/evaluate/estimate.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "optimize/search/study.h"

namespace perfora::optimize {

struct PlannedStage {
  std::string name;          ///< "map", "search", ...
  std::string fidelity;      ///< "": the design as it stands
  std::int64_t designs = 0;  ///< at most
  std::int64_t runs = 0;     ///< at most
  double run_seconds = 0.0;  ///< time of one processor for one run
  bool measured = false;     ///< that time: from fidelity.NAME.cost, else an estimate
  double seconds() const { return run_seconds * static_cast<double>(runs); }
};

/// The stages with something to run, in their order. What is taken from another folder is not run, so it is in none.
struct StudyPlan {
  std::vector<PlannedStage> stages;
  std::int64_t runs() const;
  double seconds() const;  ///< time of one processor
};
StudyPlan plan_of(const Study& study);

/// Time of one processor for a run of the start design at one of study.fidelities: its `cost`, or an estimate.
double run_seconds(const Study& study, std::size_t fidelity);

/// Whether a study has no map, race, fidelity or budget: its counts follow from its keys alone.
bool is_plain(const StudyKeys& keys);

/// Designs that enter each round of a race: 12, 6 for 12 finalists of which 4 are kept.
std::vector<int> race_rounds(const RaceKeys& keys);

/// Which numbers the study file leaves to the budget.
struct LeftOpen {
  bool map_designs = false, finalists = false;
};
/// Sets maxeval, and what is left open, so that plan_of() takes study.keys.budget: the end of the study comes first,
/// two fifths of what is left go to the map and the rest to the search. A function of the study alone. Throws
/// io::InputError, at `origin`, for a budget that holds no search.
void spend_budget(Study& study, const LeftOpen& open, const io::Origin& origin);

/// The counts that a budget became, for the head of a journal.
nlohmann::json planned(const Study& study);
/// Where the journal in `folder` is of a study with the same budget, its counts are taken: what a program estimates
/// today changes no study that has begun.
void keep_planned(Study& study, const std::filesystem::path& folder);

}  // namespace perfora::optimize
