// What is here: the designs of a map. What is not: the sequence (optimize/model/quasi_random.h).
#include "optimize/search/map_plan.h"

#include <algorithm>
#include <set>

#include "io/text.h"
#include "optimize/model/quasi_random.h"
#include "optimize/search/searcher.h"

namespace perfora::optimize {
namespace {

/// Points that are looked at for one design before the rest is given up: constraints that leave less than this
/// fraction of the bounds are better met by narrower bounds.
constexpr int most_tries_a_design = 200;

/// Arms that differ in more than where a search of theirs begins.
std::vector<int> different_arms(const Study& study) {
  std::vector<int> arms;
  std::set<std::vector<std::string>> known;
  for (std::size_t k = 0; k < study.arms.size(); ++k) {
    std::vector<std::string> choices;
    for (const DesignChange& choice : study.arms[k].choices)
      choices.push_back(choice.key + "=" + io::value_text(choice.value));
    if (known.insert(choices).second) arms.push_back(static_cast<int>(k));
  }
  return arms;
}

}  // namespace

MapChoice choose_map(const Study& study, CandidateBook& book, int designs) {
  MapChoice choice;
  const std::vector<int> arms = different_arms(study);
  const int dimension = static_cast<int>(study.variables.size()) + 1;
  const std::uint64_t seed = study.start->design().seeds.effective(0).search;
  std::set<const Candidate*> known;
  std::vector<std::vector<double>> sequence;
  while (static_cast<int>(choice.points.size()) < designs && choice.tried < most_tries_a_design * designs) {
    if (static_cast<std::size_t>(choice.tried) == sequence.size())
      sequence = model::sobol_points(std::max(designs, 2 * choice.tried), dimension, seed);
    const std::vector<double>& place = sequence[static_cast<std::size_t>(choice.tried++)];
    const auto arm = static_cast<std::size_t>(place.front() * static_cast<double>(arms.size()));
    BatchPoint point{arms[arm], on_grid({place.begin() + 1, place.end()})};
    const Candidate& candidate = book.at(point.arm, study.values_at(point.point));
    if (candidate.violation > 0.0 || !known.insert(&candidate).second) continue;
    choice.points.push_back(std::move(point));
  }
  return choice;
}

}  // namespace perfora::optimize
