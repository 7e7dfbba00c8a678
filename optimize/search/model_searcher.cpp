// What is here: how the searcher "model" chooses its batches. What is not: what the model says (study_model.h).
#include "optimize/search/model_searcher.h"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "io/letters.h"
#include "optimize/search/nlopt_search.h"
#include "optimize/search/sampling_searcher.h"
#include "optimize/search/study_model.h"

namespace perfora::optimize {
namespace {

/// Points that DIRECT_L looks at for one point of a batch, over all arms, and SBPLX behind it: times variables + 1.
constexpr int global_looks = 40, local_looks = 20;
/// Each arm is looked at this often at least.
constexpr int fewest_looks = 30;
/// First steps of SBPLX, as a fraction of the bounds.
constexpr double local_step = 0.1;
/// Sobol points that are tried for one that keeps the constraints.
constexpr int most_tries = 200;
/// Points of DIRECT_L that are looked at for the next unknown one.
constexpr int most_replayed = 5000;
/// What NLopt hears of a point that is no use (a known design): worse than any improvement, better than a broken wall.
constexpr double no_use = 900.0;
/// A search ends when twice running no more than this share of the standard error of the leader's score is expected.
constexpr double little_gain = 0.1;
/// Improvements below this (of a score) are told apart by the lower bound of the score: the expected one less its
/// error. By the expected score alone a batch would be copies of the best design.
constexpr double least_improvement = 1e-6;
/// Designs of an arm lie at least so far apart (root mean square over the variables, in units of their bounds), or a
/// quarter of the mean distance of as many points where those lie closer: nearer ones are nearly the same discs with
/// the same seeds, and tell nothing.
constexpr double closest = 0.01, closest_of_mean = 0.25;

struct Place {
  std::size_t task = 0;
  std::vector<double> point;
};
using PlacesOfBatch = std::vector<Place>;
using Known = std::set<const Candidate*>;

/// One call of ask().
class ModelSearch {
 public:
  ModelSearch(const SearchStage& stage, const CandidateStore& store) : stage_(stage), store_(store) {
    for (const SearchTask& task : stage.tasks) {
      Trace& trace = traces_.emplace_back();
      trace.arm = task.arm;
      total_ += task.maxeval;
    }
  }

  std::vector<Trace> run() {
    for (std::size_t number = 0;; ++number) {
      if (asked() >= total_) return finished("maxeval reached");
      if (stage_.stop_score && best_ <= *stage_.stop_score) return finished("stop_score reached");
      const PlacesOfBatch batch = is_given(number) ? given(number) : next_batch();
      if (batch.empty() && !is_given(number)) return finished(ended_);
      if (!take(batch)) return traces_;
    }
  }

 private:
  int asked() const { return static_cast<int>(visited_.size()); }

  bool is_given(std::size_t number) const {
    return std::any_of(stage_.tasks.begin(), stage_.tasks.end(),
                       [&](const SearchTask& task) { return task.batches.size() > number; });
  }

  PlacesOfBatch given(std::size_t number) const {
    PlacesOfBatch batch;
    for (std::size_t k = 0; k < stage_.tasks.size(); ++k)
      if (stage_.tasks[k].batches.size() > number)
        for (const auto& point : stage_.tasks[k].batches[number]) batch.push_back({k, point});
    return batch;
  }

  const Candidate& at(const Place& place) const { return store_.at(stage_.tasks[place.task].arm, place.point); }

  /// False: some of its points are not answered yet.
  bool take(const PlacesOfBatch& batch) {
    for (Trace& trace : traces_) trace.batches.push_back(0);
    bool answered = true;
    for (const Place& place : batch) {
      Trace& trace = traces_[place.task];
      trace.visits.push_back(store_.visit(at(place)));
      ++trace.batches.back();
      const Visit& visit = trace.visits.back();
      visited_.push_back(visit.candidate);
      known_.insert(visit.candidate);
      answered = answered && visit.answered;
      if (visit.answered) best_ = std::min(best_, visit.score);
    }
    return answered;
  }

  /// What is known while points of a batch are chosen.
  struct Pick {
    Known taken;                        ///< points that are no use any more
    std::map<int, Points> places;       ///< the same, by arm
    double best = largest_score;        ///< lowest expected score
    const Candidate* leader = nullptr;  ///< the evaluated design that it is expected of
  };

  /// The same at the beginning of a batch, with its first point; no place where no point keeps the constraints.
  struct First {
    Pick pick;
    std::optional<Place> place;
  };

  std::vector<Trace> finished(const std::string& reason) {
    for (Trace& trace : traces_) {
      trace.finished = true;
      trace.reason = reason;
    }
    return std::move(traces_);
  }

  void note(const std::string& text) {
    for (Trace& trace : traces_) trace.note = text;
  }

  int batch_size() const { return std::min(std::max(1, stage_.batch), total_ - asked()); }

