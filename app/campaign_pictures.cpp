// What is here: a folder's record read and drawn. What is not: the records (results/).
#include "app/campaign_pictures.h"

#include <fmt/format.h>

#include <utility>

#include "app/measured_curves.h"
#include "io/error.h"
#include "report/plot.h"
#include "report/plot_map.h"
#include "report/plot_study.h"
#include "report/sweep_picture.h"
#include "results/calibration_record.h"
#include "results/campaign_folder.h"
#include "results/run_file.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_curves(const fs::path& folder) {
  throw io::InputError({"--curve", 0, ""}, "is drawn beside curves of runs, and " + folder.string() + " has none", "",
                       "leave it out, or give runs, an ensemble, a sweep or a study");
}

void draw_cases(const results::SweepRecord& record, const fs::path& out, const std::string& title) {
  report::SweepPicture picture = report::sweep_picture(record);
  if (!title.empty()) picture.title = title;
  report::plot_sweep(picture, out);
}

}  // namespace

void draw_campaign(const fs::path& folder, const fs::path& out, const std::string& title,
                   const std::vector<std::string>& curve_files) {
  const std::string kind = results::campaign_kind(folder);
  if (kind == "study") {
    results::StudyRecord record = results::read_study_record(folder);
    if (!title.empty()) record.title = title;
    for (results::Curve& curve : measured_curves(curve_files, {})) record.measured.push_back(std::move(curve));
    report::plot_study(record, out);
  } else if (kind == "map") {
    if (!curve_files.empty()) refuse_curves(folder);
    draw_map(folder, out, title);
  } else if (kind == "sweep") {
    results::SweepRecord record = results::read_sweep_record(folder);
    results::read_sweep_runs(record);
    record.measured = measured_curves(curve_files, {});
    draw_cases(record, out, title);
  } else if (kind == "ensemble") {
    results::SweepRecord record = results::read_ensemble_record(folder);
    record.measured = measured_curves(curve_files, {record.design});
    draw_cases(record, out, title);
  } else if (kind == "calibration") {
    if (!curve_files.empty()) refuse_curves(folder);
    report::PlotOptions options;
    options.title = title;
    report::plot_reachable(results::read_calibration_record(folder), out, options);
  } else {
    throw io::InputError({folder.string(), 0, ""}, "this folder holds no study, map, sweep, ensemble or calibration",
                         "", "give a file or folder that perfora wrote");
  }
}

void draw_map(const fs::path& folder, const fs::path& out, const std::string& title) {
  results::MapRecord record = results::read_map_record(folder);
  if (!title.empty()) record.title = title;
  report::plot_map(record, out);
}

bool draw_collapse(const fs::path& folder, const fs::path& out, const std::string& title) {
  results::SweepRecord record = results::read_sweep_record(folder);
  results::read_sweep_runs(record);
  std::vector<report::LabelledRun> rows;
  for (const results::SweepCase& one : record.cases)
    for (const results::CaseRun& run : one.runs)
      if (run.replicate == 0 && fs::exists(run.run_file)) rows.push_back({one.label, results::read_run(run.run_file)});
  if (rows.empty()) return false;
  report::PlotOptions options;
  options.title = title.empty() ? "How the cases of " + record.title + " collapse (replicate 0)" : title;
  report::plot_collapse(rows, out, options);
  return true;
}

}  // namespace perfora::app
