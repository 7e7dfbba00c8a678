// What is here: `perfora report`: the HTML report of a run file or of a folder of work. What is not: the page
// (report/html_report.h), what the commands write at their end (reports.h).
#include "report/html_report.h"

#include <fmt/format.h>

#include "app/commands.h"
#include "app/common.h"
#include "app/reports.h"
#include "io/error.h"
#include "io/letters.h"
#include "io/lock.h"
#include "results/describe.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;

struct ReportFlags {
  CommonFlags common;
  std::string input, output;
  ReportWish wish;
};

int report_on(const ReportFlags& flags) {
  flags.common.apply();
  const fs::path input = flags.input;
  if (!fs::exists(input)) throw io::InputError({flags.input, 0, ""}, "there is no such file or folder");
  if (io::lower(input.extension().string()) == ".toml" && !fs::is_directory(input)) {
    const std::string kind = results::kind_of_toml(input), command = results::command_of(kind);
    throw io::InputError({flags.input, 0, ""}, "this is a " + kind + ", and a report is of results", "",
                         fmt::format("run {} {}, and give what it writes", command, flags.input));
  }
  const fs::path named = input.has_filename() ? input : input.parent_path();
  const auto output = output_or_default(flags.output, default_name(named, ".html"));
  const io::OutputLock lock = io::claim_new_output(output, flags.common.force);
  write_report_of(input, output, flags.wish);
  if (flags.common.json)
    print_json({{"schema", "perfora.report/1"}, {"status", "completed"}, {"reason", ""}, {"output", output.string()}});
  io::log_info("written: " + output.string());
  return exit_ok;
}

}  // namespace

void add_report(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<ReportFlags>();
  CLI::App* command = program.add_subcommand("report", "Write one HTML page about a run or a folder of work");
  command
      ->add_option("FILE", flags->input,
                   "Run file R.h5, or the folder of a study, map, sweep, ensemble or calibration, finished or not")
      ->required();
  command->add_option("-o,--output", flags->output, "Page to write (default: FILE's name + .html)")
      ->type_name("R.html");
  command->add_option("--title", flags->wish.title, "Heading of the page (default: that of the design)")
      ->type_name("TEXT");
  command
      ->add_option("--curve", flags->wish.curves,
                   "Measured curve to draw beside those of runs: CSV with a first line such as \"strain [%], stress "
                   "[MPa]\" (repeatable)")
      ->type_name("CSV")
      ->allow_extra_args(false);
  add_common_flags(*command, flags->common, Uses::files_only);
  command->callback([flags, &exit_code] { exit_code = report_on(*flags); });
}

}  // namespace perfora::app
