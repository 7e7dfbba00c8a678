// What is here: the limits that control groups (cgroup v1 and v2: containers, batch systems, systemd) set this process.
// What is not: what follows from them (processors.h, memory.h).
#pragma once

#include <filesystem>
#include <optional>

namespace perfora::io {

/// Where the kernel shows control groups; other folders in tests.
struct ControlGroupFiles {
  std::filesystem::path membership = "/proc/self/cgroup";  ///< lines "number:controllers:path"
  std::filesystem::path root = "/sys/fs/cgroup";
};

/// Processors' worth of time the groups of this process allow (cpu.max, or cpu.cfs_quota_us over cpu.cfs_period_us):
/// the smallest on the way from its group to the root. Nothing where none is limited or nothing can be read.
std::optional<double> processor_quota(const ControlGroupFiles& files = {});

/// Bytes of memory they allow (memory.max, memory.limit_in_bytes), in the same way.
std::optional<double> memory_quota(const ControlGroupFiles& files = {});

}  // namespace perfora::io
