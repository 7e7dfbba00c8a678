// What is here: sampling the arms of a study. What is not: a search that learns.
#include "optimize/search/sampling_searcher.h"

#include <algorithm>
#include <random>
#include <set>

#include "io/letters.h"
#include "optimize/evaluate/design.h"
#include "optimize/model/quasi_random.h"

namespace perfora::optimize {
namespace {

/// An arm in which so many points a wanted one break the constraints is given up.
constexpr int tries_a_point = 200;

Trace sample(const std::string& algorithm, const SearchTask& task, const CandidateStore& store) {
  Trace trace;
  trace.arm = task.arm;
  trace.finished = true;
  std::set<const Candidate*> taken;
  Points points;
  for (int tries = 0; static_cast<int>(taken.size()) < task.maxeval && tries < tries_a_point * task.maxeval; ++tries) {
    const auto at = static_cast<std::size_t>(tries);
    if (at == points.size())
      points = sample_points(algorithm, std::max(task.maxeval, 2 * tries), store.variables(), task.seed);
    const Candidate& candidate = store.at(task.arm, on_grid(points[at]));
    if (candidate.violation > 0.0 || !taken.insert(&candidate).second) continue;
    trace.visits.push_back(store.visit(candidate));
    trace.finished = trace.finished && trace.visits.back().answered;
  }
  trace.reason = static_cast<int>(taken.size()) == task.maxeval ? "maxeval reached" : "few points keep the constraints";
  return trace;
}

class SamplingSearcher final : public Searcher {
 public:
  Library library() const override { return {"perfora", "1"}; }
  std::vector<std::string> algorithms() const override { return {"random", "sobol"}; }
  std::string canonical_name(const std::string& name, std::string& problem) const override {
    std::string lower = io::lower(name);
    if (lower == "random" || lower == "sobol") return lower;
    problem = "no sampling is called so";
    return {};
  }
  bool asks_at_once() const override { return true; }
  bool is_local(const std::string&) const override { return false; }
  std::optional<Refusal> refuse(const std::string&, int) const override { return std::nullopt; }
  std::vector<std::string> warnings(const std::string&, int, int, int) const override { return {}; }
  std::vector<Trace> ask(const SearchStage& stage, const CandidateStore& store) const override {
    std::vector<Trace> traces;
    for (const SearchTask& task : stage.tasks) traces.push_back(sample(stage.algorithm, task, store));
    return traces;
  }
};

}  // namespace

Points sample_points(const std::string& algorithm, int count, int dimension, std::uint64_t seed) {
  if (algorithm == "sobol") return model::sobol_points(count, dimension, seed);
  std::mt19937_64 random(seed);
  Points points(static_cast<std::size_t>(count), std::vector<double>(static_cast<std::size_t>(dimension)));
  for (auto& point : points)
    for (double& x : point) x = static_cast<double>(random() >> 11) / 9007199254740992.0;  // 53 bits, everywhere alike
  return points;
}

std::shared_ptr<const Searcher> make_sampling_searcher() {
  return std::make_shared<const SamplingSearcher>();
}

}  // namespace perfora::optimize
