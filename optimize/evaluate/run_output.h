// What is here: what is checked before a design is evaluated into a run file: the design, what it is given, an output
// that exists. What is not: the evaluation (evaluation.h), the run file itself (results/run_file.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "optimize/evaluate/evaluation.h"

namespace perfora::optimize {

/// Refuses to start over something that exists: R.h5, the files beside it or R.part, where a run keeps what must
/// survive a kill. With `force` all of them are removed, with `resume` all are left. Throws io::InputError.
void check_run_output(const std::filesystem::path& run_file, bool force, bool resume);

/// Checks the design, options.packing_file, and options.run_file as check_run_output() does; with options.resume
/// refuses a finished run of another design. Returns the warnings of the design. Throws io::InputError.
std::vector<std::string> prepare_evaluation(const DesignFile& design, const EvaluateOptions& options, int replicate,
                                            bool force);

}  // namespace perfora::optimize
