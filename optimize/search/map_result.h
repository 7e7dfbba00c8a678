// What is here: what the map of a study leaves behind. What is not: its record's form (results/map_record.h), drawing
// (report/).
#pragma once

#include <filesystem>

#include "optimize/search/driver.h"
#include "results/map_record.h"

namespace perfora::optimize {

/// The designs of a plan's map that are answered, measured as the study says today.
results::MapRecord map_record(const Study& study, CandidateBook& book, const Answers& answers, const Plan& plan);

/// Writes map.json and map.csv, each whole.
void write_map(const results::MapRecord& record, const std::filesystem::path& folder);

/// A sentence on the best design of the map for the wishes of today; empty where none is usable.
std::string best_of_map_text(const Study& study, const Plan& plan);
/// The same in a few words, while the map is made: "map, best so far: ...".
std::string standing_of_map(const Study& study, const Plan& plan);

}  // namespace perfora::optimize
