// What is here: the peak memory of this process as the operating system reports it.
#include "io/memory.h"

#include <sys/resource.h>

namespace perfora::io {

double peak_memory_bytes() {
  constexpr double kilobyte = 1024.0;  // ru_maxrss counts these
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return kilobyte * static_cast<double>(usage.ru_maxrss);
}

}  // namespace perfora::io
