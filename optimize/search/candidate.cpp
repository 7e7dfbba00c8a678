// What is here: candidates worked out from a study. What is not: scores.
#include "optimize/search/candidate.h"
#include "io/text.h"

#include <fmt/format.h>
#include <algorithm>

namespace perfora::optimize {
namespace {

/// A design that passes the constraints but is refused all the same counts as this far off.
constexpr double refused_violation = 1.0;

const Arm* arm_of(const Study& study, int arm) {
  return arm < 0 ? nullptr : &study.arms[static_cast<std::size_t>(arm)];
}

std::string label_of(const Study& study, int arm, std::span<const double> values) {
  std::string label = arm < 0 ? "start" : study.arms[static_cast<std::size_t>(arm)].name;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Variable& variable = study.variables[k];
    label += fmt::format(", {} {}", io::after_section(variable.key), io::quantity(values[k], variable.dimension));
  }
  return label;
}

/// Throws io::InputError when the design is not valid at this fidelity.
Request request_at(const DesignFile& design, const Fidelity& fidelity, const std::string& file) {
  DesignFile resolved = design.clone();
  apply(fidelity, resolved, {file, 0, ""});
  resolved.require_valid();
  Request request = make_request(resolved, 0, fidelity.until);
  request.fidelity = fidelity.name;
  return request;
}

Candidate make_candidate(const Study& study, int arm, std::span<const double> values) {
  Candidate candidate;
  candidate.arm = arm;
  candidate.values.assign(values.begin(), values.end());
  candidate.label = label_of(study, arm, values);
  try {
    const DesignFile design = study.design_at(arm_of(study, arm), values);
    candidate.layout = measure_layout(design);
    candidate.limits = constraint_values(study.constraints, design, candidate.layout);
    candidate.violation = violation(candidate.limits);
    if (candidate.violation > 0.0) {
      candidate.problem = candidate.layout.placed ? "breaks a constraint" : candidate.layout.problem;
      return candidate;
    }
    for (const Fidelity& fidelity : study.fidelities)
      candidate.requests.push_back(request_at(design, fidelity, study.file.string()));
  } catch (const io::InputError& error) {
    candidate.problem = error.problem();
    candidate.violation = refused_violation;
    candidate.requests.clear();
    candidate.limits.assign(constraint_names(study.constraints).size(), refused_violation);
  }
  return candidate;
}

bool holds_start(const Study& study, const Arm& arm) {
  const io::Schema& schema = study.start->schema();
  const DesignFile same = study.design_at(&arm, {});
  return std::all_of(arm.choices.begin(), arm.choices.end(), [&](const DesignChange& choice) {
    const io::Key* own = schema.find(choice.key);
    const io::Key* other = same.schema().find(choice.key);
    return own && other && io::value_text(own->get()) == io::value_text(other->get());
  });
}

}  // namespace

const Candidate& CandidateBook::at(int arm, std::span<const double> values) {
  const std::pair<int, std::vector<double>> place{arm, {values.begin(), values.end()}};
  const auto found = candidates_.find(place);
  if (found != candidates_.end()) return found->second;
  return candidates_.emplace(place, make_candidate(study_, arm, values)).first->second;
}

const std::string& CandidateBook::key(const Candidate& candidate, int replicate, std::size_t fidelity) {
  auto& key = keys_[{&candidate, replicate, fidelity}];
  if (key.empty()) key = candidate.request(replicate, fidelity).key();
  return key;
}

const Candidate& CandidateBook::start() {
  std::vector<double> values;
  bool inside = true;
  for (const Variable& variable : study_.variables) {
    values.push_back(study_.start->schema().get_number(variable.key));
    inside = inside && values.back() >= variable.low && values.back() <= variable.high;
  }
  if (inside)
    for (std::size_t k = 0; k < study_.arms.size(); ++k)
      if (holds_start(study_, study_.arms[k]))
        return at(static_cast<int>(k), study_.values_at(study_.point_of(values)));
  return at(-1, values);
}

DesignFile design_of(const Study& study, const Candidate& candidate) {
  return study.design_at(arm_of(study, candidate.arm), candidate.values);
}

}  // namespace perfora::optimize
