// What is here: from a sweep file to its cases. What is not: running them.
#include "optimize/campaign/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "io/letters.h"
#include "io/text.h"
#include "optimize/campaign/case_choice.h"
#include "optimize/campaign/evaluation_queue.h"
#include "optimize/campaign/table_file.h"
#include "results/measure_table.h"
#include "solver/grade.h"

namespace perfora::optimize {
namespace {

/// A product of choices beyond this is a slip of the pen.
constexpr std::size_t most_cases = 10000;

void describe(io::Schema& schema, SweepKeys& keys) {
  using io::Dimension;
  using io::Range;
  auto section = schema.section(
      "sweep", "A table of designs, each simulated: `[rows]`, `[grid]` and `[each]` hold lists of values a key.");
  section.path("design", keys.design, "Design file that every case starts from");
  section.integer("replicates", keys.replicates, Range::at_least(1),
                  "Simulations a case; replicate r has the same seeds in every case");
  section.real("until", keys.until, Dimension::ratio, Range{0.0, 1.0, false, true},
               "Strain to run to; 0: as the design says");
  section.boolean("base", keys.base, "The design itself is case 0, and all others are compared to it");
  section.boolean("run_files", keys.run_files,
                  "Keep the run file of every simulation in DIR/runs (runs.csv says which), with a few frames to draw");
  describe(section, keys.execution);
  section.text("measures", keys.measures, "Up to four results to draw, by their names in cases.csv");
}

/// The values of one key.
struct Axis {
  std::string key;
  io::ValueList values;
  int line = 0;
};

/// Warnings of the cases. Those that differ in their numbers only are one kind, told once.
class CaseWarnings {
 public:
  void add(const std::string& text, const SweepCase& one) {
    std::string words;
    std::copy_if(text.begin(), text.end(), std::back_inserter(words),
                 [](char c) { return (c < '0' || c > '9') && c != '.'; });
    const auto known =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& kind) { return kind.words == words; });
    if (known == kinds_.end()) {
      kinds_.push_back({words, text, fmt::format("case {} ({})", one.number, one.label), 1, true});
      return;
    }
    ++known->cases;
    known->same = known->same && known->text == text;
  }

  /// A kind as it is where all `cases` have the same, else as that of the first case which has it.
  std::vector<std::string> told(std::size_t cases) const {
    std::vector<std::string> texts;
    for (const Kind& kind : kinds_) {
      const bool of_all = kind.same && kind.cases == cases;
      std::string& text = texts.emplace_back(of_all ? kind.text : kind.first + ": " + kind.text);
      if (!of_all && kind.cases > 1)
        text +=
            fmt::format("; {} more case{} a warning of this kind", kind.cases - 1, kind.cases == 2 ? " has" : "s have");
    }
    return texts;
  }

 private:
  struct Kind {
    std::string words;  ///< the text without its numbers
    std::string text, first;
    std::size_t cases = 0;
    bool same = true;  ///< the same text in all of them
  };
  std::vector<Kind> kinds_;
};

struct Reader {
  std::filesystem::path path;
  Sweep sweep;
  io::Schema schema;
  std::vector<Axis> rows, grid, each;  ///< [rows] without its names
  io::ValueList names;                 ///< of [rows]
  CaseWarnings warnings;
  std::vector<std::string> only, labels;  ///< what chooses cases; of all cases
  int numbered = 0;                       ///< cases but the design itself

  Reader(const std::filesystem::path& file, std::vector<std::string> texts) : path(file), only(std::move(texts)) {
    describe(schema, sweep.keys);
    sweep.file = file;
  }

  static TableFileForm form() {
    const std::vector<std::string> tables{"rows", "grid", "each"};
    return {"sweep", {"sweep"}, tables, [](io::Entry& entry, const std::string& source) {
              const std::string table = entry.key.substr(0, entry.key.find('.'));
              if (entry.key.find('.') != std::string::npos && table != "sweep")
                throw io::InputError({source, entry.value.line, entry.key}, fmt::format("unknown table [{}]", table),
                                     "a sweep has [sweep], [set], [rows], [grid] and [each]",
                                     "keys of the design that are the same in every case go to [set]");
            }};
  }

