// What is here: the loop of a sweep around its journal. What is not: its tables and pictures.
#include "optimize/campaign/sweep_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <set>

#include "io/progress.h"
#include "io/text.h"
#include "optimize/campaign/work_folder.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

/// Everything a sweep writes into its folder; --force removes these and nothing else.
constexpr const char* own_files[] = {"journal.jsonl", "result.json",  "cases.csv", "runs.csv", "curves.csv",
                                     "sweep.png",     "collapse.png", "runs",      "histories"};

}  // namespace

SweepRun::SweepRun(Sweep sweep, WorkOptions options) : sweep_(std::move(sweep)) {
  prepare_work_folder(options.folder, own_files, "sweep", options.force, options.resume);
  bool known = false;
  queue_ = std::make_unique<EvaluationQueue>(std::move(options), [&](const json&) { known = true; });
  if (!known || queue_->options().resume)
    queue_->note({{"event", "sweep"},
                  {"schema", "perfora.sweep/1"},
                  {"results_version", results_version},
                  {"command_line", queue_->options().command_line},
                  {"file", sweep_.file.filename().string()}});
  for (const SweepCase& one : sweep_.cases) {
    std::vector<Run>& runs = runs_.emplace_back();
    for (int replicate = 0; one.problem.empty() && replicate < sweep_.keys.replicates; ++replicate) {
      const Request request = one.request(replicate);
      runs.push_back({{request.key(), request, one.label}, request.full_key()});
    }
  }
}

SweepRun::~SweepRun() = default;

const SweepRun::Run& SweepRun::run_of(const SweepCase& one, int replicate) const {
  return runs_[static_cast<std::size_t>(&one - sweep_.cases.data())][static_cast<std::size_t>(replicate)];
}

const Evaluation* SweepRun::known(const SweepCase& one, int replicate) const {
  if (!one.problem.empty()) return nullptr;
  const Asked& asked = run_of(one, replicate).asked;
  return answer_for(asked.request, asked.key, queue_->answers());
}

const Evaluation* SweepRun::completed(const SweepCase& one, int replicate) const {
  const Evaluation* evaluation = known(one, replicate);
  return evaluation && evaluation->status == results::RunStatus::completed ? evaluation : nullptr;
}

std::vector<Asked> SweepRun::wanted() const {
  std::vector<Asked> asked;
  std::set<std::string> seen;  // Cases that come to the same design are one run.
  for (int replicate = 0; replicate < sweep_.keys.replicates; ++replicate)
    for (const SweepCase& one : sweep_.cases)
      if (one.problem.empty() && !known(one, replicate) && seen.insert(run_of(one, replicate).full_key).second)
        asked.push_back(run_of(one, replicate).asked);
  return asked;
}

void SweepRun::say(const Asked& asked, const Evaluation& evaluation) {
  const auto& summary = evaluation.summary;
  const std::string what = evaluation.status == results::RunStatus::completed
                               ? fmt::format("first peak {}, plateau {}",
                                             io::quantity(summary.first_peak_stress, io::Dimension::stress, "none"),
                                             io::quantity(summary.plateau_stress, io::Dimension::stress, "none"))
                               : "failed: " + evaluation.reason;
  const auto left = static_cast<std::int64_t>(wanted().size());
  io::log_info(fmt::format("run {} of {}: {}, replicate {}: {}{}", sweep_.runs() - left, sweep_.runs(), asked.label,
                           asked.request.replicate, what, queue_->time_left(left)));
}

void SweepRun::run() {
  const auto begin = std::chrono::steady_clock::now();
  const bool done = queue_->run([this] { return wanted(); },
                                [this](const Asked& asked, const Evaluation& evaluation) { say(asked, evaluation); });
  std::set<std::string> reached;  // by full key: cases that come to the same design are one run
  for (const SweepCase& one : sweep_.cases)
    for (int replicate = 0; replicate < sweep_.keys.replicates; ++replicate)
      if (completed(one, replicate)) reached.insert(run_of(one, replicate).full_key);
  status_ = !done              ? results::RunStatus::stopped
            : !reached.empty() ? results::RunStatus::completed
                               : results::RunStatus::failed;
  reason_ = done ? fmt::format("{} of {} runs completed", reached.size(), sweep_.runs())
                 : "stopped by a signal; go on with --resume";
  queue_->note({{"event", done ? "finished" : "stop"}, {"reason", reason_}});
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace perfora::optimize
