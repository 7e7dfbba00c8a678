// What is here: reports written by the commands. What is not: `perfora report` itself (report.cpp).
#include "app/reports.h"

#include <memory>

#include "app/common.h"
#include "app/measured_curves.h"
#include "io/error.h"
#include "io/hdf5.h"
#include "io/progress.h"
#include "report/html_report.h"
#include "results/campaign_folder.h"
#include "results/describe.h"
#include "results/sweep_record.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;

/// The configurations whose measured curves are drawn. A study's record holds its own.
std::vector<std::string> configurations(const fs::path& input) {
  if (!fs::is_directory(input)) {
    const io::Hdf5Reader file(input);
    return {file.has("/config") ? file.text("/config") : ""};
  }
  if (results::campaign_kind(input) == "ensemble") return {results::read_ensemble_record(input).design};
  return {};
}

std::string printed_summary(const fs::path& input) {
  try {
    const auto summary = results::stored_summary(input);
    return summary ? record_text(*summary, input.string()) : "";
  } catch (const io::InputError&) {
    return {};  // damaged or of another program: the page shows the rest
  }
}

}  // namespace

void write_report_of(const fs::path& input, const fs::path& out, const ReportWish& wish) {
  report::ReportOptions options;
  options.title = wish.title;
  options.under_way = wish.under_way;
  if (report::can_be_reported(input)) {
    options.measured = measured_curves(wish.curves, configurations(input));
    options.summary = wish.under_way ? "" : printed_summary(input);
  }
  report::write_report(input, out, options);
}

void write_report_beside(const fs::path& input) {
  const fs::path out =
      fs::is_directory(input) ? input / report::report_name : fs::path(input).replace_extension(".html");
  try {
    write_report_of(input, out);
  } catch (const io::InputError& error) {
    io::log_warning(std::string("no report was written: ") + error.what());
  }
}

std::function<void()> report_renewal(const fs::path& folder) {
  const auto warned = std::make_shared<bool>(false);
  return [folder, warned] {
    try {
      write_report_of(folder, folder / report::report_name, {.under_way = true});
    } catch (const std::exception& error) {  // a full disk, too: the journal says so where it matters
      if (!*warned) io::log_warning(std::string("the report is not renewed: ") + error.what());
      *warned = true;
    }
  };
}

}  // namespace perfora::app
