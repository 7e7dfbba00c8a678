// What is here: the search by replay. What is not: NLopt itself (nlopt_search.cpp), the journal.
#include "optimize/search/driver.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "optimize/search/nlopt_search.h"

namespace perfora::optimize {
namespace {

/// Gain is called real beyond this many standard errors.
constexpr double significance = 2.0;

SearchOptions options_of(const Study& study, const Arm& arm) {
  SearchOptions options;
  options.algorithm = study.keys.algorithm;
  options.dimension = static_cast<int>(study.variables.size());
  options.maxeval = arm.maxeval;
  options.seed = arm.seed;
  options.start = arm.start;
  options.initial_step = study.keys.initial_step;
  options.population = study.keys.population;
  options.xtol = study.keys.xtol;
  options.ftol = study.keys.ftol;
  if (study.keys.stop_score > 0.0) options.stop_score = study.keys.stop_score;
  return options;
}

}  // namespace

/// One call of plan(): the answers it may use and what it collects.
struct Driver::View {
  const Study& study;
  CandidateBook& book;
  const Answers& answers;
  Plan plan;
  std::set<std::string> asked;

  /// The evaluations of a candidate for replicates [first, first + count); empty, with the missing ones added to
  /// `wanted`, when some are unknown.
  std::vector<const Evaluation*> evaluations(const Candidate& candidate, int first, int count) {
    std::vector<const Evaluation*> known;
    for (int replicate = first; replicate < first + count; ++replicate) {
      const std::string& key = book.key(candidate, replicate);
      const Request request = candidate.request(replicate);
      if (const Evaluation* answer = answer_for(request, key, answers))
        known.push_back(answer);
      else if (asked.insert(key).second)
        plan.wanted.push_back({key, request, &candidate});
    }
    if (static_cast<int>(known.size()) < count) known.clear();
    return known;
  }

  Visit visit(const Candidate& candidate) {
    Visit visit{&candidate, false, 0.0, {}};
    if (candidate.violation > 0.0) {
      visit.answered = true;
      visit.score = violation_score(candidate.violation);
      return visit;
    }
    const auto known = evaluations(candidate, 0, study.keys.replicates);
    if (known.empty()) return visit;
    visit.answered = true;
    visit.detail = score_of(study.target, known);
    visit.score = visit.detail.value;
    consider(visit);
    return visit;
  }

  /// Own incumbent: NLopt's is not always the best it saw. The first of equals stays; a start outside the search space
  /// is no candidate.
  void consider(const Visit& visit) {
    if (!visit.detail.valid || visit.candidate->arm < 0 || (plan.best && visit.score >= plan.best_score.value)) return;
    plan.best = visit.candidate;
    plan.best_score = visit.detail;
  }

  /// What an algorithm that is given the constraints hears at a point that breaks one: nothing new, the best score so
  /// far.
  static double neutral(const Trace& trace) {
    double best = largest_score;
    for (const Visit& visit : trace.visits)
      if (visit.candidate->violation <= 0.0) best = std::min(best, visit.score);
    return best;
  }

  Trace run(int arm, const SearchOptions& asked_options, bool refine) {
    Trace trace{arm, refine, {}, false, {}};
    SearchOptions options = asked_options;
    const bool constrained = takes_constraints(options.algorithm);
    if (constrained) options.constraints = static_cast<int>(constraint_names(study.constraints).size());
    const Objective objective = [&](std::span<const double> x) -> std::optional<double> {
      const Candidate& candidate = book.at(arm, study.values_at(x));
      Visit point = visit(candidate);
      const double told = constrained && candidate.violation > 0.0 ? neutral(trace) : point.score;
      trace.visits.push_back(point);
      if (!point.answered) return std::nullopt;
      return told;
    };
    const Constraints constraints = [&](std::span<const double> x) { return book.at(arm, study.values_at(x)).limits; };
    const SearchEnd end = run_search(options, objective, constraints);
    trace.finished = end.finished;
    trace.reason = end.reason;
    return trace;
  }

  bool run_arms() {
    bool finished = true;
    for (std::size_t k = 0; k < study.arms.size(); ++k) {
      plan.traces.push_back(run(static_cast<int>(k), options_of(study, study.arms[k]), false));
      finished = finished && plan.traces.back().finished;
    }
    return finished;
  }

  /// The second stage begins where the first has ended, so its arms must all be done.
  bool run_refine() {
    if (study.keys.refine.empty() || !plan.best || plan.best->arm < 0) return true;
    const Candidate from = *plan.best;
    SearchOptions options = options_of(study, study.arms[static_cast<std::size_t>(from.arm)]);
    options.algorithm = study.keys.refine;
    options.maxeval = study.keys.refine_maxeval;
    options.start = study.point_of(from.values);
    options.initial_step = study.keys.refine_step;
    options.population = 0;
    plan.traces.push_back(run(from.arm, options, true));
    return plan.traces.back().finished;
  }

  /// Scores of single simulations: the spread term needs more than one.
  double single(const Evaluation& evaluation) const {
    const Evaluation* one = &evaluation;
    return score_of(study.target, {&one, 1}).value;
  }

  bool run_finals() {
    Finals& finals = plan.finals;
    finals.replicates = study.keys.final_replicates;
    if (finals.replicates == 0 || !plan.best) return true;
    const int first = study.keys.replicates;
    const Candidate& start = *plan.start.candidate;
    const auto best = evaluations(*plan.best, first, finals.replicates);
    const bool has_start = start.violation <= 0.0;
    const auto begin = has_start ? evaluations(start, first, finals.replicates) : std::vector<const Evaluation*>{};
    if (best.empty() || (has_start && begin.empty())) return false;
    finals.best = score_of(study.target, best);
    finals.start = score_of(study.target, begin);
    for (std::size_t k = 0; k < begin.size(); ++k) {
      if (!usable(*best[k]) || !usable(*begin[k])) continue;
      finals.best_scores.push_back(single(*best[k]));
      finals.start_scores.push_back(single(*begin[k]));
    }
    compare(finals);
    return true;
  }

  static void compare(Finals& finals) {
    finals.pairs = static_cast<int>(finals.best_scores.size());
    if (finals.pairs == 0) return;
    const double n = finals.pairs;
    std::vector<double> gains;
    for (std::size_t k = 0; k < finals.best_scores.size(); ++k)
      gains.push_back(finals.start_scores[k] - finals.best_scores[k]);
    for (const double gain : gains) finals.gain += gain / n;
    if (finals.pairs < 2) return;
    double squares = 0.0;
    for (const double gain : gains) squares += (gain - finals.gain) * (gain - finals.gain);
    finals.gain_error = std::sqrt(squares / (n - 1.0) / n);
    finals.significant = finals.pairs == finals.replicates && finals.gain > significance * finals.gain_error;
  }

  std::string end_reason() const {
    std::set<std::string> reasons;
    for (const Trace& trace : plan.traces)
      if (!trace.refine) reasons.insert(trace.reason);
    std::string text = fmt::format("{}", fmt::join(reasons, "; "));
    if (!plan.best) text += "; no candidate gave a plateau and kept the constraints";
    return text;
  }
};

Plan Driver::plan(const Answers& answers) {
  View view{study_, book_, answers, {}, {}};
  view.plan.start = view.visit(book_.start());
  const bool arms_done = view.run_arms();
  if (arms_done && view.plan.start.answered && view.run_refine() && view.run_finals()) {
    view.plan.finished = true;
    view.plan.reason = view.end_reason();
  }
  return std::move(view.plan);
}

}  // namespace perfora::optimize
