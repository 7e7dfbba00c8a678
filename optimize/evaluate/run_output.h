// What is here: what is checked before a design is evaluated into a run file: the design, what it is given, an output
// that exists. What is not: the evaluation (evaluation.h), the run file itself (results/run_file.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/lock.h"
#include "optimize/evaluate/evaluation.h"

namespace perfora::optimize {

/// Takes the output of a run: its lock first, then refuses to start over something that exists: R.h5, the files beside
/// it or R.part, where a run keeps what must survive a kill. With `force` all of them are removed, with `resume` all
/// are left. Throws io::InputError, also where another process uses the output.
[[nodiscard]] io::OutputLock claim_run_output(const std::filesystem::path& run_file, bool force, bool resume);

/// Takes the output of a packing: its lock first, then refuses a name that does not end in .h5 and, without `force`, a
/// file that exists. Throws io::InputError, also where another process uses the output.
[[nodiscard]] io::OutputLock claim_pack_output(const std::filesystem::path& file, bool force);

/// What stands before an evaluation.
struct PreparedEvaluation {
  std::vector<std::string> warnings;  ///< of the design and of what it costs
  io::OutputLock lock;                ///< to be held until all files of the run are written
};

/// Checks the design, that it takes no more than `memory` bytes, and options.packing_file; takes options.run_file as
/// claim_run_output() does; with options.resume refuses a finished run of another design. Throws io::InputError.
PreparedEvaluation prepare_evaluation(const DesignFile& design, const EvaluateOptions& options, int replicate,
                                      bool force, double memory);

}  // namespace perfora::optimize
