// What is here: reading a study file and saying what is wrong with it; designs at a point. What is not: arms
// (study_arms.cpp).
#include "optimize/search/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "io/text.h"
#include "optimize/campaign/table_file.h"
#include "optimize/search/map_import.h"
#include "optimize/search/searcher.h"
#include "optimize/search/study_arms.h"
#include "optimize/search/study_fidelities.h"
#include "optimize/search/study_plan.h"
#include "results/interval.h"

namespace perfora::optimize {
namespace {

/// Everything that is needed while a study file is read.
struct Reader {
  std::filesystem::path path;
  const Searchers& searchers;
  StudyUse use;
  Study study;
  io::Schema schema;
  std::optional<TableFile> tables;

  Reader(const std::filesystem::path& file, const Searchers& known, StudyUse used)
      : path(file), searchers(known), use(used) {
    describe(schema, study.keys);
    describe(schema, study.target);
    describe(schema, study.constraints);
    study.file = file;
  }

  io::Origin origin(const std::string& key) const { return tables->origin(key); }

  /// `allocation` may be a list of whole numbers; the table of keys knows one type a key.
  static void flatten_allocation(io::Entry& entry, const std::string& source) {
    const auto* list = std::get_if<io::ValueList>(&entry.value.data);
    if (entry.key != "study.allocation" || !list) return;
    std::string text;
    for (const io::Value& item : *list) {
      const auto* number = std::get_if<std::int64_t>(&item.data);
      if (!number || *number < 0)
        throw io::InputError({source, entry.value.line, entry.key},
                             "the list holds something that is not a number of candidates",
                             "\"equal\", \"proportional\" or whole numbers >= 0, one an arm", "");
      text += fmt::format("{}{}", text.empty() ? "" : ", ", *number);
    }
    entry.value.data = text;
  }

  void read(const std::vector<std::string>& overrides) {
    const TableFileForm form{"study",
                             {"study", "target", "constraints", "map", "race", "verify"},
                             {"variables", "arms", "fidelity"},
                             flatten_allocation};
    tables.emplace(path, form, schema, overrides);
    study.title = tables->title();
    auto start = tables->start(study.keys.design);
    check_numbers(*start);
    study.warnings = start->validate();
    study.start = start;
    set_fidelities(study, tables->entries(), start->design().solver.loading.until,
                   [this](const std::string& key) { return origin(key); });
  }

  void check_numbers(DesignFile& start) {
    if (study.keys.budget > 0.0 && study.keys.maxeval > 0)
      throw io::InputError(origin("study.maxeval"), "a budget is given, too, which says how many candidates there are",
                           "study.maxeval or study.budget", "leave one of them out");
    if (use == StudyUse::search && study.keys.maxeval < 1 && !(study.keys.budget > 0.0))
      throw io::InputError(origin("study.maxeval"), "no number of candidates is given", "a whole number >= 1",
                           "add maxeval = 24 under [study], or budget = \"10 h\"; most algorithms never stop by "
                           "themselves; what a map gives without a search is told by perfora map STUDY");
    refuse_skip(study.keys.execution, origin("study.on_trouble"));
    set_target(start);
    set_window(start);
    check_algorithms();
    const double wall = study.constraints.thinnest_wall;
    const geometry::LayoutOptions& layout = start.design().layout;
    if (wall >= std::min(layout.cell_width(), layout.cell_height()))
      throw io::InputError(origin("constraints.thinnest_wall"),
                           fmt::format("{} is more than the cell has", io::quantity(wall, io::Dimension::length)),
                           "walls are thinner than the cell; plain numbers are in m",
                           fmt::format("did you mean \"{:g} mm\"?", wall));
    const auto& porosity = study.constraints.porosity;
    if (!porosity.empty() && (porosity.size() != 2 || !(porosity[0] <= porosity[1]) || !(porosity[1] > 0.0)))
      throw io::InputError(origin("constraints.porosity"), "this is not a range",
                           "[lowest, highest] with 0 <= lowest <= highest", "write for example porosity = [0.2, 0.4]");
  }

  /// What the study does not say of its target, the design does; the design of every candidate then holds all of it.
  void set_target(DesignFile& start) {
    for (const io::Key& key : schema.keys())
      if (key.section.starts_with("target") && schema.origin(key.full_name()).file == "default")
        schema.set(key.full_name(), start.schema().at(key.full_name()).get(), {});
    start.design().target = study.target;
    if (use == StudyUse::search && !results::is_given(study.target))
      throw io::InputError(origin("target.plateau_stress"), "nothing is wished",
                           "a plateau stress, a curve, limits or weights under [target]",
                           "add plateau_stress = \"0.2 MPa\" under [target]");
  }

