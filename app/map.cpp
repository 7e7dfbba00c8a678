// What is here: `perfora map`: designs spread over all that a study varies, simulated in a folder, and what they tell
// of the reachable region. What is not: which designs (optimize/search/map_plan.h), drawing (report/).
#include <fmt/format.h>

#include "app/campaign_pictures.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/reports.h"
#include "app/workers.h"
#include "optimize/search/map_result.h"
#include "optimize/search/map_run.h"

namespace perfora::app {

namespace {

struct MapFlags {
  CommonFlags common;
  std::string study, output;
  int designs = 0;
  bool resume = false;
  WorkerFlags workers;
};

std::vector<std::string> overrides(const MapFlags& flags) {
  std::vector<std::string> all = flags.common.overrides();
  if (flags.designs > 0) all.push_back(fmt::format("map.designs={}", flags.designs));
  return all;
}

optimize::WorkOptions run_options(const MapFlags& flags, const optimize::Study& study) {
  optimize::WorkOptions options =
      work_options(flags.common, output_or_default(flags.output, default_name(flags.study, "-map")), flags.resume);
  const std::int64_t together = std::int64_t{study.keys.map.designs} * study.keys.map.replicates;
  options.make_executor =
      worker_executor(flags.workers, study.keys.execution,
                      optimize::workers_for(flags.workers.workers, study.keys.execution.workers, together),
                      flags.common, options.folder);
  return options;
}

int map_study(const MapFlags& flags) {
  refuse_resume_with_force(flags.resume, flags.common.force);
  optimize::Study study = optimize::read_study(flags.study, overrides(flags), optimize::StudyUse::map);
  optimize::WorkOptions options = run_options(flags, study);
  ProgressLine progress("map", flags.common.quiet);
  watch_on_terminal(options, progress);
  optimize::MapRun run(std::move(study), options);
  log_warnings(run.study().warnings);
  run.run();
  progress.finish(run.reason());
  const results::MapRecord record = run.record();
  if (!record.designs.empty()) {
    draw_campaign(options.folder, options.folder / "map.png");
    write_report_beside(options.folder);
  }
  for (const std::string& sentence : results::out_of_reach(record)) io::log_warning(sentence);
  if (const std::string best = optimize::best_of_map_text(run.study(), run.plan()); !best.empty()) io::log_info(best);
  nlohmann::json object = to_json(record);
  object["status"] = results::status_name(run.status());
  object["reason"] = run.reason();
  print_record(object, flags.common.json);
  if (run.status() != results::RunStatus::stopped)
    io::log_info(
        fmt::format("written: {} (report.html, map.csv, map.json, picture map.png); take it in a study with --map {}",
                    options.folder.string(), options.folder.string()));
  return say_how_work_ended(run.status(), run.troubles(), options.folder);
}

}  // namespace

void add_map(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<MapFlags>();
  CLI::App* command = program.add_subcommand(
      "map", "Simulate designs spread over all that a study varies: what can be reached, whatever is wished");
  command->add_option("STUDY", flags->study, "Study file (TOML)")->required();
  command->add_option("-o,--output", flags->output, "Folder for journal and results (default: STUDY's name + -map)")
      ->type_name("DIR");
  command->add_option("--designs", flags->designs, "How many, instead of map.designs")->check(positive_number());
  command->add_flag("--resume", flags->resume, "Continue a map that was stopped or killed, or shall have more designs");
  add_worker_flags(*command, flags->workers, "study");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    exit_code = map_study(*flags);
  });
}

}  // namespace perfora::app
