// What is here: which evaluation answers which request. What is not: the key of a request (request.cpp).
#include "optimize/evaluate/answers.h"

#include <utility>

namespace perfora::optimize {
namespace {

constexpr double rounding = 1e-9;  // of the strain of a row

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
  const double wanted = request.strain();
  if (evaluation.status == results::RunStatus::failed) return !(summary.final_strain > wanted + rounding);
  const solver::MeasureOptions& measures = request.design->solver.measures;
  return summary.final_strain >= wanted - rounding &&
         summary.final_strain < wanted + request.design->solver.output.history_interval - rounding &&
         summary.plateau_start == measures.plateau_start && summary.plateau_end == measures.plateau_end;
}

const Evaluation* answer_for(const Request& request, const std::string& key, const Answers& known) {
  const auto [first, last] = known.of(key);
  for (auto it = first; it != last; ++it)
    if (is_answer(it->second, request)) return &it->second;
  return nullptr;
}

}  // namespace perfora::optimize
