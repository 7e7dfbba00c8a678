// What is here: what a file or folder of Perfora holds: the stored summary, or a description of what has none
// (checkpoints, journals, design files). What is not: how a summary reads (summary_text.h).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/schema.h"

namespace perfora::results {

/// The JSON object that a result file (.h5, .json) or the folder of a finished study, sweep, ensemble or calibration
/// holds; nothing where there is none (unfinished folders, checkpoints, other files). Throws io::InputError for a file
/// that is broken or not Perfora's.
std::optional<nlohmann::json> stored_summary(const std::filesystem::path& path);

/// What a TOML file is, by its sections: "study", "sweep", "calibration", "tolerance" or "design". Throws
/// io::InputError for a file that cannot be read.
std::string kind_of_toml(const std::filesystem::path& path);
/// The command that runs a file of this kind: "perfora optimize" for a "study".
std::string command_of(const std::string& kind);

/// Throws io::InputError for a file that is of another kind than `kind`, one of those above, and names the command for
/// what it is.
void require_kind(const std::vector<io::Entry>& entries, const std::filesystem::path& file, const std::string& kind);

/// Aligned lines about what has no summary: a checkpoint (checkpoint.h5), a journal (journal.jsonl), a design or study
/// (TOML), the companion of an XDMF file, or the folder of work that goes on. Read only: takes no lock, repairs
/// nothing. Throws io::InputError for anything else, saying what can be read.
std::string describe_file(const std::filesystem::path& path);

}  // namespace perfora::results
