// What is here: tables and evaluations of the library, and files read into them. What is not: the formats (results/).
#include "perfora/results.h"

#include <algorithm>

#include "io/csv.h"
#include "io/hdf5.h"
#include "io/text.h"
#include "io/units.h"
#include "perfora/inside.h"
#include "results/campaign_folder.h"
#include "results/describe.h"
#include "results/formats.h"
#include "results/history.h"
#include "results/json.h"
#include "results/measure_table.h"
#include "results/run_file.h"
#include "results/status.h"

namespace perfora {

namespace {

namespace fs = std::filesystem;

/// Throws Error, naming the nearest of `names`.
[[noreturn]] void refuse_name(const std::string& what, const std::string& name, const std::vector<std::string>& names) {
  const std::string nearest = io::nearest_name(name, names);
  throw Error("there is no " + what + " \"" + name + "\"; " +
              (nearest.empty() ? "there are " + io::joined(names) : "did you mean \"" + nearest + "\"?"));
}

const Column& column_of(const Table& table, const std::string& name) {
  for (const Column& column : table.columns)
    if (column.name == name) return column;
  std::vector<std::string> names;
  for (const Column& column : table.columns) names.push_back(column.name);
  refuse_name("column", name, names);
}

/// SI unit of a column of a CSV file that is of the history, a key of the design, or a measure, also of its statistics;
/// empty where it is not known.
std::string unit_of(std::string name) {
  for (const results::History::Column& column : results::History::columns())
    if (column.name == name) return column.units;
  static const optimize::DesignFile defaults;
  if (const io::Key* key = defaults.schema().find(name)) return std::string(io::si_unit(key->dimension));
  for (const std::string suffix : {"_ci95", "_std", "_change"})
    if (name.ends_with(suffix)) name.resize(name.size() - suffix.size());
  const results::Measure* measure = results::measure_called(name);
  return measure ? std::string(io::si_unit(measure->dimension)) : std::string();
}

/// What the attribute `format` of an HDF5 file says.
std::string kind_of_hdf5(const fs::path& path) {
  static const std::pair<std::string, const char*> kinds[] = {{results::run_format, "run"},
                                                              {results::pack_format, "packing"},
                                                              {results::material_format, "material tests"},
                                                              {results::elastic_format, "elastic response"},
                                                              {results::checkpoint_format, "checkpoint"}};
  const io::Hdf5Reader file(path);
  if (!file.has_attribute("/", "format")) return {};
  const std::string format = file.attribute_text("/", "format");
  for (const auto& [name, kind] : kinds)
    if (format == name) return kind;
  return {};
}

}  // namespace

double value_of(const std::vector<Measure>& measures, const std::string& key) {
  std::vector<std::string> keys;
  for (const Measure& measure : measures) {
    if (measure.key == key) return measure.value;
    keys.push_back(measure.key);
  }
  refuse_name("measure", key, keys);
}

std::size_t Table::rows() const {
  return columns.empty() ? 0 : columns.front().values.size();
}

bool Table::has(const std::string& name) const {
  return std::any_of(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
}

std::span<const double> Table::values(const std::string& name) const {
  return column_of(*this, name).values;
}

std::span<const std::string> Table::texts(const std::string& name) const {
  return column_of(*this, name).texts;
}

double Evaluation::measure(const std::string& key) const {
  return value_of(measures, key);
}

std::span<const double> Evaluation::strain() const {
  return curve.values("strain_yy");
}

std::span<const double> Evaluation::stress() const {
  return curve.values("stress_yy");
}

std::string Evaluation::to_json(bool with_curve) const {
  if (!with_curve) return record;
  return at_boundary([&] {
    auto all = nlohmann::json::parse(record);
    all["curve"] = results::to_json(Inside::evaluation(*this), true).at("curve");
    return all.dump(2);
  });
}

Evaluation Evaluation::from_json(const std::string& text) {
  return at_boundary([&] {
    try {
      auto record = nlohmann::json::parse(text);
      const results::Evaluation all = results::evaluation_from_json(record);
      record.erase("curve");
      return public_evaluation(all, record);
    } catch (const std::invalid_argument& error) {
      throw io::InputError({"evaluation", 0, ""}, error.what());
    }
  });
}

Run public_run(const results::RunResult& found) {
  Run run;
  results::Evaluation evaluation = results::evaluation_from_json(found.summary);
  evaluation.curve = found.history;
  run.evaluation = public_evaluation(evaluation, found.summary);
  run.design = found.provenance.config;
  run.program_version = found.provenance.program_version;
  for (const results::FrameInfo& frame : found.frames) run.frame_strains.push_back(frame.strain);
  return run;
}

Run read_run(const fs::path& file) {
  return at_boundary([&] { return public_run(results::read_run(file)); });
}

Table read_table(const fs::path& file) {
  return at_boundary([&] {
    const io::TextTable found = io::read_text_table(file);
    Table table;
    for (std::size_t k = 0; k < found.names.size(); ++k) {
      Column column{found.names[k], unit_of(found.names[k]), {}, {}};
      for (const auto& row : found.rows) {
        column.values.push_back(io::number_in(row[k]));
        column.texts.push_back(row[k]);
      }
      table.columns.push_back(std::move(column));
    }
    return table;
  });
}

std::string kind_of(const fs::path& path) {
  return at_boundary([&]() -> std::string {
    if (!fs::exists(path)) throw io::InputError({path.string(), 0, ""}, "there is no such file or folder");
    if (fs::is_directory(path)) return results::campaign_kind(path);
    if (path.extension() == ".h5") return kind_of_hdf5(path);
    if (path.extension() == ".csv") return "table";
    if (path.extension() != ".toml") return {};
    const std::string kind = results::kind_of_toml(path);
    return kind == "design" ? kind : kind + " file";
  });
}

std::string stored_record(const fs::path& path) {
  return at_boundary([&] {
    const auto record = results::stored_summary(path);
    return record ? record->dump(2) : std::string();
  });
}

}  // namespace perfora
