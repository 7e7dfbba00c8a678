// What is here: how much memory this process has taken, and may take. What is not: estimates
// (optimize/evaluate/estimate.h).
#pragma once

namespace perfora::io {

/// Largest resident memory of this process so far, bytes.
double peak_memory_bytes();

/// What this process may take at most, bytes: the machine's memory, or less where its control groups or its limit of
/// address space (ulimit -v) allow less.
double usable_memory_bytes();

}  // namespace perfora::io
