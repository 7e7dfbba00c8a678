// What is here: the comparison of designs objective by objective. What is not: the objectives (objective.h).
#include "optimize/search/pareto.h"

#include <algorithm>
#include <set>

#include "optimize/search/study_parts.h"

namespace perfora::optimize {
namespace {

bool beats(const std::vector<double>& a, const std::vector<double>& b) {
  bool better = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] > b[k]) return false;
    better = better || a[k] < b[k];
  }
  return better;
}

std::vector<ParetoMember> known_designs(const Study& study, const Plan& plan) {
  std::vector<ParetoMember> known;
  std::set<const Candidate*> taken;
  const auto add = [&](const Visit& visit, int number) {
    if (visit.detail.valid && visit.candidate->violation <= 0.0 && taken.insert(visit.candidate).second)
      known.push_back({visit.candidate, number, visit.detail, false});
  };
  int number = 0;
  for (const Trace& trace : plan.traces)
    for (const Visit& visit : trace.visits)
      if (visit.answered) add(visit, ++number);
  if (study.map_fidelity == 0 && study.keys.map.replicates >= study.keys.replicates)
    for (const Visit& visit : plan.map) add(visit, 0);
  return known;
}

}  // namespace

std::vector<bool> not_beaten(std::span<const std::vector<double>> rows) {
  std::vector<bool> kept;
  for (const auto& row : rows)
    kept.push_back(std::none_of(rows.begin(), rows.end(), [&](const auto& other) { return beats(other, row); }));
  return kept;
}

std::vector<ParetoMember> pareto_set(const Study& study, const Plan& plan) {
  if (objectives(study.target).size() < 2) return {};
  std::vector<ParetoMember> known = known_designs(study, plan);
  const auto keeps_more = [](const ParetoMember& a, const ParetoMember& b) {
    return a.score.not_kept < b.score.not_kept;
  };
  if (known.empty()) return {};
  const int fewest = std::min_element(known.begin(), known.end(), keeps_more)->score.not_kept;
  std::erase_if(known, [&](const ParetoMember& one) { return one.score.not_kept > fewest; });
  std::vector<std::vector<double>> terms;
  for (const ParetoMember& one : known) terms.push_back(one.score.terms);
  const std::vector<bool> kept = not_beaten(terms);
  std::vector<ParetoMember> members;
  for (std::size_t k = 0; k < known.size(); ++k)
    if (kept[k]) members.push_back(known[k]);
  for (ParetoMember& one : members)
    one.verified = (one.candidate == plan.best && plan.finals.best.replicates > 0) ||
                   std::any_of(plan.verified.begin(), plan.verified.end(),
                               [&](const Verified& other) { return other.candidate == one.candidate; });
  std::stable_sort(members.begin(), members.end(),
                   [](const ParetoMember& a, const ParetoMember& b) { return a.score.value < b.score.value; });
  return members;
}

nlohmann::json pareto_json(const Study& study, const Plan& plan) {
  const std::vector<ParetoMember> members = pareto_set(study, plan);
  if (members.empty()) return nullptr;
  nlohmann::json keys = nlohmann::json::array(), designs = nlohmann::json::array();
  for (const results::Measure* measure : objectives(study.target)) keys.push_back(measure->key);
  for (const ParetoMember& one : members)
    designs.push_back({{"number", one.number > 0 ? nlohmann::json(one.number) : nlohmann::json(nullptr)},
                       {"label", one.candidate->label},
                       {"design", design_values(study, *one.candidate)},
                       {"score", score_json(one.score)},
                       {"verified", one.verified}});
  return {{"objectives", keys}, {"designs", designs}};
}

}  // namespace perfora::optimize
