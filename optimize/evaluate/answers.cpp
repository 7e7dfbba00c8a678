// What is here: which evaluation answers which request. What is not: the key of a request (request.cpp).
#include "optimize/evaluate/answers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "results/grade.h"
#include "results/history.h"
#include "results/measured_anew.h"

namespace perfora::optimize {
namespace {

double grade_of(const Request& request) {
  return request.design->solver.material.grade;
}

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
  if (evaluation.status == results::RunStatus::failed)
    return !(summary.final_strain > request.strain() + results::strain_rounding);
  return std::abs(summary.final_strain - request.strain()) < results::strain_rounding &&
         summary.measured == request.design->measuring_frame().text();
}

std::optional<Evaluation> Answers::at_grade_of(const Request& request, const std::string& key) const {
  const auto [first, last] = of(key);
  const results::MeasuringFrame frame = request.design->measuring_frame();
  // A distance to a stress, or a strain at one, is not that of a curve times a factor: it is measured anew.
  if (frame.target_stress > 0.0 || !frame.target_curve.empty() || frame.cap > 0.0) return std::nullopt;
  for (auto it = first; it != last; ++it)
    if (is_answer(it->second, request)) return results::at_grade(it->second, grade_of(request));
  return std::nullopt;
}

std::optional<Evaluation> Answers::measured_anew(const Request& request, const std::string& key) const {
  if (!histories_) return std::nullopt;
  const auto [first, last] = of(key);
  const double least = request.strain() - results::strain_rounding;
  const bool far_enough =
      std::any_of(first, last, [&](const auto& one) { return one.second.summary.final_strain >= least; });
  if (!far_enough) return std::nullopt;  // a file less to read, for each request that is open
  std::optional<results::StoredHistory> kept = histories_(key);
  if (!kept || kept->history.rows() == 0) return std::nullopt;
  results::GradeChange(grade_of(request) / kept->grade).apply(kept->history);
  const results::History& history = kept->history;
  const results::MeasuringFrame frame = request.design->measuring_frame();
  for (auto it = first; it != last; ++it) {
    if (it->second.summary.final_strain != history.strain_yy.back()) continue;
    Evaluation stored = results::at_grade(it->second, grade_of(request));
    stored.curve = history;
    std::optional<Evaluation> anew = results::measured_anew(stored, frame, request.strain());
    if (!anew || !is_answer(*anew, request)) continue;
    anew->curve = results::coarse_curve(anew->curve);
    return anew;
  }
  return std::nullopt;
}

const Evaluation* Answers::derived(const Request& request, const std::string& key) const {
  const auto [known, known_end] = derived_.equal_range(key);
  for (auto it = known; it != known_end; ++it)
    if (is_answer(it->second, request) && it->second.grade == grade_of(request)) return &it->second;
  std::optional<Evaluation> found = at_grade_of(request, key);
  if (!found) found = measured_anew(request, key);
  return found ? &derived_.emplace(key, std::move(*found))->second : nullptr;
}

const Evaluation* answer_for(const Request& request, const std::string& key, const Answers& known) {
  const auto [first, last] = known.of(key);
  for (auto it = first; it != last; ++it)
    if (is_answer(it->second, request) && it->second.grade == grade_of(request)) return &it->second;
  return known.derived(request, key);
}

}  // namespace perfora::optimize
