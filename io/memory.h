// What is here: how much memory this process has taken. What is not: estimates (optimize/evaluate/estimate.h).
#pragma once

namespace perfora::io {

/// Largest resident memory of this process so far, bytes.
double peak_memory_bytes();

}  // namespace perfora::io