  void take(const TableEntry& entry) {
    if (!entry.key.empty() && entry.key[0] >= '0' && entry.key[0] <= '9')
      throw io::InputError(entry.origin(), fmt::format("[{}] is one table of lists", entry.table), "",
                           fmt::format("write [{}] once, and a list of values for each key", entry.table));
    const auto* list = std::get_if<io::ValueList>(&entry.value.data);
    if (!list || list->empty())
      throw io::InputError(entry.origin(), list ? "the list is empty" : "a list of values is wanted here",
                           "at least one value, such as [1.5, 2, 3]", list ? "" : "write the values in brackets");
    if (entry.table == "rows" && entry.key == "name") {
      names = *list;
      return;
    }
    auto& axes = entry.table == "rows" ? rows : entry.table == "grid" ? grid : each;
    axes.push_back({entry.key, *list, entry.value.line});
  }

  void read(const std::vector<std::string>& overrides) {
    const TableFile file(path, form(), schema, overrides);
    for (const TableEntry& entry : file.entries()) take(entry);
    auto start = file.start(sweep.keys.design);
    for (const std::string& text : file.of_design())
      refuse_varied(std::string(io::trimmed(text.substr(0, text.find('=')))), "--set");
    for (const TableEntry& entry : file.fixed()) refuse_in(rows, grid, entry.key, "set." + entry.key, entry.value.line);
    if (sweep.keys.until > 0.0) refuse_varied("loading.until", "sweep.until");
    const Fidelity fidelity{"", changes_without_output(), sweep.keys.until};
    apply(fidelity, *start, {path.string(), 0, "sweep.until"});
    sweep.start = start;
    for (const Axis& axis : grid)
      if (sweep.grid_key.empty() || axis.values.size() > 1) sweep.grid_key = axis.key;
    check_measures();
    check_tables();
  }

  /// A key that every case sets cannot be set for all of them, too.
  void refuse_in(const std::vector<Axis>& first, const std::vector<Axis>& second, const std::string& key,
                 const std::string& by, int line) const {
    for (const auto* axes : {&first, &second})
      for (const Axis& axis : *axes)
        if (axis.key == key)
          throw io::InputError({path.string(), line, by}, fmt::format("{} is varied by the sweep in every case", key),
                               "", "take it out of one of the two places");
  }

  void refuse_varied(const std::string& key, const std::string& by) const {
    refuse_in(rows, grid, key, by, 0);
    refuse_in(each, each, key, by, 0);
  }

  void check_measures() {
    constexpr std::size_t most_drawn = 4;
    sweep.measures = measures_in(sweep.keys.measures, schema.origin("sweep.measures"));
    if (sweep.measures.empty() || sweep.measures.size() > most_drawn)
      throw io::InputError(
          schema.origin("sweep.measures"),
          fmt::format("{} results are named, the picture has room for one to four", sweep.measures.size()),
          "one to four names", "cases.csv holds all of them in any case");
  }

  io::Origin origin(const char* table, const Axis& axis) const {
    return {path.string(), axis.line, fmt::format("{}.{}", table, axis.key)};
  }

