// What is here: a folder of long work made, locked, checked for resuming, or cleared. What is not: its journal.
#include "optimize/campaign/work_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "io/error.h"

namespace perfora::optimize {

void prepare_work_folder(const std::filesystem::path& folder, std::span<const char* const> own_files,
                         const std::string& what, bool force, bool resume) {
  const auto journal = folder / "journal.jsonl";
  std::error_code ignored;
  if (std::filesystem::exists(folder, ignored) && !std::filesystem::is_directory(folder, ignored))
    throw io::InputError({folder.string(), 0, ""}, fmt::format("this is a file, and a {} needs a folder", what), "",
                         "name another one with -o");
  const std::string there = work_in(folder);
  if (!there.empty() && there != what)
    throw io::InputError({folder.string(), 0, ""}, fmt::format("this folder holds a {}, not a {}", there, what), "",
                         "name another folder with -o");
  const bool begun = std::filesystem::exists(journal);
  for (const char* name : own_files)
    if (force && !resume && (begun || !std::filesystem::is_directory(folder / name, ignored)))
      std::filesystem::remove_all(folder / name);
  if (!resume && std::filesystem::exists(journal))
    throw io::InputError({folder.string(), 0, ""}, fmt::format("this folder holds a {} already", what), "",
                         "continue it with --resume, start over with --force, or name another folder with -o");
  if (!std::filesystem::exists(journal))
    for (const char* name : own_files)
      if (std::filesystem::exists(folder / name))
        throw io::InputError({(folder / name).string(), 0, ""}, fmt::format("a {} would overwrite this file", what), "",
                             "start over with --force, or name another folder with -o");
  std::filesystem::create_directories(folder, ignored);
  if (ignored)
    throw io::InputError({folder.string(), 0, ""}, fmt::format("the folder cannot be made ({})", ignored.message()), "",
                         "name another one with -o");
}

std::string work_in(const std::filesystem::path& folder) {
  std::ifstream journal(folder / "journal.jsonl", std::ios::binary);
  std::string line;
  std::getline(journal, line);
  const auto record = nlohmann::json::parse(line.substr(std::min(line.size(), line.find('{'))), nullptr, false);
  return record.is_object() ? record.value("event", "") : std::string();
}

}  // namespace perfora::optimize
