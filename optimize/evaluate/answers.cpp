// What is here: which evaluation answers which request. What is not: the key of a request (request.cpp).
#include "optimize/evaluate/answers.h"

#include <cmath>
#include <utility>

#include "results/measured_anew.h"

namespace perfora::optimize {
namespace {

/// Both answer the same requests.
bool alike(const Evaluation& a, const Evaluation& b) {
  const results::Summary &first = a.summary, &second = b.summary;
  return a.status == b.status && first.final_strain == second.final_strain && first.measured == second.measured;
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
  if (!request.material_test.empty()) return true;  // Its key says all of it.
  const results::Summary& summary = evaluation.summary;
  constexpr double rounding = 1e-9;  // strains of a path are good to rounding
  if (evaluation.status == results::RunStatus::failed) return !(summary.final_strain > request.strain() + rounding);
  return std::abs(summary.final_strain - request.strain()) < rounding &&
         summary.measured == request.design->measuring_frame().text();
}

const Evaluation* Answers::measured_anew(const Request& request, const std::string& key) const {
  const auto [known, known_end] = derived_.equal_range(key);
  for (auto it = known; it != known_end; ++it)
    if (is_answer(it->second, request)) return &it->second;
  if (!histories_) return nullptr;
  const auto [first, last] = of(key);
  if (first == last) return nullptr;
  const std::optional<results::History> history = histories_(key);
  if (!history || history->rows() == 0) return nullptr;
  const results::MeasuringFrame frame = request.design->measuring_frame();
  for (auto it = first; it != last; ++it) {
    Evaluation stored = it->second;
    if (stored.summary.final_strain != history->strain_yy.back()) continue;
    stored.curve = *history;
    std::optional<Evaluation> anew = results::measured_anew(stored, frame, request.strain());
    if (!anew || !is_answer(*anew, request)) continue;
    anew->curve = results::coarse_curve(anew->curve);
    return &derived_.emplace(key, std::move(*anew))->second;
  }
  return nullptr;
}

const Evaluation* answer_for(const Request& request, const std::string& key, const Answers& known) {
  const auto [first, last] = known.of(key);
  for (auto it = first; it != last; ++it)
    if (is_answer(it->second, request)) return &it->second;
  return known.measured_anew(request, key);
}

}  // namespace perfora::optimize
