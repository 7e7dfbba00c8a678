// What is here: `perfora check`: what a design, a study, a sweep or a calibration would run, without placing a disc.
// What is not: the estimates (optimize/evaluate/estimate.h).
#include <fmt/format.h>

#include <optional>
#include <set>

#include "app/commands.h"
#include "app/common.h"
#include "app/workers.h"
#include "io/schema.h"
#include "io/text.h"
#include "optimize/campaign/sweep.h"
#include "optimize/campaign/tolerance.h"
#include "optimize/evaluate/estimate.h"
#include "optimize/search/calibration_search.h"
#include "optimize/search/map_import.h"
#include "optimize/search/study_plan.h"
#include "optimize/search/study_run.h"
#include "results/describe.h"
#include "results/formats.h"
#include "results/summary_text.h"

namespace perfora::app {

namespace {

using nlohmann::json;

struct CheckFlags {
  CommonFlags common;
  std::string file;
  std::vector<std::string> only;
  int workers = 0;
};

std::string line(const std::string& label, const std::string& value) {
  return fmt::format("  {:<38} {}\n", label, value);
}

json estimate_json(const optimize::DesignFile& design, const optimize::DesignEstimate& estimate, int threads) {
  const bool holes = estimate.perforations > 0;
  return {{"width", design.design().layout.cell_width()},
          {"height", design.design().layout.cell_height()},
          {"perforations", estimate.perforations},
          {"porosity", estimate.porosity},
          {"thinnest_wall", holes ? json(estimate.thinnest_wall.thickness) : json(nullptr)},
          {"thinnest_wall_pair",
           holes ? json::array({estimate.thinnest_wall.first, estimate.thinnest_wall.second}) : json(nullptr)},
          {"thinnest_wall_ratio",
           holes ? json(estimate.thinnest_wall.thickness / estimate.characteristic_length) : json(nullptr)},
          {"characteristic_length", estimate.characteristic_length},
          {"horizon_radius", estimate.horizon_radius},
          {"discs", estimate.discs},
          {"bonds", estimate.bonds},
          {"bonds_per_disc", estimate.bonds_per_disc},
          {"time_step", estimate.time_step},
          {"rate", estimate.rate},
          {"steps", estimate.steps},
          {"memory", estimate.memory_bytes},
          {"disk", estimate.disk_bytes},
          {"seconds", estimate.seconds},
          {"threads", threads}};
}

/// `design` is the one evaluation that is described, `whose` says in words which of several it is; `most_memory` is
/// what the largest of them takes, bytes.
int report(const CheckFlags& flags, const char* kind, const json& plan, const std::string& plan_text,
           const optimize::DesignFile& design, std::vector<std::string> warnings, const std::string& whose = "",
           double most_memory = 0.0) {
  const int threads = flags.common.thread_count();
  const optimize::DesignEstimate estimate = optimize::estimate_design(design, threads);
  optimize::DesignEstimate largest = estimate;
  largest.memory_bytes = std::max(estimate.memory_bytes, most_memory);
  const std::string memory = optimize::memory_problem(design, largest, flags.common.memory_allowed());
  if (!memory.empty()) warnings.push_back(memory);
  for (std::string& text : optimize::cost_warnings(estimate)) warnings.push_back(std::move(text));
  const json expected = estimate_json(design, estimate, threads);
  if (flags.common.json) {
    json object = {{"schema", results::check_schema}, {"status", "completed"}, {"reason", ""}, {"kind", kind}};
    object.update(expected);
    if (!plan.is_null()) object[kind] = plan;
    object["warnings"] = warnings;
    print_json(object);
  } else {
    const std::string but = warnings.empty()       ? ""
                            : warnings.size() == 1 ? ", with a warning"
                                                   : fmt::format(", with {} warnings", warnings.size());
    print_text(fmt::format("{}: a valid {}{}\n", flags.file, kind, but) + results::estimate_text(expected, whose) +
               plan_text);
  }
  log_warnings(warnings);
  return exit_ok;
}

int check_design(const CheckFlags& flags) {
  const optimize::DesignFile design(flags.file, flags.common.overrides());
  return report(flags, "design", nullptr, "", design, design.validate());
}

json plan_json(const optimize::StudyPlan& plan) {
  json stages = json::array();
  for (const optimize::PlannedStage& one : plan.stages)
    stages.push_back({{"stage", one.name},
                      {"fidelity", one.fidelity},
                      {"designs", one.designs},
                      {"runs", one.runs},
                      {"seconds", one.seconds()},
                      {"measured", one.measured}});
  return stages;
}

/// A line a stage: designs, runs, time of one processor.
std::string plan_text(const optimize::StudyPlan& plan, int workers) {
  std::string text =
      fmt::format("Plan, at most{:<28}{:>8}{:>8}   {}\n", "", "designs", "runs", "time of one processor");
  for (const optimize::PlannedStage& one : plan.stages) {
    const std::string name = one.name + (one.fidelity.empty() ? "" : " at " + one.fidelity);
    text += fmt::format("  {:<38} {:>8}{:>8}   {}{}\n", name, io::count(one.designs), io::count(one.runs),
                        io::duration(one.seconds()), one.measured ? "" : ", estimated");
  }
  return text + line(fmt::format("time on {} processor{}, roughly", workers, workers == 1 ? "" : "s"),
                     io::duration(plan.seconds() / workers));
}

/// What comes from another folder, beside the plan.
std::string taken_text(const optimize::Study& study) {
  const optimize::TakenMap& taken = study.taken;
  return line("taken from " + study.keys.map.from.string(),
              fmt::format("{} designs, {} runs; they took {} there, which {}", io::count(taken.designs),
                          io::count(taken.evaluations), io::duration(taken.seconds),
                          study.keys.budget > 0.0 ? "the budget does not count" : "the plan does not count"));
}

int check_study_file(const CheckFlags& flags) {
  const optimize::Study study = optimize::read_study(flags.file, flags.common.overrides());
  const std::filesystem::path& from = study.keys.map.from;
  if (!from.empty() && study.taken.evaluations == 0)
    static_cast<void>(optimize::evaluations_of(from, study, {flags.file, 0, "map.from"}));
  const optimize::StudyPlan plan = optimize::plan_of(study);
  const int workers = optimize::useful_workers(study, flags.workers);
  const std::vector<std::string> wishes = results::in_words(study.target, study.start->design().measures);
  const std::vector<std::string> constraints = in_words(study.constraints, study.start->design());
  json arms = json::array();
  std::string text = "Wished\n";
  for (const std::string& wish : wishes) text += fmt::format("  {}\n", wish);
  text += "Every candidate\n";
  for (const std::string& constraint : constraints) text += fmt::format("  {}\n", constraint);
  text += "Varied\n";
  json variables = json::object();
  for (const optimize::Variable& variable : study.variables) {
    variables[variable.key] = {variable.low, variable.high};
    text += line(variable.key,
                 fmt::format("{}, start {}", io::quantities({variable.low, variable.high}, variable.dimension, " to "),
                             io::quantity(study.start->schema().get_number(variable.key), variable.dimension)));
  }
  text += "Search\n";
  for (const optimize::Arm& arm : study.arms) {
    arms.push_back({{"name", arm.name}, {"maxeval", arm.maxeval}});
    text += line("arm " + arm.name, fmt::format("{} candidates", arm.maxeval));
  }
  text += plan_text(plan, workers);
  if (!from.empty()) text += taken_text(study);
  json object = {
      {"candidates", std::int64_t{study.keys.maxeval} + (study.keys.refine.empty() ? 0 : study.keys.refine_maxeval)},
      {"simulations", plan.runs()},
      {"seconds", plan.seconds()},
      {"wishes", wishes},
      {"constraints", constraints},
      {"variables", variables},
      {"arms", arms}};
  if (!optimize::is_plain(study.keys)) object["plan"] = plan_json(plan);
  if (!from.empty())
    object["taken"] = {{"from", from.string()},
                       {"designs", study.taken.designs},
                       {"runs", study.taken.evaluations},
                       {"seconds", study.taken.seconds}};
  return report(flags, "study", object, text, *study.start, study.warnings);
}

/// `kind`: "sweep" or "tolerance".
int check_cases(const CheckFlags& flags, const char* kind, const optimize::Sweep& sweep) {
  json cases = json::array();
  std::string text = "Cases\n";
  double seconds = 0.0, longest = -1.0, most_memory = 0.0;
  int described = 0;  // the case that takes longest stands for all; read_sweep() sees that one can be run
  std::optional<optimize::DesignFile> dearest;
  std::set<std::string> designs;
  for (const optimize::SweepCase& one : sweep.cases) {
    cases.push_back({{"case", one.number}, {"label", one.label}, {"problem", one.problem}});
    const std::string name = fmt::format("case {}", one.number);
    if (!one.problem.empty()) {
      text += line(name, one.label + " (cannot be run)");
      continue;
    }
    auto design = optimize::DesignFile::of(*one.design, "case");
    const optimize::DesignEstimate estimate = optimize::estimate_design(design, 1);
    const double each = estimate.seconds;
    most_memory = std::max(most_memory, estimate.memory_bytes);
    const bool counted = !designs.insert(optimize::simulation_key(one.request(0))).second;
    text += line(name, fmt::format("{} ({})", one.label, counted ? "as one before" : io::duration(each)));
    if (!counted) seconds += each * sweep.keys.replicates;
    if (each <= longest) continue;
    longest = each;
    described = one.number;
    dearest = std::move(design);
  }
  const int workers = sweep.workers(flags.workers);
  seconds /= workers;
  text += line("simulations", io::count(sweep.runs()));
  text += line(fmt::format("time with {} at once, roughly", workers), io::duration(seconds));
  const json object = {
      {"cases", cases}, {"simulations", sweep.runs()}, {"seconds", seconds}, {"described_case", described}};
  return report(flags, kind, object, text, dearest.value(), sweep.warnings,
                fmt::format(" of case {}, the longest", described), most_memory);
}

int check_calibration(const CheckFlags& flags) {
  const optimize::Calibration calibration = optimize::read_calibration(flags.file, flags.common.overrides());
  const optimize::DesignFile sample = optimize::material_sample(*calibration.start);
  const optimize::DesignEstimate estimate = optimize::estimate_design(sample, flags.common.thread_count());
  constexpr int tests_a_point = 2, tests_at_the_end = 4;
  const int points = optimize::most_points(calibration);
  const int tests = (tests_a_point * points + tests_at_the_end) * calibration.keys.replicates;
  if (flags.common.json) {
    print_json({{"schema", results::check_schema},
                {"status", "completed"},
                {"reason", ""},
                {"kind", "calibration"},
                {"discs", estimate.discs},
                {"bonds", estimate.bonds},
                {"points", points},
                {"tests", tests},
                {"warnings", calibration.warnings}});
  } else {
    print_text(
        fmt::format("{}: a valid calibration\n", flags.file) + line("discs of a sample", io::count(estimate.discs)) +
        line("bonds of a sample", io::count(estimate.bonds)) + line("points, at most", fmt::format("{}", points)) +
        line("material tests, at most", fmt::format("{}", tests)));
  }
  log_warnings(calibration.warnings);
  return exit_ok;
}

}  // namespace

void add_check(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<CheckFlags>();
  CLI::App* command =
      program.add_subcommand("check", "Say what a design, study, sweep or calibration would run, without running it");
  command->add_option("FILE", flags->file, "Design, study, sweep or calibration file (TOML)")->required();
  add_only_flag(*command, flags->only, ", and the design itself where the sweep has it as a case; for sweeps");
  add_workers_flag(*command, flags->workers, "study or sweep");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    const std::string kind = results::kind_of_toml(flags->file);
    if (!flags->only.empty() && kind != "sweep")
      throw io::InputError({flags->file, 0, "--only"}, "chooses cases of a sweep, and this is none", "",
                           "leave it out");
    exit_code =
        kind == "study" ? check_study_file(*flags)
        : kind == "sweep"
            ? check_cases(*flags, "sweep", optimize::read_sweep(flags->file, flags->common.overrides(), flags->only))
        : kind == "tolerance"
            ? check_cases(*flags, "tolerance", optimize::read_tolerance(flags->file, flags->common.overrides()).sweep)
        : kind == "calibration" ? check_calibration(*flags)
                                : check_design(*flags);
  });
}

}  // namespace perfora::app
