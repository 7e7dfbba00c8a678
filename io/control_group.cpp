// What is here: limits of control groups read from the kernel's files. What is not: what follows from them.
#include "io/control_group.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace perfora::io {
namespace {

namespace fs = std::filesystem;

std::optional<double> first_number(const fs::path& file) {
  std::ifstream in(file);
  double value = 0.0;  // "max" is no number: no limit
  if (in >> value && value >= 0.0) return value;
  return std::nullopt;
}

/// Folders of the group of `controller` and of all groups around it, in version 2 (`controller` empty) or 1.
std::vector<fs::path> folders_of(const ControlGroupFiles& files, const std::string& controller) {
  std::ifstream in(files.membership);
  fs::path group = "/";
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    if (controllers.find("," + controller + ",") != std::string::npos) group = line.substr(second + 1);
  }
  const fs::path root = files.root / controller;
  std::vector<fs::path> folders;
  for (; group.has_relative_path(); group = group.parent_path()) folders.push_back(root / group.relative_path());
  folders.push_back(root);
  return folders;
}

/// The smallest of what `read` finds in both versions' folders.
std::optional<double> smallest(const ControlGroupFiles& files, const std::string& controller,
                               const std::function<std::optional<double>(const fs::path&)>& read) {
  std::optional<double> found;
  for (const std::string& version : {std::string(), controller})
    for (const fs::path& folder : folders_of(files, version))
      if (const std::optional<double> limit = read(folder)) found = std::min(found.value_or(*limit), *limit);
  return found;
}

}  // namespace

std::optional<double> processor_quota(const ControlGroupFiles& files) {
  return smallest(files, "cpu", [](const fs::path& folder) -> std::optional<double> {
    std::ifstream both(folder / "cpu.max");  // version 2: "quota period", or "max period"
    double quota = 0.0, period = 0.0;
    if (both >> quota >> period && quota > 0.0 && period > 0.0) return quota / period;
    const auto old_quota = first_number(folder / "cpu.cfs_quota_us");  // -1: no limit
    const auto old_period = first_number(folder / "cpu.cfs_period_us");
    if (old_quota && old_period && *old_quota > 0.0 && *old_period > 0.0) return *old_quota / *old_period;
    return std::nullopt;
  });
}

std::optional<double> memory_quota(const ControlGroupFiles& files) {
  return smallest(files, "memory", [](const fs::path& folder) {
    const auto limit = first_number(folder / "memory.max");
    return limit ? limit : first_number(folder / "memory.limit_in_bytes");  // without one it shows a huge number
  });
}

}  // namespace perfora::io
