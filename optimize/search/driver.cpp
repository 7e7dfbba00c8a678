// What is here: the stages of a study up to its best designs. What is not: race, verification and the comparison with
// the start (driver_end.cpp), the algorithms (searcher.h), the journal.
#include "optimize/search/driver.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "optimize/search/driver_view.h"
#include "optimize/search/map_plan.h"

namespace perfora::optimize {
namespace {

SearchStage stage_of(const Study& study) {
  SearchStage stage;
  stage.algorithm = study.keys.algorithm;
  stage.initial_step = study.keys.initial_step;
  stage.population = study.keys.population;
  stage.xtol = study.keys.xtol;
  stage.ftol = study.keys.ftol;
  stage.batch = study.keys.batch;
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

/// What the journal holds of a stage, task by task.
void give_batches(SearchStage& stage, const std::vector<Batch>& batches, const std::string& name) {
  for (SearchTask& task : stage.tasks)
    for (const Batch& batch : batches) {
      if (batch.stage != name) continue;
      Points& points = task.batches.emplace_back();
      for (const BatchPoint& one : batch.points)
        if (one.arm == task.arm) points.push_back(one.point);
    }
}

int highest_number(const std::vector<Batch>& batches, const std::string& stage) {
  int number = 0;
  for (const Batch& batch : batches)
    if (batch.stage == stage) number = std::max(number, batch.number);
  return number;
}

}  // namespace

std::vector<const Evaluation*> Driver::View::evaluations(const Candidate& candidate, int first, int count,
                                                         std::size_t fidelity) {
  auto known = store.evaluations(candidate, first, count, fidelity);
  bool complete = true;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (known[k]) continue;
    complete = false;
    const int replicate = first + static_cast<int>(k);
    const std::string& key = book.key(candidate, replicate, fidelity);
    if (asked.insert(key).second) plan.wanted.push_back({key, candidate.request(replicate, fidelity), &candidate});
  }
  if (!complete) known.clear();
  return known;
}

void Driver::View::tell(const Candidate& candidate) {
  store.observe(candidate);
  plan.told.push_back(&candidate);
}

void Driver::View::take(const Visit& visit) {
  if (visit.answered)
    consider(visit);
  else
    evaluations(*visit.candidate, 0, study.keys.replicates);
}

/// Own incumbent: NLopt's is not always the best it saw. The first of equals stays; a start outside the search space is
/// no candidate.
void Driver::View::consider(const Visit& visit) {
  if (!visit.detail.valid || visit.candidate->arm < 0) return;
  if (pooled.insert(visit.candidate).second) pool.push_back({visit.candidate, visit.detail});
  if (plan.best && visit.score >= plan.best_score.value) return;
  plan.best = visit.candidate;
  plan.best_score = visit.detail;
}

/// True: every design of the map is answered.
bool Driver::View::run_map() {
  const int replicates = study.keys.map.replicates, designs = study.keys.map.designs;
  std::vector<BatchPoint> points;
  for (const Batch& batch : driver.batches_)
    if (batch.stage == "map") {
      points.insert(points.end(), batch.points.begin(), batch.points.end());
      plan.map_tried = std::max(plan.map_tried, batch.tried);
    }
  if (static_cast<int>(points.size()) < designs && !driver.search_ended()) {
    const MapChoice choice = choose_map(study, book, designs);
    plan.map_tried = choice.tried;
    Batch further{"map", highest_number(driver.batches_, "map") + 1, {}, choice.tried};
    for (const BatchPoint& one : choice.points)
      if (static_cast<int>(points.size() + further.points.size()) < designs &&
          std::find(points.begin(), points.end(), one) == points.end())
        further.points.push_back(one);
    points.insert(points.end(), further.points.begin(), further.points.end());
    if (!further.points.empty()) plan.new_batches.push_back(std::move(further));
  }
  bool finished = true;
  std::set<const Candidate*> mapped;
  const auto add = [&](const Candidate& candidate, bool own) {
    if (candidate.violation > 0.0 || !mapped.insert(&candidate).second) return;
    Visit visit = store.visit(candidate, replicates, study.map_fidelity);
    if (driver.dropped_.contains(&candidate)) return;
    if (!own && !visit.answered && study.map_fidelity == 0) visit = store.visit(candidate);  // with fewer replicates
    const bool open = own && !visit.answered && !driver.search_ended();
    if (open) evaluations(candidate, 0, replicates, study.map_fidelity);
    finished = finished && !open;
    if (visit.answered || open) plan.map.push_back(std::move(visit));
    tell(candidate);
  };
  for (const BatchPoint& one : points) add(book.at(one.arm, study.values_at(one.point)), true);
  for (const Candidate* candidate : driver.told_) add(*candidate, false);
  plan.map_finished = finished;
  // Designs that were evaluated as candidates are: known ones of the search.
  if (plan.map_finished)
    for (const Visit& visit : plan.map)
      if (const Visit scored = store.visit(*visit.candidate); scored.answered) consider(scored);
  return plan.map_finished;
}

std::vector<Visit> Driver::View::best_of_map() const {
  std::vector<Visit> best;
  for (const Visit& visit : plan.map)
    if (visit.answered && visit.detail.valid && visit.candidate->arm >= 0) best.push_back(visit);
  std::stable_sort(best.begin(), best.end(), [](const Visit& a, const Visit& b) { return a.score < b.score; });
  return best;
}

void Driver::View::start_from_map(SearchStage& stage) const {
  const std::vector<Visit> best = best_of_map();
  for (SearchTask& task : stage.tasks)
    for (const Visit& visit : best)
      if (visit.candidate->arm == task.arm) {
        task.start = study.point_of(visit.candidate->values);
        break;
      }
}

void Driver::View::note_batch(const std::vector<Trace>& traces, const SearchStage& stage, const char* name) {
  const std::size_t known = stage.tasks.front().batches.size();
  if (traces.empty() || traces.front().batches.size() <= known) return;
  Batch batch{name, static_cast<int>(known) + 1, {}};
  for (const Trace& trace : traces) {
    const auto begin =
        std::accumulate(trace.batches.begin(), trace.batches.begin() + static_cast<std::ptrdiff_t>(known), 0);
    for (int k = begin; k < begin + trace.batches[known]; ++k)
      batch.points.push_back(
          {trace.arm, on_grid(study.point_of(trace.visits[static_cast<std::size_t>(k)].candidate->values))});
  }
  plan.new_batches.push_back(std::move(batch));
}

/// Leaves of a trace what was answered when the search was ended; answers that came later change nothing.
void Driver::View::cut(Trace& trace, bool in_batches, std::size_t known_batches) const {
  const auto open = [&](const Visit& visit) { return !visit.answered || driver.dropped_.contains(visit.candidate); };
  auto end = std::find_if(trace.visits.begin(), trace.visits.end(), open);
  if (in_batches) {
    known_batches = std::min(known_batches, trace.batches.size());
    end = trace.visits.begin() +
          std::accumulate(trace.batches.begin(), trace.batches.begin() + static_cast<std::ptrdiff_t>(known_batches), 0);
  }
  if (end != trace.visits.end() || !trace.finished) trace.reason = driver.ended_;
  trace.visits.erase(end, trace.visits.end());
  std::erase_if(trace.visits, open);
  trace.batches.clear();
  trace.finished = true;
}

/// True: every search of the stage has ended.
bool Driver::View::run(const Searcher& searcher, SearchStage stage, const char* name) {
  give_batches(stage, driver.batches_, name);
  std::vector<Trace> traces = searcher.ask(stage, store);
  if (searcher.asks_in_batches() && !driver.search_ended()) note_batch(traces, stage, name);
  bool finished = true;
  for (Trace& trace : traces) {
    trace.refine = std::string_view(name) == "refine";
    if (driver.search_ended()) cut(trace, searcher.asks_in_batches(), stage.tasks.front().batches.size());
    for (const Visit& visit : trace.visits) take(visit);
    finished = finished && trace.finished;
    plan.traces.push_back(std::move(trace));
  }
  return finished;
}

/// The best designs of the map get the replicates of the search: only then can they be compared with its candidates.
bool Driver::View::run_best_of_map() {
  const std::vector<Visit> best = best_of_map();
  const auto count = std::min(best.size(), static_cast<std::size_t>(std::max(1, study.keys.race.finalists)));
  bool complete = true;
  for (std::size_t k = 0; k < count; ++k) {
    const Visit visit = store.visit(*best[k].candidate);
    complete = complete && visit.answered;
    take(visit);
  }
  return complete;
}

/// The second stage begins where the first has ended, so its arms must all be done.
bool Driver::View::run_refine() {
  if (study.keys.refine.empty() || !plan.best || plan.best->arm < 0) return true;
  return run(*study.refiner, second_stage_of(study, *plan.best), "refine");
}

std::string Driver::View::end_reason() const {
  std::set<std::string> reasons;
  for (const Trace& trace : plan.traces)
    if (!trace.refine) reasons.insert(trace.reason);
  std::string text = fmt::format("{}", fmt::join(reasons, "; "));
  if (!plan.best) text += "; no candidate gave a plateau and kept the constraints";
  return text;
}

Plan Driver::plan_map(const Answers& answers) {
  View view{study_, book_, *this, CandidateStore(study_, book_, answers)};
  view.plan.finished = view.run_map();
  int failed = 0;
  for (const Visit& visit : view.plan.map) failed += visit.answered && !visit.detail.valid;
  view.plan.reason =
      fmt::format("{} designs mapped, {} of them without a plateau or failed", view.plan.map.size(), failed);
  return std::move(view.plan);
}

Plan Driver::plan(const Answers& answers) {
  View view{study_, book_, *this, CandidateStore(study_, book_, answers)};
  view.plan.start = view.store.visit(book_.start());
  view.tell(*view.plan.start.candidate);
  if (!search_ended() || view.plan.start.answered) view.take(view.plan.start);
  if (!view.run_map()) return std::move(view.plan);
  SearchStage first = stage_of(study_);
  view.start_from_map(first);
  const bool arms_done = view.run(*study_.searcher, std::move(first), "search");
  const bool start_done = view.plan.start.answered || search_ended();
  if (arms_done && start_done && view.run_best_of_map() && view.run_refine() && view.run_race() &&
      view.run_verification()) {
    view.plan.finished = true;
    view.plan.reason = view.end_reason();
  }
  return std::move(view.plan);
}

}  // namespace perfora::optimize
