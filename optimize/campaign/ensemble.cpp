// What is here: an ensemble as a campaign; its statistics and files. What is not: one evaluation.
#include "optimize/campaign/ensemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/files.h"
#include "optimize/campaign/campaign.h"
#include "optimize/evaluate/request.h"
#include "results/formats.h"
#include "results/measure_table.h"

namespace perfora::optimize {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::vector<results::Statistic> statistics_of(const std::vector<Evaluation>& replicates) {
  std::vector<results::Statistic> statistics;
  for (const results::Measure* result : results::ensemble_measures()) {
    std::vector<double> values;
    for (const Evaluation& evaluation : replicates)
      if (evaluation.status == results::RunStatus::completed) values.push_back(results::value_of(*result, evaluation));
    statistics.push_back(results::statistic_of(result->key, values));
  }
  return statistics;
}

/// Replicates of one design as a campaign.
class EnsembleRun final : public Campaign {
 public:
  EnsembleRun(const DesignFile& design, const EnsembleOptions& options) : design_(design), options_(options) {
    for (int replicate = 0; replicate < options.replicates; ++replicate) {
      const Request request = make_request(design, replicate);
      asked_.push_back(
          {request.key(), request, fmt::format("replicate {}", replicate), replicate_run_file({}, replicate)});
    }
    WorkOptions work;
    work.folder = options.folder;
    work.resume = options.resume;
    work.force = options.force;
    work.command_line = options.evaluate.command_line;
    work.results_written = options.results_written;
    work.make_executor = [this] { return make_calling_executor([this](const Request& r) { return evaluate(r); }); };
    open(std::move(work));
  }

  /// Tells of the replicates that the journal knows.
  void tell_kept() const {
    for (const Asked& one : asked_)
      if (const Evaluation* known = answer_for(one.request, one.key, answers())) tell(*known, true);
  }

  Ensemble ensemble() const {
    Ensemble found;
    found.status = status();
    found.reason = reason();
    found.wanted = options_.replicates;
    for (const Asked& one : asked_)
      if (const Evaluation* known = answer_for(one.request, one.key, answers())) found.replicates.push_back(*known);
    found.statistics = statistics_of(found.replicates);
    std::vector<const Evaluation*> judged;
    for (const Evaluation& one : found.replicates) judged.push_back(&one);
    found.judgement = results::judgement_on(design_.design().target, judged);
    return found;
  }

  std::string kind() const override { return "ensemble"; }
  std::vector<std::string> own_files() const override {
    return {"ensemble.json", "ensemble.csv", "report.html", "replicate-*"};
  }
  /// Names the design whatever the number of replicates.
  json identity() const override { return {{"key", make_request(design_, 0).full_key()}}; }
  void check_same(const json& head, const fs::path& journal) const override {
    if (head.value("key", "") == identity().at("key")) return;
    throw io::InputError(
        {journal.string(), 0, ""},
        "this ensemble was made of another design, of other settings or by a program that gives other results", "",
        "resume with the same design file and flags, or start anew with --force or in another folder");
  }
  std::vector<Asked> pending(const Answers& answers) override {
    std::vector<Asked> asked;
    for (const Asked& one : asked_)
      if (!answer_for(one.request, one.key, answers)) asked.push_back(one);
    remaining_ = static_cast<std::int64_t>(asked.size());
    return asked;
  }
  std::string on_answer(const Asked&, const Evaluation& evaluation) override {
    tell(evaluation, false);
    return {};
  }
  std::int64_t remaining() const override { return remaining_; }
  CampaignEnd finished() override {
    const Ensemble found = ensemble();
    const auto completed = std::count_if(found.replicates.begin(), found.replicates.end(),
                                         [](const Evaluation& e) { return e.status == results::RunStatus::completed; });
    CampaignEnd end{completed > 0 ? results::RunStatus::completed : results::RunStatus::failed,
                    fmt::format("{} of {} replicates completed", completed, found.wanted)};
    if (completed == 0 && !found.replicates.empty()) end.reason += ": " + found.replicates.front().reason;
    return end;
  }
  CampaignEnd stopped(const Evaluation* interrupted) override {
    if (!interrupted) return Campaign::stopped(nullptr);
    return {results::RunStatus::stopped, fmt::format("replicate {}: {}", interrupted->replicate, interrupted->reason)};
  }
  void write_results() override {
    const Ensemble found = ensemble();
    io::write_file(options_.folder / "ensemble.json", to_json(found).dump(2) + "\n");
    io::write_file(options_.folder / "ensemble.csv", ensemble_csv(found));
  }

 private:
  Evaluation evaluate(const Request& request) const {
    EvaluateOptions one = options_.evaluate;
    one.run_file = request.run_file;
    one.resume = options_.resume;
    return evaluate_design(design_, one, request.replicate);
  }

  void tell(const Evaluation& evaluation, bool kept) const {
    if (options_.finished)
      options_.finished(evaluation, replicate_run_file(options_.folder, evaluation.replicate), kept);
  }

  const DesignFile& design_;
  const EnsembleOptions& options_;
  std::vector<Asked> asked_;  ///< by replicate
  std::int64_t remaining_ = 0;
};

}  // namespace

fs::path replicate_run_file(const fs::path& folder, int replicate) {
  return folder / fmt::format("replicate-{:03}.h5", replicate);
}

Ensemble evaluate_ensemble(const DesignFile& design, const EnsembleOptions& options) {
  if (!options.evaluate.packing_file.empty() && options.replicates > 1)
    throw io::InputError({"--packing", 0, ""},
                         "one packing file cannot serve several replicates: each has a packing of its own", "",
                         "leave --packing away, or take --replicates 1");
  EnsembleRun run(design, options);
  run.tell_kept();
  run.run();
  return run.ensemble();
}

json to_json(const Ensemble& ensemble) {
  json statistics = json::object();
  for (const results::Statistic& s : ensemble.statistics)
    statistics[s.name] = {{"count", s.count},
                          {"mean", number(s.mean)},
                          {"standard_deviation", number(s.standard_deviation)},
                          {"confidence_95", number(s.confidence_95)},
                          {"minimum", number(s.minimum)},
                          {"maximum", number(s.maximum)}};
  json runs = json::array();
  for (const Evaluation& evaluation : ensemble.replicates) runs.push_back(to_json(evaluation, false));
  const char* status = results::status_name(ensemble.status);
  json record = {{"schema", results::ensemble_schema},
                 {"status", status},
                 {"reason", ensemble.reason},
                 {"results_version", results_version},
                 {"replicates", ensemble.wanted},
                 {"statistics", statistics},
                 {"runs", runs}};
  if (ensemble.judgement) record.update(results::to_json(*ensemble.judgement));
  return record;
}

std::string ensemble_csv(const Ensemble& ensemble) {
  std::string text = "replicate,status,packing_seed,noise_seed";
  for (const results::Measure* result : results::ensemble_measures()) text += std::string(",") + result->key;
  text += "\n";
  for (const Evaluation& evaluation : ensemble.replicates) {
    text += fmt::format("{},{},{},{}", evaluation.replicate,
                        evaluation.status == results::RunStatus::completed ? "completed" : "failed",
                        evaluation.seeds.packing, evaluation.seeds.noise);
    for (const results::Measure* result : results::ensemble_measures()) {
      const double value = results::value_of(*result, evaluation);
      text += std::isfinite(value) ? fmt::format(",{}", value) : std::string(",");
    }
    text += "\n";
  }
  return text;
}

}  // namespace perfora::optimize