  PlacesOfBatch next_batch() {
    StudyModel model(store_, visited_, store_.study().keys.replicates);
    const int wanted = std::max(model::ResponseModel::fewest_designs, 2 * (store_.variables() + 1));
    if (!model.made() && asked() < std::min(wanted, std::max(total_ / 2, model::ResponseModel::fewest_designs))) {
      note("no model yet: " + model.in_words() + "; points are Sobol's");
      return sobol_batch();
    }
    if (!model.trusted()) {
      note("the model is not used: " + model.in_words() + "; points are those of GN_DIRECT_L");
      return replayed_batch();
    }
    note(model.in_words());
    First first = first_of(model, known_);
    if (gains_little(model, first) && gained_little_before()) {
      ended_ = "hardly anything to gain is expected";
      return {};
    }
    return improving_batch(model, std::move(first));
  }

  /// Whether the largest expected improvement is small beside what is not known of the leader's own score.
  bool gains_little(StudyModel& model, const First& first) const {
    const Pick& pick = first.pick;
    if (!first.place || !pick.leader) return false;
    return model.against(at(*first.place), pick.best).improvement < little_gain * model.at(*pick.leader).score_error;
  }

  /// The same of the model as it was before the last batch.
  bool gained_little_before() const {
    std::size_t last = 0;
    for (const Trace& trace : traces_)
      if (!trace.batches.empty()) last += static_cast<std::size_t>(trace.batches.back());
    if (last == 0) return false;
    const std::span<const Candidate* const> before(visited_.data(), visited_.size() - last);
    StudyModel model(store_, before, store_.study().keys.replicates);
    return model.trusted() && gains_little(model, first_of(model, Known(before.begin(), before.end())));
  }

  /// The next Sobol points of the arms in turn that keep the constraints.
  PlacesOfBatch sobol_batch() const {
    PlacesOfBatch batch;
    Known taken = known_;
    const int size = batch_size();
    const std::size_t arms = stage_.tasks.size();
    std::vector<Points> points;
    const int each = most_tries * (1 + (asked() + size) / static_cast<int>(arms));
    for (const SearchTask& task : stage_.tasks)
      points.push_back(sample_points("sobol", each, store_.variables(), task.seed));
    std::vector<std::size_t> next(arms, 0);
    for (std::size_t turn = visited_.size(), idle = 0; static_cast<int>(batch.size()) < size && idle < arms; ++turn) {
      const std::size_t task = turn % arms;
      bool found = false;
      while (!found && next[task] < points[task].size()) {
        Place place{task, on_grid(points[task][next[task]++])};
        const Candidate& candidate = at(place);
        found = candidate.violation <= 0.0 && taken.insert(&candidate).second;
        if (found) batch.push_back(std::move(place));
      }
      idle = found ? 0 : idle + 1;
    }
    return batch;
  }

  /// The next points of GN_DIRECT_L, arm by arm; the points of this batch count as the best known.
  PlacesOfBatch replayed_batch() const {
    PlacesOfBatch batch;
    Known lies;
    const std::size_t arms = stage_.tasks.size();
    for (std::size_t turn = visited_.size(), idle = 0; static_cast<int>(batch.size()) < batch_size() && idle < arms;
         ++turn) {
      std::optional<Place> open = next_of_direct(turn % arms, lies);
      idle = open ? 0 : idle + 1;
      if (!open) continue;
      lies.insert(&at(*open));
      batch.push_back(std::move(*open));
    }
    return batch;
  }

  std::optional<Place> next_of_direct(std::size_t task, const Known& lies) const {
    SearchOptions options = looking(task, "GN_DIRECT_L", most_replayed);
    std::optional<Place> open;
    run_search(options, [&](std::span<const double> x) -> std::optional<double> {
      Place place{task, on_grid({x.begin(), x.end()})};
      const Candidate& candidate = at(place);
      if (lies.contains(&candidate)) return std::min(best_, largest_score);
      if (candidate.violation > 0.0 || known_.contains(&candidate)) return store_.visit(candidate).score;
      open = std::move(place);
      return std::nullopt;
    });
    return open;
  }

  SearchOptions looking(std::size_t task, const std::string& algorithm, int looks) const {
    SearchOptions options;
    options.algorithm = algorithm;
    options.dimension = store_.variables();
    options.maxeval = looks;
    options.seed = stage_.tasks[task].seed;
    options.start.assign(static_cast<std::size_t>(store_.variables()), 0.5);
    options.initial_step = local_step;
    return options;
  }

  void take_up(Pick& pick, const Candidate& candidate) const {
    if (pick.taken.insert(&candidate).second)
      pick.places[candidate.arm].push_back(store_.study().point_of(candidate.values));
  }

  /// Whether a point lies too close to one that is taken.
  bool crowds(const Pick& pick, int arm, std::span<const double> x) const {
    const auto found = pick.places.find(arm);
    if (found == pick.places.end() || x.empty()) return false;
    const auto variables = static_cast<double>(x.size()), count = static_cast<double>(found->second.size() + 1);
    const double least = std::min(closest, closest_of_mean * std::pow(count, -1.0 / variables));
    return std::any_of(found->second.begin(), found->second.end(), [&](const std::vector<double>& other) {
      double squares = 0.0;
      for (std::size_t k = 0; k < x.size(); ++k) squares += (x[k] - other[k]) * (x[k] - other[k]);
      return squares < least * least * variables;
    });
  }

