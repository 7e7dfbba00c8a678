// What is here: where outputs are written and which ones are refused before any work.
// What is not: the writing (files.cpp).
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <system_error>

#include "io/descriptor.h"
#include "io/error.h"
#include "io/files.h"
#include "io/lock.h"

namespace perfora::io {
namespace {

constexpr int most_links = 40;  // as many as Linux follows
/// The longest that is put in the place of an output's extension: the temporary file of the data beside R.xdmf.
constexpr std::string_view longest_suffix = ".xdmf.h5.tmp-4194304-ffff";

std::filesystem::path containing_folder(const std::filesystem::path& path) {
  const std::filesystem::path folder = (path.has_filename() ? path : path.parent_path()).parent_path();
  return folder.empty() ? std::filesystem::path(".") : folder;
}

}  // namespace

std::filesystem::path output_target(const std::filesystem::path& path) {
  std::filesystem::path target = path;
  std::error_code none;
  for (int k = 0; k < most_links; ++k) {
    const std::filesystem::path next = std::filesystem::read_symlink(target, none);
    if (none) return target;
    target = target.parent_path() / next;
  }
  throw InputError({path.string(), 0, ""}, "is a symbolic link that leads in a circle", "", "name another output");
}

void check_name_length(const std::filesystem::path& path) {
  const std::filesystem::path named = path.has_filename() ? path : path.parent_path();
  const std::size_t stem = named.stem().string().size();
  const long limit = ::pathconf(containing_folder(path).c_str(), _PC_NAME_MAX);
  const std::size_t longest = limit > 0 ? static_cast<std::size_t>(limit) : NAME_MAX;
  if (stem + longest_suffix.size() > longest)
    throw InputError({path.string(), 0, ""},
                     fmt::format("the name is too long: {} bytes before its extension leave no room for the names of "
                                 "the files beside it",
                                 stem),
                     fmt::format("at most {} bytes", longest - longest_suffix.size()), "choose a shorter name");
  if (std::filesystem::path(path).replace_extension().string().size() + longest_suffix.size() >= PATH_MAX)
    throw InputError({path.string(), 0, ""}, "the path is too long", fmt::format("less than {} bytes", PATH_MAX),
                     "choose a shorter one");
}

void check_output(const std::filesystem::path& path, bool force, bool resume) {
  const Origin origin{path.string(), 0, ""};
  if (path.empty()) throw InputError(origin, "the output has no name", "", "give one with -o");
  check_name_length(path);
  const std::filesystem::path target = output_target(path), folder = containing_folder(target);
  // The lock makes a folder that is missing (lock.h), in the nearest one that is there.
  std::error_code ignored;
  std::filesystem::path there = folder;
  while (!std::filesystem::exists(there, ignored) && there.has_relative_path()) there = containing_folder(there);
  if (!std::filesystem::is_directory(there, ignored))
    throw InputError(origin,
                     fmt::format("its folder {} cannot be made: {} is no folder", folder.string(), there.string()), "",
                     "choose another output");
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    throw InputError(origin, "its folder " + there.string() + " is not writable", "", "choose another output");
  struct stat status {};
  if (::lstat(target.c_str(), &status) != 0) return;
  if (const std::string kind = kind_of_file(status.st_mode); !kind.empty())
    throw InputError(origin, "is " + kind, "only regular files are replaced", "choose another output");
  if (!force && !resume)
    throw InputError(origin, "already exists", "", "choose another output, --force to replace it or --resume to go on");
}

OutputLock claim_new_output(const std::filesystem::path& output, bool force) {
  check_output(output, true, false);  // that there is a folder for the lock, and what is there may be replaced
  OutputLock lock(output);
  if (!force && std::filesystem::exists(output))
    throw InputError({output.string(), 0, ""}, "already exists", "",
                     "--force replaces it, or name another output with -o");
  return lock;
}

}  // namespace perfora::io
