// What is here: which parts the page of a run or a folder has. What is not: the parts (html/).
#include "report/html_report.h"

#include <fmt/format.h>

#include <utility>

#include "io/error.h"
#include "io/files.h"
#include "io/hdf5.h"
#include "io/progress.h"
#include "report/html/campaign_parts.h"
#include "report/html/page.h"
#include "report/html/run_part.h"
#include "results/campaign_folder.h"
#include "results/formats.h"
#include "results/map_record.h"
#include "results/run_file.h"

namespace perfora::report {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr int renew_seconds = 60;

/// What the model leaves out, said beside every verdict (docs/user/theory.md).
const json& left_out() {
  static const json list = {
      "The model is plane: the block is a slice of unit depth. How a real, three-dimensional block spreads load along "
      "its third direction is not in it.",
      "No creep, no moisture, no ageing: rock loads a lining over years, the block here is crushed in seconds.",
      "The rate is higher than in the ground. The impact stress says how much of the plateau may come from that.",
      "Discs are the smallest pieces: finer dust, and how it fills pores, is not in it."};
  return list;
}

/// The part of another page as one of this page: its facts under `key`, its numbers as they are.
void take_in(Part& whole, const char* key, Part part) {
  whole.facts[key] = std::move(part.facts);
  for (auto& [name, text] : part.numbers) whole.numbers[name] = std::move(text);
}

/// The run file of a folder, where it can be read: the report of a study does not fail with it.
void take_in_run(Part& whole, const fs::path& file, const char* caption, const ReportOptions& options) {
  if (!fs::exists(file)) return;
  try {
    take_in(whole, "run", run_part(results::read_run(file), {.measured = options.measured}));
    whole.facts["run_caption"] = caption;
  } catch (const io::InputError& error) {
    io::log_warning(fmt::format("the report leaves {} out: {}", file.filename().string(), error.what()));
  }
}

std::string format_of(const fs::path& file) {
  const io::Hdf5Reader reader(file);
  return reader.has_attribute("/", "format") ? reader.attribute_text("/", "format") : "";
}

bool is_run(const std::string& format) {
  return format.starts_with("perfora.run/");
}

Part of_run(const fs::path& input, const ReportOptions& options) {
  if (!is_run(format_of(input)))
    throw io::InputError({input.string(), 0, ""}, "this is no run file, and a report shows runs and folders of work",
                         "", "perfora plot draws packings, material tests and elastic responses");
  Part whole;
  const results::RunResult run = results::read_run(input);
  take_in(whole, "run", run_part(run, {.measured = options.measured}));
  whole.facts["kind"] = "run";
  whole.facts["title"] = results::title_of(run.provenance, input);
  whole.facts["name"] = input.stem().string();
  for (const char* key : {"verdict", "status", "reason", "block"}) whole.facts[key] = whole.facts["run"][key];
  return whole;
}

Part of_folder(const fs::path& folder, const ReportOptions& options) {
  const std::string kind = results::campaign_kind(folder);
  Part whole;
  Part part;
  const json result = result_of(folder);
  if (kind == "study") {
    results::StudyRecord record = results::read_study_record(folder);
    record.measured.insert(record.measured.end(), options.measured.begin(), options.measured.end());
    part = study_part(record, folder);
    take_in_run(whole, folder / "best.h5", "The best design", options);
  } else if (kind == "sweep" || kind == "ensemble") {
    results::SweepRecord record =
        kind == "sweep" ? results::read_sweep_record(folder) : results::read_ensemble_record(folder);
    if (kind == "sweep") results::read_sweep_runs(record);
    record.measured = options.measured;
    part = sweep_part(record);
    if (kind == "ensemble") take_in_run(whole, folder / "replicate-000.h5", "The first replicate", options);
  } else if (kind == "map") {
    part = map_part(results::read_map_record(folder));
  } else if (kind == "calibration") {
    part = calibration_part(results::read_calibration_record(folder));
  } else {
    throw io::InputError({folder.string(), 0, ""}, "this folder holds no study, map, sweep, ensemble or calibration",
                         "", "give a run file or a folder that perfora wrote");
  }
  whole.facts["kind"] = kind;
  whole.facts["name"] = results::campaign_title(folder);
  whole.facts["title"] = part.facts.value("title", whole.facts["name"].get<std::string>());
  for (const char* key : {"verdict", "block"})
    if (part.facts.contains(key)) whole.facts[key] = part.facts[key];
  for (const char* key : {"status", "reason"})
    if (result.is_object() && result.contains(key)) whole.facts[key] = result.at(key);
  take_in(whole, "work", std::move(part));
  return whole;
}

}  // namespace

bool can_be_reported(const fs::path& input) {
  try {
    return fs::is_directory(input) ? !results::campaign_kind(input).empty() : is_run(format_of(input));
  } catch (const io::InputError&) {
    return false;
  }
}

void write_report(const fs::path& input, const fs::path& out, const ReportOptions& options) {
  if (out.extension() != ".html")
    throw io::InputError({"-o", 0, out.string()}, "the report does not end in .html", "a name such as report.html");
  Part whole = fs::is_directory(input) ? of_folder(input, options) : of_run(input, options);
  if (!options.title.empty()) whole.facts["title"] = options.title;
  whole.facts["left_out"] = left_out();
  whole.facts["summary"] = options.summary;
  whole.facts["under_way"] = options.under_way;
  io::write_file(out, html_page(whole, options.under_way ? renew_seconds : 0));
}

}  // namespace perfora::report