  Pick begun(StudyModel& model, const Known& known) const {
    Pick pick;
    for (const Candidate* one : known) take_up(pick, *one);
    const std::vector<StudyModel::Ranked> ranked = model.ranked();
    for (const StudyModel::Ranked& one : ranked) take_up(pick, *one.candidate);
    if (ranked.empty()) return pick;
    pick.best = ranked.front().answer.score;
    pick.leader = ranked.front().candidate;
    return pick;
  }

  First first_of(StudyModel& model, const Known& known) const {
    First first{begun(model, known), std::nullopt};
    first.place = best_place(model, first.pick);
    return first;
  }

  PlacesOfBatch improving_batch(StudyModel& model, First first) const {
    PlacesOfBatch batch;
    Pick pick = std::move(first.pick);
    while (static_cast<int>(batch.size()) < batch_size()) {
      std::optional<Place> place = batch.empty() ? std::move(first.place) : best_place(model, pick);
      if (!place) break;
      const Candidate& candidate = at(*place);
      take_up(pick, candidate);
      model.expect(candidate);
      pick.best = std::min(pick.best, model.at(candidate).score);
      batch.push_back(std::move(*place));
    }
    return batch;
  }

  /// The unknown point of all arms with the largest expected improvement; nothing where no point keeps the constraints.
  std::optional<Place> best_place(StudyModel& model, const Pick& pick) const {
    std::optional<Place> found;
    double least = no_use;
    std::map<const Candidate*, double> seen;
    const auto look = [&](std::size_t task, std::span<const double> x) {
      Place place{task, on_grid({x.begin(), x.end()})};
      const Candidate& candidate = at(place);
      if (candidate.violation > 0.0) return violation_score(candidate.violation);
      if (pick.taken.contains(&candidate) || crowds(pick, candidate.arm, place.point)) return no_use;
      const auto [known, fresh] = seen.emplace(&candidate, 0.0);
      if (fresh) known->second = cost_of(model.against(candidate, pick.best));
      if (known->second < least) {
        least = known->second;
        found = std::move(place);
      }
      return known->second;
    };
    const int dimension = store_.variables() + 1;
    const int each = std::max(fewest_looks, global_looks * dimension / static_cast<int>(stage_.tasks.size()));
    for (std::size_t task = 0; task < stage_.tasks.size(); ++task)
      run_search(looking(task, "GN_DIRECT_L", each), [&](std::span<const double> x) { return look(task, x); });
    const auto refine = [&](std::size_t task, std::vector<double> from) {
      SearchOptions options = looking(task, "LN_SBPLX", local_looks * dimension);
      options.start = std::move(from);
      run_search(options, [&](std::span<const double> x) { return look(task, x); });
    };
    // Around the best design known, which DIRECT's coarse boxes miss late in a search; then around the best point so
    // far.
    for (std::size_t task = 0; pick.leader && task < stage_.tasks.size(); ++task)
      if (stage_.tasks[task].arm == pick.leader->arm) refine(task, store_.study().point_of(pick.leader->values));
    if (found) refine(found->task, std::vector<double>(found->point));
    return found;
  }

  /// For a minimiser: minus the logarithm of the expected improvement; where that is tiny, the lower bound of the
  /// score.
  static double cost_of(const model::Answer& answer) {
    const double improvement = answer.improvement + least_improvement;
    return -std::log(improvement) + least_improvement / improvement * (answer.score - answer.score_error);
  }

  const SearchStage& stage_;
  const CandidateStore& store_;
  std::vector<Trace> traces_;
  std::vector<const Candidate*> visited_;
  Known known_;
  int total_ = 0;
  double best_ = largest_score;
  std::string ended_ = "no further point keeps the constraints";
};

class ModelSearcher final : public Searcher {
 public:
  Library library() const override {
    return {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)};
  }
  std::vector<std::string> algorithms() const override { return {"model"}; }
  std::string canonical_name(const std::string& name, std::string& problem) const override {
    std::string lower = io::lower(name);
    if (lower == "model") return lower;
    problem = "no search that learns is called so";
    return {};
  }
  bool asks_in_batches() const override { return true; }
  bool is_local(const std::string&) const override { return false; }
  std::optional<Refusal> refuse(const std::string&, int) const override { return std::nullopt; }
  std::vector<std::string> warnings(const std::string&, int, int, int) const override { return {}; }
  std::vector<Trace> ask(const SearchStage& stage, const CandidateStore& store) const override {
    return ModelSearch(stage, store).run();
  }
};

}  // namespace

std::shared_ptr<const Searcher> make_model_searcher() {
  return std::make_shared<const ModelSearcher>();
}

}  // namespace perfora::optimize
