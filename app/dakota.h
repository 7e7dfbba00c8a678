// What is here: `perfora evaluate DESIGN --dakota params.in results.out`: one evaluation for Dakota, whose parameters
// are keys of the design and whose responses are measures. What is not: the evaluation
// (optimize/evaluate/evaluation.h).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/common.h"

namespace perfora::app {

/// What a parameters file of Dakota asks.
struct DakotaRequest {
  std::vector<std::pair<std::string, std::string>> variables;  ///< descriptor, value as written
  /// Descriptor and active set: bit 1 asks the value, 2 the gradient, 4 the Hessian.
  std::vector<std::pair<std::string, int>> responses;
};

/// Reads a parameters file, in Dakota's standard or its APREPRO form (Dakota Reference Manual, "parameters file
/// format"). Throws io::InputError for anything else.
DakotaRequest read_dakota_parameters(const std::filesystem::path& file);

/// Files of one evaluation for Dakota.
struct DakotaFiles {
  std::filesystem::path design, parameters, results;
};
/// Evaluates the design with the variables set and writes a line for each response whose value is asked: the number and
/// its descriptor. A design that the variables make impossible, a run that fails and a measure that is not reached give
/// "FAIL", which Dakota takes for a failed evaluation, and exit code 0. Throws io::InputError for what no choice of
/// variables mends: an unknown key or measure, a gradient that is asked.
int evaluate_for_dakota(const DakotaFiles& files, const CommonFlags& flags, const std::vector<std::string>& overrides);

}  // namespace perfora::app