  /// Every value is one its key takes; a key stands in one table of [rows] and [grid]; the columns of [rows] are
  /// equally long.
  void check_tables() {
    if (rows.empty() && grid.empty() && each.empty())
      throw io::InputError({path.string(), 0, ""}, "nothing is varied", "a table [grid], [each] or [rows]",
                           "add for example [grid] with material.horizon = [2, 3]");
    for (const auto& [table, axes] : {std::pair{"rows", &rows}, {"grid", &grid}, {"each", &each}})
      for (const Axis& axis : *axes)
        for (const io::Value& value : axis.values) {
          DesignFile scratch = sweep.start->clone();
          scratch.schema().set(axis.key, value, {path.string(), axis.line, axis.key});
        }
    for (const Axis& axis : rows) {
      if (axis.values.size() != rows.front().values.size())
        throw io::InputError(origin("rows", axis),
                             fmt::format("this column has {} values, {} has {}", axis.values.size(), rows.front().key,
                                         rows.front().values.size()),
                             "columns of [rows] are equally long", "");
      for (const Axis& other : grid)
        if (other.key == axis.key)
          throw io::InputError(origin("grid", other), "this key stands in [rows], too", "", "name it in one table");
    }
    if (!names.empty() && names.size() != (rows.empty() ? 0 : rows.front().values.size()))
      throw io::InputError(
          {path.string(), names.front().line, "rows.name"},
          fmt::format("{} names for {} rows", names.size(), rows.empty() ? 0 : rows.front().values.size()),
          "one name a row", "");
    for (std::size_t a = 0; a < names.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (io::readable(names[a]) == io::readable(names[b]))
          throw io::InputError({path.string(), names.front().line, "rows.name"},
                               fmt::format("two rows are named \"{}\"", io::readable(names[a])), "", "");
    std::size_t count = rows.empty() ? 1 : rows.front().values.size();
    for (const Axis& axis : grid) {
      count *= axis.values.size();
      if (count > most_cases)
        throw io::InputError(origin("grid", axis), "far too many cases", fmt::format("at most {}", most_cases),
                             "shorten the lists");
    }
  }

  /// Keys of [grid] with a single value tell no case from another.
  bool constant(const std::string& key) const {
    return std::any_of(grid.begin(), grid.end(),
                       [&](const Axis& axis) { return axis.key == key && axis.values.size() == 1; });
  }

  std::string label_of(const std::vector<DesignChange>& settings) const {
    std::string label;
    const bool all = std::all_of(settings.begin(), settings.end(), [&](const auto& one) { return constant(one.key); });
    for (const DesignChange& setting : settings)
      if (all || !constant(setting.key))
        label += fmt::format("{}{} {}", label.empty() ? "" : ", ", io::after_section(setting.key),
                             io::readable(setting.value));
    return label;
  }

  void add(std::vector<DesignChange> settings, const std::string& group, const std::string& name) {
    SweepCase made;
    made.number = settings.empty() ? 0 : ++numbered;
    made.group = group;
    made.settings = std::move(settings);
    made.label = !name.empty() ? name : made.settings.empty() ? "the design itself" : label_of(made.settings);
    labels.push_back(made.label);
    if (made.number != 0 && !is_chosen(made.label, only)) {
      ++sweep.left_out;
      return;
    }
    DesignFile design = sweep.start->clone();
    for (const DesignChange& setting : made.settings) {
      design.schema().set(setting.key, setting.value, {path.string(), setting.value.line, setting.key});
      if (std::find(sweep.columns.begin(), sweep.columns.end(), setting.key) == sweep.columns.end())
        sweep.columns.push_back(setting.key);
    }
    made.design = std::make_shared<const Design>(design.design());
    try {
      for (const std::string& warning : design.validate()) warnings.add(warning, made);
    } catch (const io::InputError& error) {
      made.problem = error.what();
      sweep.warnings.push_back(fmt::format("case {} ({}) cannot be run: {}", made.number, made.label, made.problem));
    }
    sweep.cases.push_back(std::move(made));
  }

  /// All combinations of [grid] from axis `next` on, the last one fastest.
  void add_grid(std::vector<DesignChange> settings, std::size_t next, const std::string& name) {
    if (next == grid.size()) {
      const std::string rest =
          name.empty() || grid.empty()
              ? name
              : name + ", " + label_of({settings.end() - static_cast<std::ptrdiff_t>(grid.size()), settings.end()});
      return add(std::move(settings), "", rest);
    }
    for (const io::Value& value : grid[next].values) {
      auto with = settings;
      with.push_back({grid[next].key, value});
      add_grid(std::move(with), next + 1, name);
    }
  }

  void make_cases() {
    if (sweep.keys.base) add({}, "", "");
    if (rows.empty() && !grid.empty()) add_grid({}, 0, "");
    for (std::size_t row = 0; !rows.empty() && row < rows.front().values.size(); ++row) {
      std::vector<DesignChange> settings;
      for (const Axis& axis : rows) settings.push_back({axis.key, axis.values[row]});
      add_grid(std::move(settings), 0, names.empty() ? "" : io::readable(names[row]));
    }
    for (const Axis& axis : each) sweep.each.emplace_back(axis.key, static_cast<int>(axis.values.size()));
    for (const Axis& axis : each)
      for (const io::Value& value : axis.values) add({{axis.key, value}}, axis.key, "");
    if (std::none_of(labels.begin(), labels.end(), [&](const auto& label) { return is_chosen(label, only); }))
      refuse_choice(path, only, labels);
    const std::vector<std::string> notices = sweep.start->schema().notices();
    sweep.warnings.insert(sweep.warnings.end(), notices.begin(), notices.end());
    const std::vector<std::string> told = warnings.told(sweep.cases.size());
    sweep.warnings.insert(sweep.warnings.end(), told.begin(), told.end());
    for (const SweepCase& one : sweep.cases)
      if (one.problem.empty()) return;
    throw io::InputError({path.string(), 0, ""}, "no case can be run; the first: " + sweep.cases.front().problem, "",
                         "");
  }
};

}  // namespace

