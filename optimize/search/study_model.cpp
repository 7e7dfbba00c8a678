// What is here: from a study's evaluations to a model and back to its candidates. What is not: the mathematics.
#include "optimize/search/study_model.h"

#include <algorithm>
#include <cmath>

#include "optimize/model/quasi_random.h"
#include "optimize/search/nlopt_search.h"
#include "optimize/search/searcher.h"

namespace perfora::optimize {
namespace {

results::PackSummary packing_of(const Candidate& candidate) {
  results::PackSummary packing;
  packing.porosity = candidate.layout.porosity;
  packing.thinnest_wall.thickness = candidate.layout.thinnest_wall;
  packing.thinnest_wall.first = std::isinf(candidate.layout.thinnest_wall) ? -1 : 0;
  return packing;
}

model::Traits traits_of(const CandidateStore& store, const Candidate& candidate) {
  return model::traits_of(*candidate.requests.front().design, store.study().point_of(candidate.values));
}

std::vector<model::KnownDesign> known_designs(const std::vector<Observed>& observed,
                                              const std::map<const Candidate*, model::Traits>& traits) {
  std::vector<model::KnownDesign> known;
  std::map<const Candidate*, int> numbers;
  for (const Observed& one : observed) {
    const int number = numbers.emplace(one.candidate, static_cast<int>(numbers.size())).first->second;
    known.push_back({traits.at(one.candidate), static_cast<int>(one.fidelity), number, one.replicates});
  }
  return known;
}

std::map<const Candidate*, model::Traits> traits_of_all(const CandidateStore& store,
                                                        const std::vector<Observed>& observed) {
  std::map<const Candidate*, model::Traits> traits;
  for (const Observed& one : observed)
    if (!traits.contains(one.candidate)) traits.emplace(one.candidate, traits_of(store, *one.candidate));
  return traits;
}

model::ResponseModel learn(const CandidateStore& store, const std::vector<Observed>& observed,
                           const std::map<const Candidate*, model::Traits>& traits) {
  const Study& study = store.study();
  const model::Minimiser minimiser = [](const model::Smooth& function, std::vector<double> start,
                                        const std::vector<double>& low, const std::vector<double>& high) {
    return descend(function, std::move(start), low, high);
  };
  return {known_designs(observed, traits), study.target, study.start->design().measuring_frame(), minimiser};
}

}  // namespace

StudyModel::StudyModel(const CandidateStore& store, std::span<const Candidate* const> visited, int replicates)
    : store_(store),
      observed_(store.observed(visited, replicates)),
      traits_(traits_of_all(store, observed_)),
      learnt_(learn(store, observed_, traits_)) {
  if (!learnt_.made()) return;
  const results::Target& target = store.study().target;
  answers_.emplace(target, learnt_, [&target](std::span<const results::Evaluation* const> blocks) {
    return score_of(target, blocks).value;
  });
}

model::Inputs StudyModel::inputs_of(const Candidate& candidate) {
  auto found = traits_.find(&candidate);
  if (found == traits_.end()) found = traits_.emplace(&candidate, traits_of(store_, candidate)).first;
  return learnt_.inputs_of(found->second);
}

const model::Answer& StudyModel::at(const Candidate& candidate) {
  const auto found = known_.find(&candidate);
  if (found != known_.end()) return found->second;
  return known_.emplace(&candidate, answers_->at(learnt_, inputs_of(candidate), packing_of(candidate))).first->second;
}

model::Answer StudyModel::against(const Candidate& candidate, double best) {
  return answers_->at(learnt_, inputs_of(candidate), packing_of(candidate), best);
}

std::vector<StudyModel::Ranked> StudyModel::ranked() {
  std::vector<Ranked> all;
  for (const Observed& one : observed_)
    if (one.candidate->arm >= 0 && (all.empty() || all.back().candidate != one.candidate))
      all.push_back({one.candidate, at(*one.candidate)});
  std::stable_sort(all.begin(), all.end(),
                   [](const Ranked& a, const Ranked& b) { return a.answer.score < b.answer.score; });
  return all;
}

void StudyModel::expect(const Candidate& candidate) {
  learnt_ = learnt_.told(inputs_of(candidate));
  known_.clear();
}

model::SobolIndices StudyModel::importance(int arm, int count) {
  // First the mean of what can be built, which then stands for what cannot.
  double sum = 0.0;
  int kept = 0;
  const auto score_at = [&](std::span<const double> x) -> std::optional<double> {
    const Candidate& candidate = store_.at(arm, on_grid({x.begin(), x.end()}));
    if (candidate.violation > 0.0) return std::nullopt;
    return at(candidate).score;
  };
  const auto seed = store_.study().arms[static_cast<std::size_t>(arm)].seed;
  const Eigen::MatrixXd points = model::sobol_matrix(count, store_.variables(), seed);
  for (int k = 0; k < count; ++k) {
    const Eigen::VectorXd x = points.row(k);
    if (const auto score = score_at({x.data(), static_cast<std::size_t>(x.size())})) {
      sum += *score;
      ++kept;
    }
  }
  const double mean = kept > 0 ? sum / kept : 0.0;
  return model::sobol_indices([&](std::span<const double> x) { return score_at(x).value_or(mean); }, store_.variables(),
                              count, seed);
}

}  // namespace perfora::optimize
