// What is here: the HTML report of a run file or of a folder of work, with what only the program knows (measured curves
// that designs name, the printed summary). What is not: the page (report/html_report.h).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace perfora::app {

struct ReportWish {
  std::string title = {};                ///< "": that of the design or the file
  std::vector<std::string> curves = {};  ///< CSV files of measured curves beside those that the design names
  bool under_way = false;                ///< the work goes on
};

/// Throws io::InputError for an input that no report can be made of, and for bad curves.
void write_report_of(const std::filesystem::path& input, const std::filesystem::path& out, const ReportWish& wish = {});

/// R.html beside R.h5; DIR/report.html. What goes wrong but for a disk that fails becomes a warning: the work is done.
void write_report_beside(const std::filesystem::path& run_file_or_folder);

/// For WorkOptions::results_written: renews the report of the folder while its work goes on. What goes wrong becomes a
/// warning, once.
std::function<void()> report_renewal(const std::filesystem::path& folder);

}  // namespace perfora::app
