// What is here: replicates of one design run and read back, and the statistics over them. The journal is the truth of
// what is finished; ensemble.json and ensemble.csv follow
// from it. What is not: one evaluation.
#include "optimize/campaign/ensemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/journal.h"
#include "optimize/campaign/work_folder.h"
#include "optimize/evaluate/request.h"
#include "results/measure_table.h"

namespace perfora::optimize {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Names an ensemble whatever the number of replicates.
std::string ensemble_key(const DesignFile& design) {
  return make_request(design, 0).full_key();
}

fs::path journal_path(const fs::path& folder) {
  return folder / "journal.jsonl";
}

/// Everything an ensemble may have left in `folder`.
void remove_ensemble(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == "journal.jsonl" || name == "ensemble.json" || name == "ensemble.csv" || name.starts_with("replicate-"))
      fs::remove_all(entry.path());
  }
}

void prepare_folder(const EnsembleOptions& options) {
  const fs::path& folder = options.folder;
  if (!fs::exists(folder)) {
    io::check_output(folder, options.force, options.resume);
    fs::create_directory(folder);
    return;
  }
  if (!fs::is_directory(folder))
    throw io::InputError({folder.string(), 0, ""}, "is not a folder", "", "name a folder for the replicates with -o");
  if (const std::string there = work_in(folder); !there.empty() && there != "ensemble")
    throw io::InputError({folder.string(), 0, ""}, fmt::format("this folder holds a {}, not an ensemble", there), "",
                         "name another folder with -o");
  if (options.resume) return;
  if (options.force) {
    remove_ensemble(folder);
    return;
  }
  if (!fs::is_empty(folder))
    throw io::InputError(
        {folder.string(), 0, ""}, "the folder is not empty", "",
        "--resume keeps the replicates that are finished, --force throws them away, or name another folder with -o");
}

/// Finished replicates of the journal. The first event names the design; another one's journal is refused.
std::vector<Evaluation> read_finished(io::Journal& journal, const std::string& key, const fs::path& path) {
  std::vector<Evaluation> finished;
  if (journal.events().empty()) {
    journal.append(json({{"event", "ensemble"}, {"key", key}}).dump());
    return finished;
  }
  for (const std::string& text : journal.events()) {
    const json event = json::parse(text);
    if (event.value("event", "") == "ensemble" && event.value("key", "") != key)
      throw io::InputError(
          {path.string(), 0, ""},
          "this ensemble was made of another design, of other settings or by a program that gives other results", "",
          "resume with the same design file and flags, or start anew with --force or in another folder");
    if (event.value("event", "") == "replicate")
      finished.push_back(results::evaluation_from_json(event.at("evaluation")));
  }
  return finished;
}

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

void conclude(Ensemble& ensemble) {
  const auto completed = std::count_if(ensemble.replicates.begin(), ensemble.replicates.end(),
                                       [](const Evaluation& e) { return e.status == results::RunStatus::completed; });
  ensemble.statistics = statistics_of(ensemble.replicates);
  if (ensemble.status == results::RunStatus::stopped) return;
  ensemble.status = completed > 0 ? results::RunStatus::completed : results::RunStatus::failed;
  ensemble.reason = fmt::format("{} of {} replicates completed", completed, ensemble.wanted);
  if (completed == 0 && !ensemble.replicates.empty()) ensemble.reason += ": " + ensemble.replicates.front().reason;
}

}  // namespace

fs::path replicate_run_file(const fs::path& folder, int replicate) {
  return folder / fmt::format("replicate-{:03}.h5", replicate);
}

Ensemble evaluate_ensemble(const DesignFile& design, const EnsembleOptions& options) {
  if (!options.evaluate.packing_file.empty() && options.replicates > 1)
    throw io::InputError({"--packing", 0, ""},
                         "one packing file cannot serve several replicates: each has a packing of its own", "",
                         "leave --packing away, or take --replicates 1");
  prepare_folder(options);
  io::Journal journal(journal_path(options.folder));
  Ensemble ensemble;
  ensemble.wanted = options.replicates;
  const std::vector<Evaluation> finished = read_finished(journal, ensemble_key(design), journal_path(options.folder));
  for (int replicate = 0; replicate < options.replicates; ++replicate) {
    const auto found =
        std::find_if(finished.begin(), finished.end(), [&](const Evaluation& e) { return e.replicate == replicate; });
    const fs::path run_file = replicate_run_file(options.folder, replicate);
    const bool kept = found != finished.end();
    Evaluation evaluation;
    if (kept) {
      evaluation = *found;
    } else {
      EvaluateOptions one = options.evaluate;
      one.run_file = run_file;
      one.resume = options.resume;
      evaluation = evaluate_design(design, one, replicate);
      if (evaluation.status == results::RunStatus::stopped) {
        ensemble.status = results::RunStatus::stopped;
        ensemble.reason = fmt::format("replicate {}: {}", replicate, evaluation.reason);
        break;
      }
      journal.append(json({{"event", "replicate"}, {"evaluation", to_json(evaluation, true)}}).dump());
    }
    if (options.finished) options.finished(evaluation, run_file, kept);
    ensemble.replicates.push_back(std::move(evaluation));
  }
  conclude(ensemble);
  io::write_file(options.folder / "ensemble.json", to_json(ensemble).dump(2) + "\n");
  io::write_file(options.folder / "ensemble.csv", ensemble_csv(ensemble));
  return ensemble;
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
  return {{"schema", "perfora.ensemble/1"},
          {"status", status},
          {"reason", ensemble.reason},
          {"results_version", results_version},
          {"replicates", ensemble.wanted},
          {"statistics", statistics},
          {"runs", runs}};
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
      text += std::isfinite(value) ? fmt::format(",{:.17g}", value) : std::string(",");
    }
    text += "\n";
  }
  return text;
}

}  // namespace perfora::optimize