  void set_window(DesignFile& start) {
    Design& design = start.design();
    results::validate(study.target, design.measures, schema);
    design.measures = results::with_window_of(study.target, design.measures);
    if (study.keys.until > 0.0) design.solver.loading.until = study.keys.until;
    const auto refuse_beyond = [&](double strain, const char* what, const std::string& key) {
      if (design.solver.loading.until >= strain) return;
      throw io::InputError(
          origin(study.keys.until > 0.0 ? "study.until" : key),
          fmt::format("{} at strain {:g}, the runs end at {:g} before it", what, strain, design.solver.loading.until),
          "a run at least as long as the window", fmt::format("raise study.until or lower {}", key));
    };
    if (design.measures.plateau == results::PlateauPlace::window)
      refuse_beyond(design.measures.plateau_end, "the window ends", "target.window");
    if (!study.target.stress_until.empty())
      refuse_beyond(study.target.stress_until.front(), "the largest stress is limited up to",
                    "target.limit.stress_until");
  }

  void check_algorithms() {
    const ChosenSearcher first = choose_searcher(searchers, study.keys.algorithm);
    if (!first.searcher) refuse_algorithm("study.algorithm", study.keys.algorithm, first.problem, false);
    study.searcher = first.searcher;
    study.keys.algorithm = first.algorithm;
    if (study.keys.refine.empty()) return;
    ChosenSearcher local = choose_searcher(searchers, study.keys.refine);
    if (local.searcher && !local.searcher->is_local(local.algorithm))
      local = {nullptr, "", fmt::format("\"{}\" is not a local algorithm", study.keys.refine)};
    if (!local.searcher) refuse_algorithm("study.refine", study.keys.refine, local.problem, true);
    study.refiner = local.searcher;
    study.keys.refine = local.algorithm;
    if (study.keys.refine_maxeval < 1)
      throw io::InputError(origin("study.refine_maxeval"), "the second stage has no candidates", "a whole number >= 1",
                           "add refine_maxeval = 8, or leave refine out");
  }

  [[noreturn]] void refuse_algorithm(const std::string& key, const std::string& asked, const std::string& problem,
                                     bool local) const {
    const std::vector<std::string> allowed = algorithm_names(searchers, local);
    const std::string nearest = io::nearest_name(asked, allowed);
    throw io::InputError(origin(key), problem, fmt::format("{}", fmt::join(allowed, ", ")),
                         nearest.empty() ? "take one of these" : fmt::format("did you mean {}?", nearest));
  }

  void check_dimension() const {
    const int n = static_cast<int>(study.variables.size());
    const auto check = [&](const std::string& key, const Searcher* searcher, const std::string& algorithm) {
      if (!searcher) return;
      if (const auto refusal = searcher->refuse(algorithm, n))
        throw io::InputError(origin(key), refusal->problem, "", refusal->remedy);
    };
    check("study.algorithm", study.searcher.get(), study.keys.algorithm);
    check("study.refine", study.refiner.get(), study.keys.refine);
  }

  /// The start is compared with the best design; outside the bounds it is no candidate.
  void warn_about_start() {
    for (const Variable& variable : study.variables) {
      const double value = study.start->schema().get_number(variable.key);
      if (value >= variable.low && value <= variable.high) continue;
      study.warnings.push_back(fmt::format(
          "the design to start from has {} = {}, outside the bounds {}: it is compared with, but is no candidate",
          variable.key, io::quantity(value, variable.dimension),
          io::quantities({variable.low, variable.high}, variable.dimension, " to ")));
    }
  }

  bool is_default(const std::string& key) const { return schema.origin(key).file == "default"; }

  /// What the arms get, once it is known which there are.
  void share_out_candidates() {
    StudyKeys& keys = study.keys;
    if (keys.map.designs < 1 && use == StudyUse::map)
      throw io::InputError(origin("map.designs"), "no number of designs is given", "a whole number >= 1",
                           "add designs = 96 under [map], or give --designs 96");
    if (keys.race.finalists > 0) keys.race.keep = std::min(keys.race.keep, keys.race.finalists);
    if (use == StudyUse::map) return;
    if (!keys.map.from.empty() && std::filesystem::exists(keys.map.from / "journal.jsonl"))
      study.taken = taken_map(study, origin("map.from"));
    if (keys.budget > 0.0)
      spend_budget(study, {is_default("map.designs"), is_default("race.finalists")}, origin("study.budget"));
    allocate(study, origin("study.allocation"));
  }

