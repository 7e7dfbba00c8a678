// What is here: which evaluation answers which request. What is not: the key of a request (request.cpp).
#include "optimize/evaluate/answers.h"

#include <cmath>
#include <utility>

#include "solver/run_setup.h"

namespace perfora::optimize {
namespace {

/// Both answer the same requests.
bool alike(const Evaluation& a, const Evaluation& b) {
  const results::Summary &first = a.summary, &second = b.summary;
  return a.status == b.status && first.final_strain == second.final_strain &&
         first.plateau_start == second.plateau_start && first.plateau_end == second.plateau_end;
}

}  // namespace

void Answers::add(const std::string& key, Evaluation evaluation) {
  const auto [first, last] = stored_.equal_range(key);
  for (auto it = first; it != last; ++it)
    if (alike(it->second, evaluation)) {
      stored_.erase(it);
      break;
    }
  stored_.emplace(key, std::move(evaluation));
}

bool is_answer(const Evaluation& evaluation, const Request& request) {
  const results::Summary& summary = evaluation.summary;
  const solver::SolverOptions& options = request.design->solver;
  const double row = options.output.history_interval;
  const double end = row * static_cast<double>(solver::rows_until(request.strain(), row));
  // Rows stand at multiples of the interval up to rounding.
  if (evaluation.status == results::RunStatus::failed) return !(summary.final_strain > end + 0.5 * row);
  return std::abs(summary.final_strain - end) < 0.5 * row && summary.plateau_start == options.measures.plateau_start &&
         summary.plateau_end == options.measures.plateau_end;
}

const Evaluation* answer_for(const Request& request, const std::string& key, const Answers& known) {
  const auto [first, last] = known.of(key);
  for (auto it = first; it != last; ++it)
    if (is_answer(it->second, request)) return &it->second;
  return nullptr;
}

}  // namespace perfora::optimize
