// What is here: processors counted by affinity, quota and environment. What is not: control groups' files
// (control_group.cpp).
#include "io/processors.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <thread>

namespace perfora::io {
namespace {

int processors_of_machine() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Those of the affinity mask; machines with more than the mask holds (1,024) count as they are.
int processors_of_mask() {
  cpu_set_t mask;
  CPU_ZERO(&mask);
  if (sched_getaffinity(0, sizeof mask, &mask) != 0) return processors_of_machine();
  return std::max(1, CPU_COUNT(&mask));
}

}  // namespace

int usable_processors(const ControlGroupFiles& files) {
  const int allowed = processors_of_mask();
  const std::optional<double> quota = processor_quota(files);
  if (!quota || *quota >= allowed) return allowed;
  return std::max(1, static_cast<int>(std::ceil(*quota)));
}

int default_threads() {
  const int usable = usable_processors();
  const char* wanted = std::getenv("OMP_NUM_THREADS");
  const long number = wanted ? std::strtol(wanted, nullptr, 10) : 0;  // 0: no number
  return number > 0 && number < usable ? static_cast<int>(number) : usable;
}

int most_threads() {
  constexpr int always = 16;
  return std::max(always, processors_of_machine());
}

}  // namespace perfora::io
