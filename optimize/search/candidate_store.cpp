// What is here: candidates looked up with their scores. What is not: the score itself (objective.cpp).
#include "optimize/search/candidate_store.h"

#include <algorithm>
#include <tuple>

namespace perfora::optimize {

int CandidateStore::constraints() const {
  return static_cast<int>(constraint_names(study_.constraints).size());
}

const Candidate& CandidateStore::at(int arm, std::span<const double> x) const {
  return book_.at(arm, study_.values_at(x));
}

Visit CandidateStore::visit(const Candidate& candidate) const {
  return visit(candidate, study_.keys.replicates, 0);
}

Visit CandidateStore::visit(const Candidate& candidate, int replicates, std::size_t fidelity) const {
  Visit visit{&candidate, false, 0.0, {}};
  if (candidate.violation > 0.0) {
    visit.answered = true;
    visit.score = violation_score(candidate.violation);
    return visit;
  }
  const auto known = evaluations(candidate, 0, replicates, fidelity);
  if (std::find(known.begin(), known.end(), nullptr) != known.end()) return visit;
  visit.answered = true;
  visit.detail = score_of(study_.target, known);
  visit.score = visit.detail.value;
  return visit;
}

std::vector<const Evaluation*> CandidateStore::evaluations(const Candidate& candidate, int first, int count,
                                                           std::size_t fidelity) const {
  std::vector<const Evaluation*> known;
  for (int replicate = first; replicate < first + count; ++replicate)
    known.push_back(
        answer_for(candidate.request(replicate, fidelity), book_.key(candidate, replicate, fidelity), answers_));
  return known;
}

std::vector<Observed> CandidateStore::observed(std::span<const Candidate* const> visited, int replicates) const {
  std::set<const Candidate*> designs = told_;
  designs.insert(visited.begin(), visited.end());
  std::vector<Observed> found;
  for (const Candidate* candidate : designs) {
    for (std::size_t fidelity = 0; fidelity < candidate->requests.size(); ++fidelity) {
      Observed one{candidate, study_.point_of(candidate->values), fidelity, {}};
      for (int replicate = 0; replicate < replicates; ++replicate) {
        const std::string& key = book_.key(*candidate, replicate, fidelity);
        if (const Evaluation* known = answer_for(candidate->request(replicate, fidelity), key, answers_))
          one.replicates.push_back(known);
      }
      if (!one.replicates.empty()) found.push_back(std::move(one));
    }
  }
  std::sort(found.begin(), found.end(), [](const Observed& a, const Observed& b) {
    return std::tie(a.candidate->arm, a.candidate->values, a.fidelity) <
           std::tie(b.candidate->arm, b.candidate->values, b.fidelity);
  });
  return found;
}

}  // namespace perfora::optimize
