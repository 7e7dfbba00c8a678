// What is here: how evaluations are carried out, as keys of study, sweep and calibration files: how many at once, what
// a failure of the surroundings leads to, when a worker has taken too long. What is not: who carries them (executor.h).
#pragma once

#include <string>

#include "io/schema.h"

namespace perfora::optimize {

/// What happens when the surroundings failed (a worker was killed, the disk is full, ...) in place of an evaluation.
enum class OnTrouble {
  retry,  ///< it is tried again, `attempts` times in all; then the work stops
  stop,   ///< the work stops at once
  skip,   ///< it is tried again, `attempts` times in all; then the work goes on without it
};

/// Nothing here changes a result, so all of it may change when work goes on.
struct ExecutionKeys {
  int workers = 0;  ///< evaluations at once; 0: one a processor
  OnTrouble on_trouble = OnTrouble::retry;
  int attempts = 3;
  double time_limit = 0.0;  ///< s of wall time an evaluation may take; 0: from its estimate (time_limit.h)
};

void describe(io::Section section, ExecutionKeys& keys);

/// Whether a key, without its section, is one of ExecutionKeys.
bool is_execution_key(const std::string& name);

/// For work that needs a number at each point. Throws io::InputError for OnTrouble::skip.
void refuse_skip(const ExecutionKeys& keys, const io::Origin& origin);

}  // namespace perfora::optimize
