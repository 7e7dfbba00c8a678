// What is here: the rules for folders of long work. What is not: the journal's events.
#include "optimize/campaign/work_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "io/error.h"
#include "io/files.h"
#include "io/litter.h"
#include "io/progress.h"
#include "results/campaign_folder.h"

namespace perfora::optimize {
namespace {

namespace fs = std::filesystem;

/// "a study", "an ensemble".
std::string with_article(const std::string& what) {
  const bool vowel = std::string("aeiou").find(what.front()) != std::string::npos;
  return (vowel ? "an " : "a ") + what;
}

/// What `names` stand for in `folder`, as far as it is there.
std::vector<fs::path> own_paths(const fs::path& folder, const std::vector<std::string>& names) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const std::string& name : names) {
    if (!name.ends_with('*')) {
      if (fs::exists(folder / name, ignored)) found.push_back(folder / name);
      continue;
    }
    const std::string start = name.substr(0, name.size() - 1);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
      if (entry.path().filename().string().starts_with(start)) found.push_back(entry.path());
  }
  return found;
}

void remove_whole(const fs::path& path) {
  std::error_code failed;
  fs::remove_all(path, failed);
  if (failed) io::fail_writing(path, failed.value());
}

}  // namespace

io::OutputLock claim_work_folder(const fs::path& folder, const std::vector<std::string>& own_files,
                                 const std::string& what, bool force, bool resume) {
  io::check_name_length(folder);
  const auto journal = folder / "journal.jsonl";
  std::error_code failed, ignored;
  const auto refuse = [](const fs::path& path, const std::string& problem, const std::string& remedy) {
    throw io::InputError({path.string(), 0, ""}, problem, "", remedy);
  };
  if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
    refuse(folder, fmt::format("this is a file, and {} needs a folder", with_article(what)),
           "name another one with -o");
  fs::create_directories(folder, failed);
  if (failed == std::errc::no_space_on_device || failed == std::errc::io_error)
    io::fail_writing(folder, failed.value());
  if (failed)
    refuse(folder, fmt::format("the folder cannot be made ({})", failed.message()), "name another one with -o");
  io::OutputLock lock(journal);
  const std::string there = results::kind_in_journal(folder);
  if (!there.empty() && there != what)
    refuse(folder, fmt::format("this folder holds {}, not {}", with_article(there), with_article(what)),
           "name another folder with -o");
  const bool begun = fs::exists(journal);
  if (resume && !begun)
    io::log_warning(fmt::format("{} holds no {} to resume: a new one begins", folder.string(), what));
  if (begun && !resume && !force)
    refuse(folder, fmt::format("this folder holds {} already", with_article(what)),
           "continue it with --resume, start over with --force, or name another folder with -o");
  if (force && !resume)
    for (const fs::path& path : own_paths(folder, own_files))
      if (path != journal && (begun || !fs::is_directory(path, ignored))) remove_whole(path);
  if (force && !resume) remove_whole(journal);  // Last: a kill before leaves a folder that --force still knows.
  if (!fs::exists(journal))
    for (const fs::path& path : own_paths(folder, own_files)) {
      const bool is_folder = fs::is_directory(path, ignored);
      refuse(path, fmt::format("{} would overwrite this {}", with_article(what), is_folder ? "folder" : "file"),
             is_folder ? "name another folder with -o, or move this one"
                       : "start over with --force, or name another folder with -o");
    }
  io::remove_dead_temporaries(folder);
  for (const char* sub : {"runs", "histories"}) io::remove_dead_temporaries(folder / sub);
  return lock;
}

}  // namespace perfora::optimize
