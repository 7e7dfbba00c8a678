// What is here: the report of a run or of a folder of work: one HTML file that needs nothing else. What is not:
// pictures (plot.h), the parts of the page (html/).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/curve.h"

namespace perfora::report {

struct ReportOptions {
  std::string title = {};                     ///< "": that of the work or of the file
  std::vector<results::Curve> measured = {};  ///< drawn beside the curves
  std::string summary = {};                   ///< the printed summary, shown whole at the end; empty: none
  bool under_way = false;                     ///< the work goes on: the page says so and loads itself anew every minute
};

/// Name of the report of a folder of work, in that folder.
inline constexpr const char* report_name = "report.html";
/// Larger no report is: mail servers and shared folders take such files.
inline constexpr std::size_t most_report_bytes = 5'000'000;

/// Whether `input` is something a report can be made of: a run file, or the folder of a study, sweep, ensemble or
/// calibration.
bool can_be_reported(const std::filesystem::path& input);

/// Writes the report of a run file (R.h5) or of a folder. A study shows its best design frame by frame, an ensemble its
/// first replicate, where their run files are there. Throws io::InputError for anything else, and as the readers of
/// such files do; io::SurroundingsError when the disk fails.
void write_report(const std::filesystem::path& input, const std::filesystem::path& out,
                  const ReportOptions& options = {});

}  // namespace perfora::report
