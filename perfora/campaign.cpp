// What is here: campaigns for users of the library: the runs of optimize/ in this process or in worker processes, their
// folders read back. What is not: what they ask and write (optimize/campaign/, optimize/search/).
#include "perfora/campaign.h"

#include <algorithm>

#include "io/memory.h"
#include "optimize/campaign/ensemble.h"
#include "optimize/campaign/sweep_run.h"
#include "optimize/search/calibration_run.h"
#include "optimize/search/study_result.h"
#include "optimize/search/study_run.h"
#include "perfora/inside.h"
#include "results/campaign_folder.h"
#include "results/describe.h"
#include "results/status.h"

namespace perfora {

namespace {

namespace fs = std::filesystem;

/// What the kinds of campaign leave in their folders.
struct Files {
  const char* kind;
  const char* rows;
  const char* best;  ///< nullptr: there is no such thing
};
constexpr Files files_of_kinds[] = {{"study", "evaluations.csv", "best.toml"},
                                    {"sweep", "cases.csv", nullptr},
                                    {"ensemble", "ensemble.csv", nullptr},
                                    {"calibration", "reachable.csv", "material.toml"}};

std::function<std::unique_ptr<optimize::Executor>()> executor(const CampaignOptions& options,
                                                              const optimize::ExecutionKeys& of_file, int workers,
                                                              const io::Cancellation& token) {
  const int threads = thread_count(options.threads);
  if (!options.program.empty())
    return optimize::worker_processes(
        {options.program, workers, threads, of_file.time_limit, io::usable_memory_bytes()});
  return [=, each = std::max(1, threads / workers)] {
    return optimize::make_in_process_executor(
        [each, token](const optimize::Request& request) { return optimize::evaluate_request(request, each, token); },
        workers);
  };
}

optimize::WorkOptions work_options(const CampaignOptions& options, ProgressRelay& relay, const std::string& kind,
                                   const optimize::ExecutionKeys& of_file, int workers) {
  optimize::WorkOptions work;
  work.folder = options.folder;
  work.resume = options.resume;
  work.force = options.force;
  work.cancellation = relay.token();
  work.progress = relay.work_callback(kind);
  work.make_executor = executor(options, of_file, workers, relay.token());
  return work;
}

void run_study(const fs::path& file, const CampaignOptions& options, ProgressRelay& relay) {
  optimize::Study study = optimize::read_study(file, options.overrides);
  const int workers = optimize::useful_workers(study, options.workers);
  const optimize::ExecutionKeys execution = study.keys.execution;
  optimize::StudyRun run(std::move(study), work_options(options, relay, "study", execution, workers));
  run.run();
  if (run.status() != results::RunStatus::completed || !options.best_run_file) return;
  optimize::EvaluateOptions best;
  best.threads = thread_count(options.threads);
  best.cancellation = relay.token();
  best.progress = relay.callback();
  static_cast<void>(optimize::evaluate_best(run, best));
}

void run_sweep(const fs::path& file, const CampaignOptions& options, ProgressRelay& relay) {
  optimize::Sweep sweep = optimize::read_sweep(file, options.overrides);
  optimize::WorkOptions work =
      work_options(options, relay, "sweep", sweep.keys.execution, sweep.workers(options.workers));
  work.keep_run_files = sweep.keys.run_files;
  optimize::SweepRun(std::move(sweep), std::move(work)).run();
}

void run_calibration(const fs::path& file, const CampaignOptions& options, ProgressRelay& relay) {
  const optimize::Calibration calibration = optimize::read_calibration(file, options.overrides);
  optimize::CalibrationOptions work;
  work.folder = options.folder;
  work.threads = thread_count(options.threads);
  work.resume = options.resume;
  work.force = options.force;
  work.cancellation = relay.token();
  work.progress = relay.callback();
  const optimize::ExecutionKeys& execution = calibration.keys.execution;
  const int side_by_side = options.workers > 0     ? options.workers
                           : execution.workers > 0 ? execution.workers
                                                   : work.threads;
  work.make_executor =
      executor(options, execution, optimize::calibration_workers(calibration, side_by_side), relay.token());
  static_cast<void>(optimize::calibrate(calibration, work));
}

void check_options(const CampaignOptions& options) {
  refuse_resume_with_force(options.resume, options.force);
  if (options.folder.empty())
    throw io::InputError({"folder", 0, ""}, "a campaign keeps its journal and results in a folder, and none was given");
}

}  // namespace

Campaign run_campaign(const fs::path& file, const CampaignOptions& options) {
  return at_boundary([&] {
    check_options(options);
    ProgressRelay relay(options.progress, options.stop);
    const std::string kind = results::kind_of_toml(file);
    if (kind == "study")
      run_study(file, options, relay);
    else if (kind == "sweep")
      run_sweep(file, options, relay);
    else if (kind == "calibration")
      run_calibration(file, options, relay);
    else
      throw io::InputError({file.string(), 0, ""}, "is no study, sweep or calibration",
                           "a file with a section [study], [sweep] or [calibrate]");
    relay.rethrow();
    return read_campaign(options.folder);
  });
}

Campaign run_ensemble(const Design& design, int replicates, const CampaignOptions& options) {
  return at_boundary([&] {
    check_options(options);
    if (replicates < 1)
      throw io::InputError({"replicates", 0, ""}, "is " + std::to_string(replicates), "a number from 1 is wanted");
    const optimize::DesignFile file = Inside::file(design).clone();
    file.require_valid();
    ProgressRelay relay(options.progress, options.stop);
    optimize::EnsembleOptions work;
    work.evaluate.threads = thread_count(options.threads);
    work.evaluate.cancellation = relay.token();
    work.evaluate.progress = relay.callback();
    work.folder = options.folder;
    work.replicates = replicates;
    work.resume = options.resume;
    work.force = options.force;
    static_cast<void>(optimize::evaluate_ensemble(file, work));
    relay.rethrow();
    return read_campaign(options.folder);
  });
}

Campaign read_campaign(const fs::path& folder) {
  return at_boundary([&] {
    Campaign campaign;
    campaign.folder = folder;
    campaign.kind = results::campaign_kind(folder);
    const auto* const files = std::find_if(std::begin(files_of_kinds), std::end(files_of_kinds),
                                           [&](const Files& one) { return one.kind == campaign.kind; });
    if (files == std::end(files_of_kinds))
      throw io::InputError({folder.string(), 0, ""}, "this folder holds no study, sweep, ensemble or calibration");
    const auto record = results::stored_summary(folder);
    if (record) campaign.verdict = verdict_in(*record);
    campaign.record = record ? record->dump(2) : std::string();
    const auto status = results::status_called(record ? record->value("status", "") : "");
    campaign.status = status_of(status.value_or(results::RunStatus::stopped));
    campaign.reason = record ? record->value("reason", "") : "not finished yet";
    if (fs::exists(folder / files->rows)) campaign.rows = read_table(folder / files->rows);
    if (files->best && fs::exists(folder / files->best)) campaign.best = Design::from_file(folder / files->best);
    return campaign;
  });
}

}  // namespace perfora
