// What is here: `perfora plot`: R.h5, P.h5, T.h5 or an elastic answer -> picture. What is not: drawing (report).
#include "report/plot.h"

#include "app/commands.h"
#include "app/common.h"
#include "io/error.h"
#include "io/hdf5.h"

namespace perfora::app {

namespace {

struct PlotFlags {
  CommonFlags common;
  std::string input;
  std::string output;
  std::string title;
  bool collapse = false;
};

[[noreturn]] void refuse_collapse(const std::filesystem::path& input) {
  throw io::InputError({input.string(), 0, ""}, "--collapse draws the frames of a run, and this is none", "",
                       "give the run file of perfora evaluate");
}

int plot(const PlotFlags& flags) {
  flags.common.apply();
  remove_stop_handlers();
  const std::filesystem::path input = flags.input;
  const std::string format = io::Hdf5Reader(input).attribute_text("/", "format");
  const auto output = output_or_default(flags.output, default_name(input, ".png"));
  check_new_output(output, flags.common.force);
  report::PlotOptions options;
  options.title = flags.title;
  if (flags.collapse) {
    if (!format.starts_with("perfora.run/")) refuse_collapse(input);
    if (options.title.empty()) options.title = input.stem().string();
    report::plot_collapse({{"", report::read_run(input)}}, output, options);
  } else if (format.starts_with("perfora.pack/"))
    report::plot_packing(input, output, options);
  else if (format.starts_with("perfora.test/"))
    report::plot_material_tests(input, output, options);
  else if (format.starts_with("perfora.elastic/"))
    report::plot_elastic(input, output, options);
  else
    report::plot_run(input, output, options);
  if (flags.common.json)
    print_json({{"schema", "perfora.plot/1"}, {"status", "completed"}, {"reason", ""}, {"output", output.string()}});
  io::log_info("written: " + output.string());
  return exit_ok;
}

}  // namespace

void add_plot(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<PlotFlags>();
  CLI::App* command = program.add_subcommand("plot", "Draw a run, a packing, material tests or an elastic answer");
  command
      ->add_option("FILE", flags->input,
                   "Run file R.h5, packing file P.h5, material tests T.h5 or file of evaluate --elastic")
      ->required();
  command->add_option("-o,--output", flags->output, "Picture: .png, .svg or .pdf (default: FILE's name + .png)");
  command->add_option("--title", flags->title, "Heading of the picture (default: FILE's name)")->type_name("TEXT");
  command->add_flag("--collapse", flags->collapse,
                    "Of a run: its frames side by side instead of curve and three blocks");
  add_common_flags(*command, flags->common, Uses::files_only);
  command->callback([flags, &exit_code] { exit_code = plot(*flags); });
}

}  // namespace perfora::app
