// What is here: what a sweep asks and says. What is not: its tables (sweep_result.cpp).
#include "optimize/campaign/sweep_run.h"

#include <fmt/format.h>

#include <set>

#include "io/text.h"
#include "optimize/campaign/sweep_result.h"
#include "results/formats.h"

namespace perfora::optimize {

using nlohmann::json;

SweepRun::SweepRun(Sweep sweep, WorkOptions options) : sweep_(std::move(sweep)) {
  for (const SweepCase& one : sweep_.cases) {
    std::vector<Run>& runs = runs_.emplace_back();
    for (int replicate = 0; one.problem.empty() && replicate < sweep_.keys.replicates; ++replicate) {
      const Request request = one.request(replicate);
      runs.push_back({{request.key(), request, one.label}, simulation_key(request)});
    }
  }
  simulations_ = sweep_.runs();
  options.execution = sweep_.keys.execution;
  open(std::move(options));
}

std::vector<std::string> SweepRun::own_files() const {
  return {"result.json",  "cases.csv",   "runs.csv",       "curves.csv",   "sweep.png",
          "collapse.png", "report.html", "tolerance.json", "tolerance.csv"};
}

json SweepRun::identity() const {
  return {{"schema", results::sweep_schema},
          {"file", sweep_.file.filename().string()},
          {"grid_key", sweep_.grid_key},
          {"each", sweep_.each}};
}

const SweepRun::Run& SweepRun::run_of(const SweepCase& one, int replicate) const {
  return runs_[static_cast<std::size_t>(&one - sweep_.cases.data())][static_cast<std::size_t>(replicate)];
}

const Evaluation* SweepRun::known(const SweepCase& one, int replicate) const {
  if (!one.problem.empty()) return nullptr;
  const Asked& asked = run_of(one, replicate).asked;
  return answer_for(asked.request, asked.key, answers());
}

const Evaluation* SweepRun::completed(const SweepCase& one, int replicate) const {
  const Evaluation* evaluation = known(one, replicate);
  return evaluation && evaluation->status == results::RunStatus::completed ? evaluation : nullptr;
}

std::vector<Asked> SweepRun::pending(const Answers& answers) {
  std::vector<Asked> asked;
  std::set<std::string> seen;  // Cases that come to the same simulation are one run.
  for (int replicate = 0; replicate < sweep_.keys.replicates; ++replicate)
    for (const SweepCase& one : sweep_.cases) {
      if (!one.problem.empty()) continue;
      const Run& run = run_of(one, replicate);
      if (!answer_for(run.asked.request, run.asked.key, answers) && seen.insert(run.simulation).second)
        asked.push_back(run.asked);
    }
  remaining_ = static_cast<std::int64_t>(asked.size());
  return asked;
}

std::string SweepRun::on_answer(const Asked& asked, const Evaluation& evaluation) {
  const auto& summary = evaluation.summary;
  const std::string what = evaluation.status == results::RunStatus::completed
                               ? fmt::format("first peak {}, plateau {}",
                                             io::quantity(summary.first_peak_stress, io::Dimension::stress, "none"),
                                             io::quantity(summary.plateau_stress, io::Dimension::stress, "none"))
                               : "failed: " + evaluation.reason;
  return fmt::format("run {} of {}: {}, replicate {}: {}", simulations_ - remaining_, simulations_, asked.label,
                     asked.request.replicate, what);
}

CampaignEnd SweepRun::finished() {
  std::set<std::string> reached;  // cases that come to the same simulation are one run
  for (const SweepCase& one : sweep_.cases)
    for (int replicate = 0; replicate < sweep_.keys.replicates; ++replicate)
      if (completed(one, replicate)) reached.insert(run_of(one, replicate).simulation);
  return {reached.empty() ? results::RunStatus::failed : results::RunStatus::completed,
          fmt::format("{} of {} runs completed", reached.size(), simulations_)};
}

void SweepRun::write_results() {
  optimize::write_results(*this);
}

}  // namespace perfora::optimize
