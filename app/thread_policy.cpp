// What is here: the program started again with GOMP_SPINCOUNT set, which libgomp reads only once, at the start.
#include "app/thread_policy.h"

#include <stdlib.h>
#include <unistd.h>

namespace perfora::app {

void let_waiting_threads_sleep(char** argv) {
  constexpr const char* spins = "2000";  // some ten microseconds, the usual wait at the end of a step
  if (getenv("OMP_WAIT_POLICY") != nullptr || getenv("GOMP_SPINCOUNT") != nullptr) return;
  if (setenv("GOMP_SPINCOUNT", spins, 0) == 0) execv("/proc/self/exe", argv);
}

}  // namespace perfora::app