  void warn() {
    auto& warnings = study.warnings;
    int fewest = study.keys.maxeval;
    for (const Arm& arm : study.arms) fewest = std::min(fewest, arm.maxeval);
    const int n = static_cast<int>(study.variables.size());
    for (std::string& told : study.searcher->warnings(study.keys.algorithm, n, study.keys.population, fewest))
      warnings.push_back(std::move(told));
    if (study.keys.replicates == 1)
      warnings.push_back(
          "one replicate a candidate: the score holds the scatter from packing to packing; final_replicates tells how "
          "much of the "
          "gain is real");
    const bool mapped = study.keys.map.designs > 0 || !study.keys.map.from.empty();
    if (mapped && study.map_fidelity == 0 && study.keys.replicates < study.keys.map.replicates)
      warnings.push_back(
          fmt::format("study.replicates = {} is below map.replicates = {}: the search goes by the first packings of a "
                      "mapped design alone; give both the same number",
                      study.keys.replicates, study.keys.map.replicates));
    if (study.keys.final_replicates < results::fewest_replicates)
      warnings.push_back(fmt::format("final_replicates below {}: the verdict cannot say that the wish is met",
                                     results::fewest_replicates));
    warn_about_start();
  }
};

}  // namespace

bool changes_search(const std::string& key) {
  constexpr std::array<std::string_view, 5> beside_the_path = {"measures.", "target.", "material_test.",
                                                               "loading.until", "seeds.search"};
  return changes_path(key) || std::any_of(beside_the_path.begin(), beside_the_path.end(),
                                          [&](std::string_view one) { return key.starts_with(one); });
}

std::vector<double> Study::values_at(std::span<const double> x) const {
  std::vector<double> values(variables.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Variable& variable = variables[k];
    const double value = io::rounded(variable.low + std::clamp(x[k], 0.0, 1.0) * (variable.high - variable.low));
    values[k] = std::clamp(value, variable.low, variable.high);
  }
  return values;
}

std::vector<double> Study::point_of(std::span<const double> values) const {
  std::vector<double> x(variables.size());
  for (std::size_t k = 0; k < x.size(); ++k)
    x[k] = std::clamp((values[k] - variables[k].low) / (variables[k].high - variables[k].low), 0.0, 1.0);
  return x;
}

DesignFile Study::design_at(const Arm* arm, std::span<const double> values) const {
  DesignFile made(start->design());
  if (arm)
    for (const DesignChange& choice : arm->choices)
      made.schema().set(choice.key, choice.value, {file.string(), choice.value.line, choice.key});
  for (std::size_t k = 0; k < values.size(); ++k)
    made.schema().set_number(variables[k].key, values[k], {file.string(), 0, variables[k].key});
  return made;
}

std::map<std::string, std::string> Study::resolved() const {
  std::map<std::string, std::string> all;
  StudyKeys own = keys;
  results::Target aim = target;
  ConstraintKeys limits = constraints;
  io::Schema schema;
  describe(schema, own);
  describe(schema, aim);
  describe(schema, limits);
  for (const io::Key& key : schema.keys())
    if (key.full_name() != "study.design" && key.full_name() != "map.from" &&
        !(key.section == "study" && is_execution_key(key.name)))
      all[key.full_name()] = io::value_text(key.get());
  for (const Variable& variable : variables)
    all["variables." + variable.key] = fmt::format("[{:.17g}, {:.17g}]", variable.low, variable.high);
  all.insert(ladder.begin(), ladder.end());
  std::string names;
  for (const Arm& arm : arms) names += fmt::format("{}{}: {}", names.empty() ? "" : "; ", arm.name, arm.maxeval);
  all["arms"] = names;
  const DesignFile design(without_places(start->design()));
  for (const io::Key& key : design.schema().keys())
    if (changes_search(key.full_name())) all["design." + key.full_name()] = io::value_text(key.get());
  return all;
}

std::set<std::string> Study::at_default() const {
  std::set<std::string> names;
  StudyKeys own;
  results::Target aim;
  ConstraintKeys limits;
  io::Schema schema;  // bound to the defaults, then given what this study has
  describe(schema, own);
  describe(schema, aim);
  describe(schema, limits);
  own = keys;
  aim = target;
  limits = constraints;
  for (const io::Key& key : schema.keys())
    if (key.at_default()) names.insert(key.full_name());
  for (const io::Key& key : start->schema().keys())
    if (key.at_default()) names.insert("design." + key.full_name());
  return names;
}

Study read_study(const std::filesystem::path& path, const std::vector<std::string>& overrides, StudyUse use) {
  return read_study(path, overrides, built_in_searchers(), use);
}

Study read_study(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                 const Searchers& searchers, StudyUse use) {
  Reader reader(path, searchers, use);
  reader.read(overrides);
  ArmEntries entries;
  for (const TableEntry& entry : reader.tables->entries())
    if (entry.table != "fidelity")
      (entry.table == "arms" ? entries.arms : entries.variables).push_back({entry.key, entry.value});
  make_variables(reader.study, entries);
  reader.check_dimension();
  make_arms(reader.study, entries);
  reader.share_out_candidates();
  if (use == StudyUse::search) reader.warn();
  return std::move(reader.study);
}

std::string study_reference() {
  StudyKeys keys;
  results::Target target;
  ConstraintKeys constraints;
  io::Schema schema;
  describe(schema, keys);
  describe(schema, target);
  describe(schema, constraints);
  return schema.reference();
}

}  // namespace perfora::optimize
