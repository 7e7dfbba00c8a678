// What is here: making, finding and removing R.part/. What is not: what lies in it.
#include "solver/run_folder.h"

#include <fmt/format.h>

#include <sstream>

#include "io/error.h"
#include "io/files.h"

namespace perfora::solver {
namespace {

/// The configuration without the strain to run to: a stopped run may be resumed to another end.
std::string without_until(const std::string& config) {
  std::istringstream in(config);
  std::string out, line;
  while (std::getline(in, line))
    if (line.rfind("until", 0) != 0) out += line + "\n";
  return out;
}

}  // namespace

RunFolder::RunFolder(const std::filesystem::path& run_file) : folder_(run_file) {
  folder_.replace_extension(".part");
}

void RunFolder::start_afresh(const std::string& config) {
  std::filesystem::remove(checkpoint_file());  // first: a folder without it is never taken for a run to resume
  std::filesystem::remove_all(folder_);
  io::make_folders(folder_ / "frames");
  io::write_file(folder_ / "config.toml", config);
}

bool RunFolder::can_resume(const std::string& config,
                           const std::function<std::string(const std::string&)>& in_names_of_today) const {
  if (!std::filesystem::exists(checkpoint_file())) return false;
  std::string found = io::read_file(folder_ / "config.toml");
  // The first line is a comment on program, seeds and kernel; keys follow.
  const std::size_t keys = found.find('\n') + 1;
  if (in_names_of_today) found = found.substr(0, keys) + in_names_of_today(found.substr(keys));
  if (without_until(found) != without_until(config))
    throw io::InputError({(folder_ / "config.toml").string(), 0, ""},
                         "the unfinished run there has another configuration",
                         "--resume continues with the same design, seeds and program",
                         "use the same design, or start anew with --force");
  return true;
}

std::filesystem::path RunFolder::frame_file(int number) const {
  return folder_ / "frames" / fmt::format("{:05d}.h5", number);
}

std::vector<std::filesystem::path> RunFolder::frame_files(int count) const {
  std::vector<std::filesystem::path> files;
  for (int k = 0; k < count; ++k) files.push_back(frame_file(k));
  return files;
}

void RunFolder::remove() const {
  std::filesystem::remove_all(folder_);
}

}  // namespace perfora::solver
