// What is here: `perfora evaluate`: one design compressed (R.h5, R.csv, R.xdmf), an ensemble of replicates in a folder,
// or the elastic response alone. What is not: the evaluation (optimize/evaluate/evaluation.h,
// optimize/evaluate/elastic_response.h), statistics (optimize/campaign/ensemble.h).
#include <fmt/format.h>

#include <array>
#include <utility>

#include "app/commands.h"
#include "app/common.h"
#include "app/dakota.h"
#include "app/outputs.h"
#include "app/reports.h"
#include "app/terminal.h"
#include "io/error.h"
#include "io/lock.h"
#include "io/text.h"
#include "optimize/campaign/ensemble.h"
#include "optimize/evaluate/elastic_response.h"
#include "optimize/evaluate/run_output.h"

namespace perfora::app {

namespace {

struct EvaluateFlags {
  CommonFlags common;
  std::vector<std::string> dakota;  ///< empty, or the files of parameters and results
  std::string design, output, packing;
  std::string until;
  bool resume = false, elastic = false;
  int replicates = 0;
  double wall_time = 0.0;
};

std::vector<std::string> overrides_of(const EvaluateFlags& flags) {
  std::vector<std::string> overrides = flags.common.overrides();
  if (!flags.until.empty()) overrides.push_back("loading.until=" + flags.until);
  return overrides;
}

optimize::DesignFile read_design(const EvaluateFlags& flags) {
  return optimize::DesignFile(flags.design, overrides_of(flags));
}

optimize::EvaluateOptions evaluate_options(const EvaluateFlags& flags, ProgressLine& progress) {
  optimize::EvaluateOptions options;
  options.threads = flags.common.thread_count();
  options.packing_file = flags.packing;
  options.resume = flags.resume;
  options.wall_time_limit = flags.wall_time;
  options.cancellation = stop_token();
  options.command_line = command_line();
  options.progress = progress.callback();
  return options;
}

/// What is said at the end on standard error.
void say_how_it_ended(results::RunStatus status, const std::string& reason, const std::string& where,
                      const std::string& again) {
  if (status == results::RunStatus::completed) io::log_info("written: " + where);
  if (status == results::RunStatus::stopped)
    io::log_warning(fmt::format("stopped ({}); the state is kept; continue with {}", reason, again));
  if (status == results::RunStatus::failed) io::log_error(fmt::format("the evaluation failed: {}", reason));
}

int evaluate_one(const EvaluateFlags& flags) {
  const optimize::DesignFile design = read_design(flags);
  ProgressLine progress("compression", flags.common.quiet);
  optimize::EvaluateOptions options = evaluate_options(flags, progress);
  options.run_file = output_or_default(flags.output, default_name(flags.design, ".h5"));
  const optimize::PreparedEvaluation prepared =
      optimize::prepare_evaluation(design, options, 0, flags.common.force, flags.common.memory_allowed());
  log_warnings(prepared.warnings);
  const optimize::Evaluation evaluation = optimize::evaluate_design(design, options, 0);
  progress.finish(fmt::format("{}, {}", evaluation.reason, io::duration(evaluation.performance.seconds)));
  if (std::filesystem::exists(options.run_file)) {
    write_beside(options.run_file);
    write_report_beside(options.run_file);
  }
  log_warnings(optimize::validity_warnings(evaluation, design.design().solver.loading));
  const auto record = optimize::evaluation_record(design, evaluation);
  if (!flags.common.json && on_terminal())
    print_text(screen_text(record, evaluation.curve, options.run_file.string()));
  else
    print_record(record, flags.common.json);
  say_how_it_ended(evaluation.status, evaluation.reason, options.run_file.string(), "the same command and --resume");
  return exit_code_of(evaluation.status);
}

/// --elastic takes none of the flags that shape a run in time.
void refuse_with_elastic(const EvaluateFlags& flags) {
  const std::array<std::pair<bool, const char*>, 4> others = {{{!flags.until.empty(), "--until"},
                                                               {flags.resume, "--resume"},
                                                               {flags.replicates > 0, "--replicates"},
                                                               {flags.wall_time > 0.0, "--wall-time"}}};
  for (const auto& [given, name] : others)
    if (given)
      throw io::InputError({"--elastic", 0, ""},
                           fmt::format("--elastic and {} exclude each other: the elastic response is found at once, "
                                       "without a run",
                                       name),
                           "", "give only one of them");
}

/// The elastic response knows no edges: it is that of the periodic block.
void warn_about_edges(const solver::BoundaryOptions& boundary, std::vector<std::string>& warnings) {
  if (boundary.top_bottom != solver::TopBottom::periodic || boundary.sides != solver::Sides::periodic)
    warnings.push_back("--elastic responses for the periodic block; [boundary] is not looked at");
}

int evaluate_elastic(const EvaluateFlags& flags) {
  refuse_with_elastic(flags);
  const optimize::DesignFile design = read_design(flags);
  std::vector<std::string> warnings = design.validate(optimize::Purpose::block);
  warn_about_edges(design.design().solver.boundary, warnings);
  check_cost(design, flags.common);
  const auto output = output_or_default(flags.output, default_name(flags.design, "-elastic.h5"));
  if (!flags.packing.empty()) optimize::require_packing_file(design, flags.packing, 0);
  const io::OutputLock lock = io::claim_new_output(output, flags.common.force);
  log_warnings(warnings);
  ProgressLine progress("packing", flags.common.quiet);
  const optimize::ElasticResponse answer = optimize::elastic_response(design, evaluate_options(flags, progress), 0);
  progress.finish(fmt::format("{} discs, {}; elastic response in {} ({} iterations)",
                              io::count(answer.packed.summary.discs), io::duration(answer.packing_seconds),
                              io::duration(answer.solution_seconds), answer.response.iterations));
  const auto record = optimize::to_json(answer);
  const bool reached = answer.status == results::RunStatus::completed;
  if (reached) optimize::write_elastic_file(output, design, answer, record, command_line());
  print_record(record, flags.common.json);
  if (reached)
    io::log_info("written: " + output.string());
  else
    io::log_error("there is no elastic response, nothing was written: " + answer.reason);
  return exit_code_of(answer.status);
}

int evaluate_replicates(const EvaluateFlags& flags) {
  if (std::filesystem::path(flags.output).extension() == ".h5")
    throw io::InputError({"-o", 0, ""}, flags.output + ": several replicates are written to a folder", "",
                         "name a folder, such as " + std::filesystem::path(flags.output).replace_extension().string());
  const optimize::DesignFile design = read_design(flags);
  const std::vector<std::string> warnings = design.validate();
  check_cost(design, flags.common);
  if (!flags.packing.empty()) optimize::require_packing_file(design, flags.packing, 0);
  optimize::EnsembleOptions options;
  ProgressLine progress("ensemble", flags.common.quiet);
  options.evaluate = evaluate_options(flags, progress);
  options.folder = output_or_default(flags.output, default_name(flags.design, "-ensemble"));
  options.replicates = flags.replicates;
  options.resume = flags.resume;
  options.force = flags.common.force;
  options.results_written = report_renewal(options.folder);
  log_warnings(warnings);
  options.finished = [&](const optimize::Evaluation& evaluation, const std::filesystem::path& run_file, bool kept) {
    progress.finish("");
    if (std::filesystem::exists(run_file) && !(kept && all_beside(run_file))) write_beside(run_file);
    io::log_info(fmt::format("replicate {} ({} of {}){}: first peak {}, plateau {}", evaluation.replicate,
                             evaluation.replicate + 1, flags.replicates, kept ? " (was finished)" : "",
                             io::quantity(evaluation.summary.first_peak_stress, io::Dimension::stress, "none"),
                             io::quantity(evaluation.summary.plateau_stress, io::Dimension::stress, "none")));
  };
  const optimize::Ensemble ensemble = optimize::evaluate_ensemble(design, options);
  const auto record = optimize::to_json(ensemble);
  if (!ensemble.replicates.empty()) write_report_beside(options.folder);
  print_record(record, flags.common.json);
  say_how_it_ended(ensemble.status, ensemble.reason, options.folder.string(), "the same command and --resume");
  return exit_code_of(ensemble.status);
}

int evaluate_in_dakota(const EvaluateFlags& flags) {
  if (!flags.output.empty() || !flags.packing.empty() || flags.elastic || flags.resume || flags.replicates > 0 ||
      flags.wall_time > 0.0)
    throw io::InputError({"--dakota", 0, ""}, "takes one evaluation from a file and writes its results to another",
                         "beside it --set, --until, --threads, --memory, --force, --quiet and seeds");
  return evaluate_for_dakota({flags.design, flags.dakota.at(0), flags.dakota.at(1)}, flags.common, overrides_of(flags));
}

}  // namespace

void add_evaluate(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<EvaluateFlags>();
  CLI::App* command = program.add_subcommand("evaluate", "Compress one design, or several replicates of it");
  command->add_option("DESIGN", flags->design, "Design file (TOML)")->required();
  command
      ->add_option("-o,--output", flags->output,
                   "Run file to write (default: DESIGN's name + .h5); with --replicates a folder")
      ->type_name("R.h5|DIR");
  command->add_option("--packing", flags->packing, "Take the packing from this file of `perfora pack`")
      ->type_name("P.h5");
  command->add_option("--until", flags->until, "Engineering strain to run to, as 0.6 or \"60 %\" (loading.until)")
      ->type_name("STRAIN");
  command->add_flag("--elastic", flags->elastic,
                    "No run: the moduli of the block and where it yields first, in seconds (file: DESIGN-elastic.h5)");
  command->add_flag("--resume", flags->resume, "Continue a run or an ensemble that was stopped or killed");
  command
      ->add_option("--replicates", flags->replicates,
                   "Evaluate N replicates: other packings and strength fields of the same design")
      ->check(whole_number_within(1, most_replicates))
      ->type_name("N");
  command
      ->add_option("--wall-time", flags->wall_time,
                   "Stop with a checkpoint after this many seconds (of each replicate)")
      ->check(positive_number())
      ->type_name("SECONDS");
  command
      ->add_option("--dakota", flags->dakota,
                   "One evaluation for Dakota: its variables are keys of the design, its responses are measures "
                   "(docs/user/dakota.md)")
      ->expected(2)
      ->type_name("PARAMS RESULTS");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    if (!flags->dakota.empty()) {
      exit_code = evaluate_in_dakota(*flags);
      return;
    }
    refuse_resume_with_force(flags->resume, flags->common.force);
    if (flags->elastic) {
      exit_code = evaluate_elastic(*flags);
      return;
    }
    exit_code = flags->replicates > 0 ? evaluate_replicates(*flags) : evaluate_one(*flags);
  });
}

}  // namespace perfora::app
