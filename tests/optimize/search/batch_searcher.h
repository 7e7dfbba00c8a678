// What is here: a searcher that asks in batches, simple enough to be worked out by hand: half of a batch around the
// best point so far, half from a sequence. What is not: a searcher of the program.
#pragma once

#include <algorithm>
#include <memory>

#include "optimize/model/quasi_random.h"
#include "optimize/search/searcher.h"

namespace perfora::optimize {

class BatchSearcher final : public Searcher {
 public:
  Library library() const override { return {"batches", "1"}; }
  std::vector<std::string> algorithms() const override { return {"batches"}; }
  std::string canonical_name(const std::string& name, std::string& problem) const override {
    if (name == "batches") return name;
    problem = "there is one only";
    return {};
  }
  bool asks_in_batches() const override { return true; }
  bool is_local(const std::string&) const override { return false; }
  std::optional<Refusal> refuse(const std::string&, int) const override { return {}; }
  std::vector<std::string> warnings(const std::string&, int, int, int) const override { return {}; }

  /// All tasks together; arms in turn.
  std::vector<Trace> ask(const SearchStage& stage, const CandidateStore& store) const override {
    std::vector<Trace> traces;
    int most = 0;
    std::size_t journalled = 0;
    for (const SearchTask& task : stage.tasks) {
      traces.emplace_back().arm = task.arm;
      most += task.maxeval;
      journalled = std::max(journalled, task.batches.size());
    }
    std::vector<double> best(static_cast<std::size_t>(store.variables()), 0.5);
    double lowest = 1e300;
    int asked = 0;
    const auto points = model::sobol_points(most, store.variables(), stage.tasks.front().seed);
    for (std::size_t batch = 0; asked < most; ++batch) {
      bool answered = true;
      for (Trace& trace : traces) trace.batches.push_back(0);
      std::vector<Visit> visits;
      const auto take = [&](std::size_t task, const std::vector<double>& point) {
        const Visit visit = store.visit(store.at(traces[task].arm, point));
        traces[task].visits.push_back(visit);
        ++traces[task].batches.back();
        ++asked;
        answered = answered && visit.answered;
        visits.push_back(visit);
      };
      if (batch < journalled)
        for (std::size_t task = 0; task < traces.size(); ++task)
          for (const auto& point : stage.tasks[task].batches[batch]) take(task, point);
      else
        for (int k = 0; k < stage.batch && asked < most; ++k) {
          std::vector<double> point = points[static_cast<std::size_t>(asked)];
          for (std::size_t d = 0; k % 2 == 1 && d < point.size(); ++d) point[d] = best[d] + 0.1 * (point[d] - 0.5);
          take(static_cast<std::size_t>(asked) % traces.size(), on_grid(point));
        }
      if (!answered) return traces;
      for (const Visit& visit : visits)
        if (visit.score < lowest) {
          lowest = visit.score;
          best = store.study().point_of(visit.candidate->values);
        }
    }
    for (Trace& trace : traces) {
      trace.finished = true;
      trace.reason = "maxeval reached";
    }
    return traces;
  }
};

}  // namespace perfora::optimize
