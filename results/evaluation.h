// What is here: the record of one evaluation of a design: how it ended, its seeds, summaries and history. What is not:
// the request it answers (optimize/evaluate/), its JSON form (json.h).
#pragma once

#include <cstdint>
#include <string>

#include "results/history.h"
#include "results/summary.h"

namespace perfora::results {

/// The seeds that one replicate ran with.
struct EffectiveSeeds {
  std::uint64_t packing = 0, noise = 0, layout = 0, search = 0;
  bool operator==(const EffectiveSeeds&) const = default;
};

/// status, summary, curve of one design and replicate.
struct Evaluation {
  RunStatus status = RunStatus::completed;
  std::string reason;
  EffectiveSeeds seeds;
  int replicate = 0;
  double grade = 1.0;  ///< of the material (material.grade): stresses, energies, times and rates are of this grade
  PackSummary pack;
  Summary summary;
  Performance performance;
  History curve;
};

}  // namespace perfora::results