std::string simulation_key(const Request& request) {
  Design similar = *request.design;
  similar.solver = solver::at_grade_one(similar.solver);
  Request one = request;
  one.design = std::make_shared<const Design>(std::move(similar));
  return one.full_key();
}

int Sweep::workers(int asked) const {
  return workers_for(asked, keys.execution.workers, runs());
}

std::int64_t Sweep::runs() const {
  std::set<std::string> designs;
  for (const SweepCase& one : cases)
    if (one.problem.empty()) designs.insert(simulation_key(one.request(0)));
  return static_cast<std::int64_t>(designs.size()) * keys.replicates;
}

Sweep read_sweep(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                 const std::vector<std::string>& only) {
  Reader reader(path, only);
  reader.read(overrides);
  reader.make_cases();
  return std::move(reader.sweep);
}

std::string sweep_reference() {
  SweepKeys keys;
  io::Schema schema;
  describe(schema, keys);
  return schema.reference();
}

const std::vector<std::string>& sweep_measures() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    for (const results::Measure* measure : results::sweep_measures()) found.push_back(measure->key);
    return found;
  }();
  return names;
}

std::vector<std::string> measures_in(const std::string& list, const io::Origin& origin) {
  std::vector<std::string> names;
  const auto& known = sweep_measures();
  std::string rest(io::trimmed(list));
  while (!rest.empty()) {
    const auto comma = rest.find_first_of(", ");
    const std::string name(io::trimmed(rest.substr(0, comma)));
    rest = comma == std::string::npos ? "" : io::trimmed(rest.substr(comma + 1));
    if (name.empty()) continue;
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      std::string nearest = io::nearest_name(name, known);
      const auto longer =
          std::find_if(known.begin(), known.end(), [&](const auto& one) { return one.starts_with(name); });
      if (nearest.empty() && longer != known.end()) nearest = *longer;
      throw io::InputError(origin, fmt::format("there is no result \"{}\"", name),
                           fmt::format("{}", fmt::join(known, ", ")),
                           nearest.empty() ? "take one of these" : fmt::format("did you mean {}?", nearest));
    }
    names.push_back(name);
  }
  return names;
}

std::vector<double> measures_of(const Evaluation& evaluation) {
  std::vector<double> values;
  for (const results::Measure* measure : results::sweep_measures()) {
    const double value = results::value_of(*measure, evaluation);
    values.push_back(std::isfinite(value) ? value : results::not_reached);
  }
  return values;
}

}  // namespace perfora::optimize
