// What is here: how many processors this process may use. What is not: how many threads a command takes
// (app/common.h).
#pragma once

#include "io/control_group.h"

namespace perfora::io {

/// Processors this process may use, at least 1: those of its affinity mask (taskset, batch systems), cut to the time
/// that its control groups allow, rounded up.
int usable_processors(const ControlGroupFiles& files = {});

/// Threads or workers where the user names none: usable_processors(), or OMP_NUM_THREADS (its first number) where that
/// is set to fewer.
int default_threads();

/// The most threads or workers a user may ask for: more than processors only wait for one another. At least 16, so that
/// answers can be compared between machines.
int most_threads();

}  // namespace perfora::io
