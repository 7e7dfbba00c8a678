// What is here: the end of a study: the race of its best designs, their verification, the comparison with the start on
// fresh seeds. What is not: how the best designs were found (driver.cpp).
#include <algorithm>
#include <cmath>

#include "optimize/search/driver_view.h"
#include "optimize/search/study_model.h"
#include "optimize/search/study_plan.h"
#include "results/interval.h"
#include "results/statistic.h"

namespace perfora::optimize {
namespace {

void compare(Finals& finals) {
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
  finals.significant = finals.pairs == finals.start_replicates && finals.pairs >= results::fewest_replicates &&
                       finals.gain > finals.gain_interval && !finals.start_keeps_more();
}

/// Met before not shown before the rest.
int rank_of(results::Outcome outcome) {
  return outcome == results::Outcome::met ? 0 : outcome == results::Outcome::not_shown ? 1 : 2;
}

}  // namespace

/// The score over the seeds of the search and of the first `rounds` rounds of the race.
Score Driver::View::raced(const Candidate& candidate, int rounds, bool& complete) {
  auto runs = evaluations(candidate, 0, study.keys.replicates);
  const auto further = evaluations(candidate, first_race_replicate, rounds * study.keys.race.replicates);
  if (runs.empty() || (rounds > 0 && further.empty())) {
    complete = false;
    return {};
  }
  runs.insert(runs.end(), further.begin(), further.end());
  return score_of(study.target, runs);
}

/// The known designs, best first: by what the model expects of them where the search has one that is trusted (the best
/// that was seen is a fluke more often than not), else by their scores. What a model says is journalled, so that it is
/// worked out once and is the same on every machine.
void Driver::View::rank_pool() {
  std::stable_sort(pool.begin(), pool.end(),
                   [](const Known& a, const Known& b) { return a.score.value < b.score.value; });
  if (study.keys.algorithm == "model" && pool.size() > 1) {
    const int count = static_cast<int>(pool.size());
    std::vector<std::string> keys;
    for (const Batch& batch : driver.batches_)
      if (batch.stage == "rank" && batch.number == count) keys = batch.keys;
    if (keys.empty()) {
      keys = ranked_by_model();
      plan.new_batches.push_back({"rank", count, {}, 0, keys});
    }
    const auto place = [&](const Known& one) {
      return std::find(keys.begin(), keys.end(), book.key(*one.candidate, 0)) - keys.begin();
    };
    std::stable_sort(pool.begin(), pool.end(), [&](const Known& a, const Known& b) { return place(a) < place(b); });
  }
  if (pool.empty()) return;
  plan.best = pool.front().candidate;
  plan.best_score = pool.front().score;
}

std::vector<std::string> Driver::View::ranked_by_model() {
  std::vector<const Candidate*> visited;
  for (const Trace& trace : plan.traces)
    for (const Visit& visit : trace.visits) visited.push_back(visit.candidate);
  std::vector<std::string> keys;
  StudyModel model(store, visited, study.keys.replicates);
  if (model.made() && model.trusted())
    for (const StudyModel::Ranked& one : model.ranked())
      if (pooled.contains(one.candidate)) keys.push_back(book.key(*one.candidate, 0));
  for (const Known& one : pool)
    if (const std::string& key = book.key(*one.candidate, 0); std::find(keys.begin(), keys.end(), key) == keys.end())
      keys.push_back(key);
  return keys;
}

/// Halving with paired seeds: after each round the better half stays, until as many are left as are kept.
bool Driver::View::run_race() {
  rank_pool();
  if (study.keys.race.finalists == 0 || pool.size() < 2) return true;
  for (const Known& one : pool)
    if (static_cast<int>(plan.finalists.size()) < study.keys.race.finalists)
      plan.finalists.push_back({one.candidate, 0, true, one.score});
  RaceKeys keys = study.keys.race;
  keys.finalists = static_cast<int>(plan.finalists.size());
  const std::vector<int> rounds = race_rounds(keys);
  for (std::size_t round = 0; round < rounds.size(); ++round) {
    bool complete = true;
    std::vector<Score> scores;
    const auto runners = static_cast<std::size_t>(rounds[round]);
    for (std::size_t k = 0; k < runners; ++k)
      scores.push_back(raced(*plan.finalists[k].candidate, static_cast<int>(round) + 1, complete));
    if (!complete) return false;
    for (std::size_t k = 0; k < runners; ++k) {
      plan.finalists[k].rounds = static_cast<int>(round) + 1;
      plan.finalists[k].score = scores[k];
    }
    std::stable_sort(plan.finalists.begin(), plan.finalists.begin() + rounds[round],
                     [](const Finalist& a, const Finalist& b) { return a.score.value < b.score.value; });
    const std::size_t left = round + 1 < rounds.size() ? static_cast<std::size_t>(rounds[round + 1])
                                                       : static_cast<std::size_t>(std::min(keys.keep, rounds[round]));
    for (std::size_t k = left; k < plan.finalists.size(); ++k) plan.finalists[k].kept = false;
  }
  plan.best = plan.finalists.front().candidate;
  plan.best_score = store.visit(*plan.best).detail;
  return true;
}

/// The kept designs on fresh seeds. The first of the race is recommended, and these seeds have not chosen it. Where
/// another one keeps the wishes better on them, that is recommended, and judged on seeds of its own: the best of
/// several flatters itself.
bool Driver::View::run_verification() {
  const int count = study.keys.final_replicates;
  plan.finals.replicates = count;
  plan.finals.start_replicates = study.keys.start_final_replicates();
  plan.finals.fidelity = study.verify_fidelity;
  // Behind the seeds of the map as well: they have chosen what the search began with.
  const int chosen_by =
      plan.map.empty() ? study.keys.replicates : std::max(study.keys.replicates, study.keys.map.replicates);
  const int first = plan.finals.first = chosen_by;
  if (count == 0 || !plan.best) return true;
  std::vector<const Candidate*> designs;
  for (const Finalist& one : plan.finalists)
    if (one.kept) designs.push_back(one.candidate);
  if (designs.empty()) designs = {plan.best};
  const bool wishes = !results::wishes(study.target).empty();
  for (const Candidate* candidate : designs) {
    const auto runs = evaluations(*candidate, first, count, study.verify_fidelity);
    if (runs.empty()) continue;
    Verified one{candidate, score_of(study.target, runs), {}, first, count};
    if (wishes) one.outcome = results::verdict_on(study.target, runs).outcome;
    plan.verified.push_back(one);
  }
  if (plan.verified.size() < designs.size()) {
    if (plan.start.candidate->violation <= 0.0)
      evaluations(*plan.start.candidate, first, plan.finals.start_replicates, study.verify_fidelity);
    return false;
  }
  const auto better = [](const Verified& a, const Verified& b) {
    const int ra = rank_of(a.outcome), rb = rank_of(b.outcome);
    return ra != rb ? ra < rb : a.score.value < b.score.value;
  };
  const auto picked = std::min_element(plan.verified.begin(), plan.verified.end(), better);
  const bool another = picked != plan.verified.begin() && rank_of(plan.verified.front().outcome) > 0;
  if (!another) {
    if (!compare_with_start(first)) return false;
    // What a search finds may keep fewer wishes than what it began with.
    if (plan.start.candidate->arm < 0 || !plan.finals.start_keeps_more()) return true;
    plan.best = plan.start.candidate;
    plan.best_score = plan.start.detail;
    return compare_with_start(first_confirming_replicate);
  }
  plan.best = picked->candidate;
  plan.best_score = store.visit(*plan.best).detail;
  return compare_with_start(first_confirming_replicate);
}

bool Driver::View::compare_with_start(int first) {
  Finals& finals = plan.finals;
  finals.first = first;
  finals.best_scores.clear();
  finals.start_scores.clear();
  const Candidate& start = *plan.start.candidate;
  const auto best = evaluations(*plan.best, first, finals.replicates, finals.fidelity);
  const bool has_start = start.violation <= 0.0;
  const auto begin = has_start ? evaluations(start, first, finals.start_replicates, finals.fidelity)
                               : std::vector<const Evaluation*>{};
  if (best.empty() || (has_start && begin.empty())) return false;
  finals.best = score_of(study.target, best);
  finals.start = score_of(study.target, begin);
  // Of single simulations, without the steps of wishes: a block that just keeps one and a block that just does not are
  // much the same.
  const auto single = [&](const Evaluation* one) {
    const Score score = score_of(study.target, {&one, 1});
    return score.value - score.of_wishes;
  };
  for (std::size_t k = 0; k < begin.size(); ++k) {
    if (!usable(*best[k]) || !usable(*begin[k])) continue;
    finals.best_scores.push_back(single(best[k]));
    finals.start_scores.push_back(single(begin[k]));
  }
  compare(finals);
  return true;
}

}  // namespace perfora::optimize
