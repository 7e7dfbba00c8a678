// What is here: NLopt by replay over candidates, and what a user is told about its algorithms. What is not: calls of
// NLopt (nlopt_search.cpp).
#include "optimize/search/nlopt_searcher.h"

#include <fmt/format.h>

#include <algorithm>

#include "optimize/search/nlopt_search.h"

namespace perfora::optimize {
namespace {

SearchOptions options_of(const SearchStage& stage, const SearchTask& task, const CandidateStore& store) {
  SearchOptions options;
  options.algorithm = stage.algorithm;
  options.dimension = store.variables();
  options.maxeval = task.maxeval;
  options.seed = task.seed;
  options.start = task.start;
  options.initial_step = stage.initial_step;
  options.population = stage.population;
  options.xtol = stage.xtol;
  options.ftol = stage.ftol;
  options.stop_score = stage.stop_score;
  if (takes_constraints(options.algorithm)) options.constraints = store.constraints();
  return options;
}

/// What an algorithm that is given the constraints hears at a point that breaks one: nothing new, the best score so
/// far.
double neutral(const Trace& trace) {
  double best = largest_score;
  for (const Visit& visit : trace.visits)
    if (visit.candidate->violation <= 0.0) best = std::min(best, visit.score);
  return best;
}

Trace replay(const SearchStage& stage, const SearchTask& task, const CandidateStore& store) {
  Trace trace;
  trace.arm = task.arm;
  const bool constrained = takes_constraints(stage.algorithm);
  const Objective objective = [&](std::span<const double> x) -> std::optional<double> {
    const Candidate& candidate = store.at(task.arm, x);
    const Visit point = store.visit(candidate);
    const double told = constrained && candidate.violation > 0.0 ? neutral(trace) : point.score;
    trace.visits.push_back(point);
    if (!point.answered) return std::nullopt;
    return told;
  };
  const Constraints constraints = [&](std::span<const double> x) { return store.at(task.arm, x).limits; };
  const SearchEnd end = run_search(options_of(stage, task, store), objective, constraints);
  trace.finished = end.finished;
  trace.reason = end.reason;
  return trace;
}

class NloptSearcher final : public Searcher {
 public:
  Library library() const override { return {"nlopt", nlopt_version_text()}; }

  std::vector<std::string> algorithms() const override { return derivative_free_algorithms(); }

  std::string canonical_name(const std::string& name, std::string& problem) const override {
    return canonical_algorithm(name, problem);
  }

  bool is_local(const std::string& algorithm) const override { return algorithm.starts_with("LN_"); }

  std::optional<Refusal> refuse(const std::string& algorithm, int variables) const override {
    if (variables < smallest_dimension(algorithm))
      return Refusal{fmt::format("{} needs at least {} variables, the study has {}", algorithm,
                                 smallest_dimension(algorithm), variables),
                     "take another algorithm, such as LN_BOBYQA or LN_SBPLX"};
    if (variables > largest_dimension(algorithm))
      return Refusal{fmt::format("{} takes at most {} variables, the study has {}", algorithm,
                                 largest_dimension(algorithm), variables),
                     "take another algorithm, such as GN_DIRECT_L"};
    return std::nullopt;
  }

  std::vector<std::string> warnings(const std::string& algorithm, int variables, int population,
                                    int maxeval) const override {
    std::vector<std::string> told;
    const int first = first_population(algorithm, variables, population);
    if (first >= maxeval)
      told.push_back(fmt::format(
          "{} spends its first {} points on a population and has only {} an arm: it will only sample; raise "
          "maxeval or set population",
          algorithm, first, maxeval));
    if (fits_models(algorithm) && !takes_constraints(algorithm))
      told.push_back(
          fmt::format("{} fits smooth models, which candidates that fail or break a constraint upset; LN_SBPLX and "
                      "LN_COBYLA bear them better",
                      algorithm));
    return told;
  }

  std::vector<Trace> ask(const SearchStage& stage, const CandidateStore& store) const override {
    std::vector<Trace> traces;
    for (const SearchTask& task : stage.tasks) traces.push_back(replay(stage, task, store));
    return traces;
  }
};

}  // namespace

std::shared_ptr<const Searcher> make_nlopt_searcher() {
  return std::make_shared<const NloptSearcher>();
}

}  // namespace perfora::optimize
