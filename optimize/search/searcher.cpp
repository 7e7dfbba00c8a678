// What is here: the list of searchers and the choice of one by name. What is not: the algorithms.
#include "optimize/search/searcher.h"

#include <algorithm>
#include <cmath>

#include "optimize/search/model_searcher.h"
#include "optimize/search/nlopt_searcher.h"
#include "optimize/search/sampling_searcher.h"

namespace perfora::optimize {
namespace {

/// Steps of the grid between the bounds of a variable: finer than any block can be cast.
constexpr double grid_steps = 4096.0;

}  // namespace

std::vector<double> on_grid(std::vector<double> point) {
  for (double& x : point) x = std::round(std::clamp(x, 0.0, 1.0) * grid_steps) / grid_steps;
  return point;
}

const Searchers& built_in_searchers() {
  static const Searchers all{make_nlopt_searcher(), make_model_searcher(), make_sampling_searcher()};
  return all;
}

ChosenSearcher choose_searcher(const Searchers& searchers, const std::string& name) {
  ChosenSearcher chosen;
  for (const auto& searcher : searchers) {
    std::string problem;
    const std::string canonical = searcher->canonical_name(name, problem);
    if (!canonical.empty()) return {searcher, canonical, ""};
    if (chosen.problem.empty()) chosen.problem = problem;
  }
  return chosen;
}

std::vector<std::string> algorithm_names(const Searchers& searchers, bool only_local) {
  std::vector<std::string> names;
  for (const auto& searcher : searchers)
    for (std::string& name : searcher->algorithms())
      if (!only_local || searcher->is_local(name)) names.push_back(std::move(name));
  return names;
}

}  // namespace perfora::optimize
