// What is here: memory as the operating system reports it.
#include "io/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "io/control_group.h"

namespace perfora::io {

double peak_memory_bytes() {
  constexpr double kilobyte = 1024.0;  // ru_maxrss counts these
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return kilobyte * static_cast<double>(usage.ru_maxrss);
}

double usable_memory_bytes() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (const auto quota = memory_quota()) bytes = std::min(bytes, *quota);
  rlimit space = {};
  if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
    bytes = std::min(bytes, static_cast<double>(space.rlim_cur));
  return bytes;
}

}  // namespace perfora::io
