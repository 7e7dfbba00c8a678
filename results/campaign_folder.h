// What is here: what can be said of the folder of a study, sweep, ensemble or calibration from its files. What is not:
// the records of each kind (study_record.h, sweep_record.h, calibration_record.h, ensemble_record.h).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace perfora::results {

/// "study", "sweep", "ensemble" or "calibration": by the first event of the journal, otherwise by the result file;
/// empty for a folder of none of them.
std::string campaign_kind(const std::filesystem::path& folder);

/// The same by the first event of the journal alone; empty without one, or where it cannot be read.
std::string kind_in_journal(const std::filesystem::path& folder);

/// Name of the file that the work came from, without its ending, as the journal has it; otherwise that of the folder.
std::string campaign_title(const std::filesystem::path& folder);

/// Events of DIR/journal.jsonl that are whole, up to the first one that is not; no lock is taken. Empty without a
/// journal.
std::vector<nlohmann::json> journal_events(const std::filesystem::path& folder);

}  // namespace perfora::results
