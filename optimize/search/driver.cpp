// What is here: the stages of a study, its incumbent, the comparison on fresh seeds. What is not: the algorithms
// (searcher.h), the journal.
#include "optimize/search/driver.h"

#include <fmt/format.h>
#include <cmath>
#include <set>

#include "results/interval.h"
#include "results/statistic.h"

namespace perfora::optimize {
namespace {

SearchStage stage_of(const Study& study) {
  SearchStage stage;
  stage.algorithm = study.keys.algorithm;
  stage.initial_step = study.keys.initial_step;
  stage.population = study.keys.population;
  stage.xtol = study.keys.xtol;
  stage.ftol = study.keys.ftol;
  if (study.keys.stop_score > 0.0) stage.stop_score = study.keys.stop_score;
  for (std::size_t k = 0; k < study.arms.size(); ++k) {
    const Arm& arm = study.arms[k];
    stage.tasks.push_back({static_cast<int>(k), arm.maxeval, arm.seed, arm.start});
  }
  return stage;
}

/// One search of the arm of `from`, which begins there.
SearchStage second_stage_of(const Study& study, const Candidate& from) {
  SearchStage stage = stage_of(study);
  SearchTask task = stage.tasks[static_cast<std::size_t>(from.arm)];
  task.maxeval = study.keys.refine_maxeval;
  task.start = study.point_of(from.values);
  stage.tasks = {task};
  stage.algorithm = study.keys.refine;
  stage.initial_step = study.keys.refine_step;
  stage.population = 0;
  return stage;
}

}  // namespace

/// One call of plan(): what is known and what it collects.
struct Driver::View {
  const Study& study;
  CandidateBook& book;
  const CandidateStore store;
  Plan plan = {};
  std::set<std::string> asked = {};

  /// The evaluations of a candidate for replicates [first, first + count); empty, with the missing ones added to
  /// `wanted`, when some are unknown.
  std::vector<const Evaluation*> evaluations(const Candidate& candidate, int first, int count) {
    auto known = store.evaluations(candidate, first, count);
    bool complete = true;
    for (std::size_t k = 0; k < known.size(); ++k) {
      if (known[k]) continue;
      complete = false;
      const int replicate = first + static_cast<int>(k);
      const std::string& key = book.key(candidate, replicate);
      if (asked.insert(key).second) plan.wanted.push_back({key, candidate.request(replicate), &candidate});
    }
    if (!complete) known.clear();
    return known;
  }

  void take(const Visit& visit) {
    if (visit.answered)
      consider(visit);
    else
      evaluations(*visit.candidate, 0, study.keys.replicates);
  }

  /// Own incumbent: NLopt's is not always the best it saw. The first of equals stays; a start outside the search space
  /// is no candidate.
  void consider(const Visit& visit) {
    if (!visit.detail.valid || visit.candidate->arm < 0 || (plan.best && visit.score >= plan.best_score.value)) return;
    plan.best = visit.candidate;
    plan.best_score = visit.detail;
  }

  /// True: every search of the stage has ended.
  bool run(const Searcher& searcher, const SearchStage& stage, bool refine) {
    bool finished = true;
    for (Trace& trace : searcher.ask(stage, store)) {
      trace.refine = refine;
      for (const Visit& visit : trace.visits) take(visit);
      finished = finished && trace.finished;
      plan.traces.push_back(std::move(trace));
    }
    return finished;
  }

  /// The second stage begins where the first has ended, so its arms must all be done.
  bool run_refine() {
    if (study.keys.refine.empty() || !plan.best || plan.best->arm < 0) return true;
    return run(*study.refiner, second_stage_of(study, *plan.best), true);
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
    std::vector<double> gains;
    for (std::size_t k = 0; k < finals.best_scores.size(); ++k)
      gains.push_back(finals.start_scores[k] - finals.best_scores[k]);
    const results::Statistic gain = results::statistic_of({}, gains);
    finals.gain = gain.mean;
    if (finals.pairs < 2) return;
    finals.gain_error = gain.standard_deviation / std::sqrt(static_cast<double>(finals.pairs));
    finals.gain_interval = gain.confidence_95;
    finals.significant = finals.pairs == finals.replicates && finals.pairs >= results::fewest_replicates &&
                         finals.gain > finals.gain_interval;
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
  View view{study_, book_, CandidateStore(study_, book_, answers)};
  view.plan.start = view.store.visit(book_.start());
  view.take(view.plan.start);
  const bool arms_done = view.run(*study_.searcher, stage_of(study_), false);
  if (arms_done && view.plan.start.answered && view.run_refine() && view.run_finals()) {
    view.plan.finished = true;
    view.plan.reason = view.end_reason();
  }
  return std::move(view.plan);
}

}  // namespace perfora::optimize
