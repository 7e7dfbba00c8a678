// What is here: what a file written by Perfora holds, as readable text. What is not: the history as CSV (run_result.h).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace perfora::report {

/// Aligned lines, with units, about a run (R.h5), a packing (P.h5), a checkpoint (checkpoint.h5), a journal
/// (journal.jsonl), a result (JSON of evaluate, pack, optimize), a design or study (TOML), or the folder of a study or
/// of a run that goes on. Read only: takes no lock, repairs nothing. Throws io::InputError for anything else, saying
/// what can be read.
std::string describe_file(const std::filesystem::path& path);

/// The lines of a JSON object of Perfora: names as words, values in people's units by the name of their key; null reads
/// "not reached". Objects within become headings; long arrays are counted only.
std::string summary_lines(const nlohmann::json& object);

}  // namespace perfora::report
