// What is here: the list of searchers and the choice of one by name. What is not: the algorithms.
#include "optimize/search/searcher.h"

#include "optimize/search/nlopt_searcher.h"

namespace perfora::optimize {

const Searchers& built_in_searchers() {
  static const Searchers all{make_nlopt_searcher()};
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
